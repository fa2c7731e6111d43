// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/processing/check_delivery.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/report/quality_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "messages.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// Agreement of two strips.
struct PairCheck {
  std::string a, b, status, reason;
  double overlap_area = 0.0;
  OffsetSummary vertical, normal;
  std::optional<int> quality_level;
  HorizontalShift horizontal;
  std::vector<double> sampled_offsets;  ///< at the places that are kept for plots
};

/// One set of strips.
struct BlockSummary {
  std::vector<std::string> files, strips;
  std::vector<PairCheck> pairs;
  std::optional<OffsetSummary> control;
  WarningTexts warnings;
  std::vector<ExcludedPoints> excluded;
};

struct CheckResult {
  BlockSummary block;
  std::optional<BlockSummary> before;
  int quality_level = 2;
  bool kept = false;
  std::vector<std::string> not_kept_because;
  bool reliable = false;
  std::string reason, json, text;
};

PairCheck pairOf(const CheckedPair& pair) {
  PairCheck result;
  result.a = pair.a, result.b = pair.b, result.overlap_area = pair.overlap_area;
  result.status = toString(pair.assessment.status), result.reason = pair.assessment.reason;
  result.vertical = pair.assessment.vertical, result.normal = pair.assessment.normal;
  result.quality_level = pair.assessment.quality_level;
  result.horizontal = pair.assessment.horizontal;
  for (const OffsetSample& sample : pair.samples)
    if (sample.level) result.sampled_offsets.push_back(sample.vertical);
  return result;
}

BlockSummary summaryOf(const CheckedBlock& block) {
  BlockSummary result;
  result.files = block.files, result.excluded = block.excluded;
  for (const CheckedStrip& strip : block.strips) result.strips.push_back(strip.id);
  for (const CheckedPair& pair : block.pairs) result.pairs.push_back(pairOf(pair));
  if (block.control) result.control = block.control->all;
  result.warnings = warningTexts(block.warnings);
  return result;
}

std::shared_ptr<CheckResult> resultOf(const QualityReport& report) {
  auto result = std::make_shared<CheckResult>();
  result->block = summaryOf(report.block);
  if (report.before) result->before = summaryOf(*report.before);
  result->quality_level = report.quality_level;
  DeliveryRequirement required = requireLevel(report.block, report.quality_level);
  result->kept = required.kept, result->not_kept_because = std::move(required.reasons);
  result->reliable = hasAnswer(report.block), result->reason = whyUnreliable(report.block);
  result->json = qualityJson(report), result->text = qualityText(report);
  return result;
}

void bindSummary(py::module_& m) {
  Record<OffsetSummary>(m, "OffsetSummary", "Statistics of offsets, m.")
      .field("count", &OffsetSummary::count)
      .field("mean", &OffsetSummary::mean)
      .field("std", &OffsetSummary::std)
      .field("rms", &OffsetSummary::rms)
      .field("median", &OffsetSummary::median)
      .field("nmad", &OffsetSummary::nmad, "1.4826 times the median absolute deviation")
      .field("percentile_95", &OffsetSummary::percentile_95, "of the absolute values")
      .field("largest", &OffsetSummary::largest, "absolute value")
      .field("std_of_mean", &OffsetSummary::std_of_mean,
             "allows for errors that places of an area have in common; NaN: unknown")
      .state(&OffsetSummary::std_of_mean_formal)
      .bind();
  Record<HorizontalShift>(m, "HorizontalShift", "Movement of strip a onto strip b, m.")
      .field("determined", &HorizontalShift::determined)
      .field("reason", &HorizontalShift::reason, "why it is not determined")
      .field("shift", &HorizontalShift::shift, "east, north, up")
      .field("std", &HorizontalShift::std)
      .state(&HorizontalShift::std_formal)
      .state(&HorizontalShift::count)
      .state(&HorizontalShift::rms)
      .bind();
}

void bindPair(py::module_& m) {
  Record<PairCheck>(m, "CheckedPair",
                    "Agreement of two overlapping strips; signs are those of a - b.")
      .field("a", &PairCheck::a)
      .field("b", &PairCheck::b)
      .field("overlap_area", &PairCheck::overlap_area, "m^2")
      .field("status", &PairCheck::status, "'judged', or why not")
      .field("reason", &PairCheck::reason)
      .field("vertical", &PairCheck::vertical,
             "height differences on smooth ground below 10 degrees")
      .field("normal", &PairCheck::normal, "distances along the normals of all smooth surfaces")
      .field("quality_level", &PairCheck::quality_level,
             "of the USGS Lidar Base Specification by vertical.rms; None: none")
      .field("horizontal", &PairCheck::horizontal)
      .field("sampled_offsets", &PairCheck::sampled_offsets,
             "vertical offsets at up to 5000 places, for plots; m")
      .bind();
}

