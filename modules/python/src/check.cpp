// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/processing/survey_check.h>
#include <pcl_als/quality/accuracy_standards.h>
#include <pcl_als/report/quality_report.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

void bindSummary(py::module_& m) {
  py::class_<OffsetSummary>(m, "OffsetSummary", "Statistics of offsets, m.")
      .def_readonly("count", &OffsetSummary::count)
      .def_readonly("mean", &OffsetSummary::mean)
      .def_readonly("std", &OffsetSummary::std)
      .def_readonly("rms", &OffsetSummary::rms)
      .def_readonly("median", &OffsetSummary::median)
      .def_readonly("nmad", &OffsetSummary::nmad, "1.4826 times the median absolute deviation")
      .def_readonly("percentile_95", &OffsetSummary::percentile_95, "of the absolute values")
      .def_readonly("largest", &OffsetSummary::largest, "absolute value")
      .def_readonly("std_of_mean", &OffsetSummary::std_of_mean,
                    "with correlated errors of places; NaN: unknown");
  py::class_<HorizontalShift>(m, "HorizontalShift", "Movement of strip a onto strip b, m.")
      .def_readonly("determined", &HorizontalShift::determined)
      .def_readonly("reason", &HorizontalShift::reason, "why it is not determined")
      .def_property_readonly(
          "shift", [](const HorizontalShift& s) { return Eigen::Vector3d(s.shift); },
          "east, north, up")
      .def_property_readonly("std",
                             [](const HorizontalShift& s) { return Eigen::Vector3d(s.std); });
}

/// Distances a - b at the places that are kept for plots.
std::vector<double> sampledOffsets(const CheckedPair& pair) {
  std::vector<double> offsets;
  for (const OffsetSample& sample : pair.samples)
    if (sample.level) offsets.push_back(sample.vertical);
  return offsets;
}

void bindPair(py::module_& m) {
  py::class_<CheckedPair>(m, "CheckedPair",
                          "Agreement of two overlapping strips; signs are those of a - b.")
      .def_readonly("a", &CheckedPair::a)
      .def_readonly("b", &CheckedPair::b)
      .def_readonly("overlap_area", &CheckedPair::overlap_area, "m^2")
      .def_property_readonly(
          "status", [](const CheckedPair& p) { return std::string(toString(p.assessment.status)); },
          "'judged', or why not")
      .def_property_readonly("reason", [](const CheckedPair& p) { return p.assessment.reason; })
      .def_property_readonly(
          "vertical", [](const CheckedPair& p) { return p.assessment.vertical; },
          "height differences on smooth ground below 10 degrees")
      .def_property_readonly(
          "normal", [](const CheckedPair& p) { return p.assessment.normal; },
          "distances along the normals of all smooth surfaces")
      .def_property_readonly(
          "quality_level", [](const CheckedPair& p) { return p.assessment.quality_level; },
          "of the USGS Lidar Base Specification by vertical.rms; None: none")
      .def_property_readonly("horizontal",
                             [](const CheckedPair& p) { return p.assessment.horizontal; })
      .def_property_readonly("sampled_offsets", &sampledOffsets,
                             "vertical offsets at up to 5000 places, for plots; m");
}

void bindBlock(py::module_& m) {
  py::class_<CheckedBlock, std::shared_ptr<CheckedBlock>>(m, "CheckedBlock",
                                                          "One set of strips in a check.")
      .def_readonly("files", &CheckedBlock::files)
      .def_readonly("pairs", &CheckedBlock::pairs)
      .def_property_readonly("strips",
                             [](const CheckedBlock& block) {
                               std::vector<std::string> names;
                               for (const CheckedStrip& strip : block.strips)
                                 names.push_back(strip.id);
                               return names;
                             })
      .def_property_readonly(
          "control",
          [](const CheckedBlock& block) -> std::optional<OffsetSummary> {
            if (!block.control) return std::nullopt;
            return block.control->all;
          },
          "strips minus control points; None without control")
      .def_property_readonly("warnings",
                             [](const CheckedBlock& block) { return textsOf(block.warnings); })
      .def_readonly("left_out", &CheckedBlock::left_out);
  py::class_<QualityReport, std::shared_ptr<QualityReport>>(m, "CheckResult",
                                                            "The result of a delivery check.")
      .def_readonly("block", &QualityReport::block, "the set that was checked")
      .def_readonly("before", &QualityReport::before, "the same strips before; None without")
      .def_readonly("quality_level", &QualityReport::quality_level, "that was required")
      .def_property_readonly(
          "reliable", [](const QualityReport& r) { return hasAnswer(r.block); },
          "whether there is a reliable result: an assessed pair, or a control point")
      .def_property_readonly(
          "reason", [](const QualityReport& r) { return whyUnreliable(r.block); },
          "why there is none; empty where there is one")
      .def(
          "to_dict", [](const QualityReport& r) { return parsedJson(qualityJson(r)); },
          "The content of quality.json as dictionaries and lists.")
      .def("__str__", &qualityText);
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

using BeforeArgument =
    std::variant<std::monostate, std::shared_ptr<Survey>, Strips, Paths, std::filesystem::path>;
using OptionalFlight =
    std::variant<std::monostate, std::shared_ptr<FlightFile>, std::filesystem::path, Paths>;

/// An optional argument as the argument that it holds.
template <typename Argument, typename Optional>
std::optional<Argument> given(const Optional& argument) {
  return std::visit(
      [](const auto& value) -> std::optional<Argument> {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
          return std::nullopt;
        else
          return Argument(value);
      },
      argument);
}

SurveyCheck checkPoints(const PointsArgument& points, const std::optional<FlightArgument>& flight,
                        const SurveyCheckOptions& options, const ProgressCallback& report) {
  UsedSurvey survey(points, options.settings.threads);
  FlightFileOptions reading;
  reading.crs = (*survey).reference().crs;
  const auto trajectory = flight ? flightOf(*flight, reading).trajectory : nullptr;
  return checkSurvey(*survey, trajectory, options, report);
}

std::shared_ptr<QualityReport> check(const PointsArgument& points, const BeforeArgument& before,
                                     const ControlArgument& control,
                                     const OptionalFlight& trajectory, int quality_level,
                                     const CheckSettings& settings, const StripChoice& strips,
                                     const PythonProgress& progress) {
  return runJob(progress, [&](const ProgressCallback& report) {
    if (quality_level < 0 || quality_level >= kQualityLevels)
      throw UsageError("quality_level: must be 0, 1, 2 or 3");
    SurveyCheckOptions options;
    options.settings = settings, options.strips = strips;
    options.settings.control = controlOf(control);
    const auto flight = given<FlightArgument>(trajectory);
    SurveyCheck checked = checkPoints(points, flight, options, report);
    auto result = std::make_shared<QualityReport>();
    result->quality_level = quality_level;
    result->block = std::move(checked.block);
    if (const auto others = given<PointsArgument>(before)) {
      options.areas = checked.areas;
      result->before = checkPoints(*others, flight, options, report).block;
    }
    return result;
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