void bindBlock(py::module_& m) {
  Record<BlockSummary>(m, "CheckedBlock", "One set of strips in a check.")
      .field("files", &BlockSummary::files)
      .field("pairs", &BlockSummary::pairs)
      .field("strips", &BlockSummary::strips)
      .field("control", &BlockSummary::control, "strips minus control points; None without control")
      .state(&BlockSummary::warnings)
      .property("warnings", [](const BlockSummary& b) { return hintedTexts("check", b.warnings); })
      .field("left_out", &BlockSummary::excluded)
      .bind();
  Record<CheckResult>(m, "CheckResult", "The result of a delivery check.")
      .field("block", &CheckResult::block, "the set that was checked")
      .field("before", &CheckResult::before, "the same strips before; None without")
      .field("quality_level", &CheckResult::quality_level, "that was required")
      .field(
          "kept", &CheckResult::kept,
          "whether the delivery keeps the required level: every overlapping pair is measured and "
          "within the limit, and so is control where it was given")
      .field("not_kept_because", &CheckResult::not_kept_because,
             "why the delivery does not keep the required level: every pair and figure")
      .field("reliable", &CheckResult::reliable,
             "whether there is a reliable result: an assessed pair, or a control point")
      .field("reason", &CheckResult::reason, "why there is none; empty where there is one")
      .state(&CheckResult::json)
      .state(&CheckResult::text)
      .bind()
      .def(
          "to_dict", [](const CheckResult& r) { return parsedJson(r.json); },
          "The content of quality.json as dictionaries and lists.")
      .def("__str__", [](const CheckResult& r) { return r.text; });
}

void bindSettings(py::module_& m) {
  py::class_<CheckSettings>(m, "CheckSettings",
                            "Settings of a check; attributes may be given as keywords.")
      .def(fromKeywords<CheckSettings>())
      .def_property(
          "maximum_distance", [](const CheckSettings& s) { return s.limits.maximum_distance; },
          [](CheckSettings& s, double metres) { s.limits.maximum_distance = metres; },
          "larger offsets count as different objects, m")
      .def_property(
          "point_budget", [](const CheckSettings& s) { return s.selection.point_budget; },
          [](CheckSettings& s, std::size_t points) { s.selection.point_budget = points; },
          "largest number of points in the areas that are compared")
      .def_readwrite("control_sigma", &CheckSettings::control_sigma,
                     "standard deviation of control points whose file gives none, m")
      .def_readwrite("minimum_points", &CheckSettings::minimum_points)
      .def_readwrite("minimum_overlap", &CheckSettings::minimum_overlap, "m^2")
      .def_readwrite("candidates", &CheckSettings::candidates, "places of comparison")
      .def_readwrite("force", &CheckSettings::force)
      .def_readwrite("threads", &CheckSettings::threads);
}

using BeforeArgument = std::variant<std::monostate, Files, std::reference_wrapper<Survey>, Strips>;

DeliveryCheckResult checkPoints(const PointsArgument& points,
                                const std::optional<TrajectoryArgument>& flight,
                                const DeliveryCheckOptions& options,
                                const ProgressCallback& report) {
  UsedSurvey survey(points, options.settings.threads);
  TrajectoryLoadingOptions reading;
  reading.crs = (*survey).reference().crs;
  const auto trajectory = flight ? flightOf(*flight, reading).trajectory : nullptr;
  return checkDelivery(*survey, trajectory, options, report);
}

std::shared_ptr<CheckResult> check(const PointsArgument& points, const BeforeArgument& before,
                                   const ControlArgument& control,
                                   const OptionalTrajectory& trajectory, int quality_level,
                                   const CheckSettings& settings, const StripChoice& strips,
                                   const PythonProgress& progress) {
  return runJob(progress, [&](const ProgressCallback& report) {
    if (quality_level < 0 || quality_level >= kQualityLevels)
      throw UsageError("quality_level: must be 0, 1, 2 or 3");
    DeliveryCheckOptions options;
    options.settings = settings, options.strips = strips;
    options.settings.control = controlOf(control);
    const auto flight = given<TrajectoryArgument>(trajectory);
    DeliveryCheckResult checked = checkPoints(points, flight, options, report);
    QualityReport quality;
    quality.quality_level = quality_level;
    quality.block = std::move(checked.block);
    if (const auto others = given<PointsArgument>(before)) {
      options.areas = checked.areas;
      quality.before = checkPoints(*others, flight, options, report).block;
    }
    return resultOf(quality);
  });
}

}  // namespace

void bindCheck(py::module_& m) {
  bindSummary(m);
  bindPair(m);
  bindBlock(m);
  bindSettings(m);
  m.def("check", &check, py::arg("points"), py::kw_only(), py::arg("before") = py::none(),
        py::arg("control") = py::none(), py::arg("trajectory") = py::none(),
        py::arg("quality_level") = 2, py::arg_v("settings", CheckSettings(), "CheckSettings()"),
        py::arg_v("strips", StripChoice(), "StripChoice()"), py::arg("progress") = py::none(),
        "Measures how well overlapping strips agree with each other and with control, as "
        "pcl_als_check does. before: the same strips before a correction, compared in the same "
        "areas; quality_level: of the USGS Lidar Base Specification that is required, 0 to 3; "
        "trajectory: for scan angles that are finer than those of the files. Whether there is a "
        "reliable answer is told by the result. InputError for data that cannot be used.");
}

}  // namespace pcl_als::python
