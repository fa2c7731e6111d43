// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/drawing/calibration_plots.h>
#include <pcl_als/drawing/row_plots.h>
#include <pcl_als/processing/picture/section_places.h>
#include <pcl_als/processing/picture/survey_profile.h>
#include <pcl_als/report/calibration_page.h>

#include "calibration_verdict.h"
#include "report_parts.h"

namespace pcl_als {
namespace {

/// "Lever arm x, lever arm y: apply this calibration": each hint once, with the errors it is for.
std::vector<std::string> remediesOf(const CalibrationResult& result) {
  std::vector<std::pair<std::string, std::string>> remedies;
  for (const ErrorFinding& f : result.diagnosis) {
    if (!(f.determined && f.probability > 0.5)) continue;
    const auto same = std::find_if(remedies.begin(), remedies.end(),
                                   [&](const auto& each) { return each.first == f.hint; });
    if (same == remedies.end())
      remedies.emplace_back(f.hint, f.title);
    else
      same->second += ", " + f.title;
  }
  std::vector<std::string> texts;
  for (const auto& [hint, errors] : remedies) texts.push_back(errors + ": " + hint + ".");
  return texts;
}

ReportTable parameterTable(const CalibrationResult& result) {
  ReportTable table{"parameters",
                    "Biases, assumed − true. std: what the pairs share is accounted for; formal "
                    "std: only the noise of points counted (Habib et al. 2011, Eq. 26)",
                    {"parameter", "unit", "bias", "std", "formal std", "status"},
                    {}};
  const bool with_prior = result.prior.any();
  if (with_prior) {
    table.caption += ". From prior: the part of the variance that stems from the prior" +
                     (result.prior.source.empty() ? "" : " of " + result.prior.source) +
                     "; the rest stems from this flight";
    table.columns.emplace_back("from prior, %");
  }
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    const bool known = estimate.status == ParameterStatus::estimated;
    const int digits = decimalsOfStd(estimate.std / info.internal_per_unit);
    const auto cell = [&](double value) {
      return known ? numberText(value / info.internal_per_unit, digits) : std::string();
    };
    std::string status(toString(estimate.status));
    if (!estimate.reason.empty()) status += ": " + estimate.reason;
    table.rows.push_back({headingOf(info.parameter), unitText(info.parameter), cell(estimate.bias),
                          cell(estimate.std), cell(estimate.std_formal), status});
    if (with_prior)
      table.rows.back().push_back(known ? numberText(100.0 * estimate.prior_share, 0) : "");
  }
  return table;
}

ReportTable pairTable(const CalibrationResult& result) {
  ReportTable table{
      "",
      "Normal distances of point-patch pairs, m; mean: first strip above the second; of a "
      "strip with itself: its points ahead of the sensor above those behind it",
      {"strips", "pairs", "RMS before", "RMS after", "mean before", "mean after"},
      {}};
  for (const PairFit& pair : result.pairs) {
    table.rows.push_back({pair.a + " : " + pair.b, grouped(pair.correspondences),
                          numberText(pair.rms_before, 4), numberText(pair.rms_after, 4),
                          numberText(pair.mean_before, 4), numberText(pair.mean_after, 4)});
  }
  return table;
}

ReportTable controlTable(const CalibrationResult& result) {
  ReportTable table{"control",
                    "Heights of strips above control, m",
                    {"strip", "points", "RMS before", "RMS after", "mean before", "mean after"},
                    {}};
  for (const ControlFit& fit : result.control) {
    table.rows.push_back({fit.strip, grouped(fit.points), numberText(fit.rms_before, 4),
                          numberText(fit.rms_after, 4), numberText(fit.mean_before, 4),
                          numberText(fit.mean_after, 4)});
  }
  return table;
}

ReportTable controlPointTable(const CalibrationResult& result) {
  ReportTable table{"",
                    "Mean height of the strips above each control point (or distance along another "
                    "component: normal of a patch, east and north of a target), m",
                    {"point", "component", "strips", "before", "after", "expected std", "used"},
                    {}};
  for (const ControlPointFit& fit : result.control_points) {
    table.rows.push_back({fit.id, fit.component, grouped(fit.strips), numberText(fit.before, 4),
                          numberText(fit.after, 4), numberText(fit.expected_std, 4),
                          fit.used ? "yes" : "no: outlier"});
  }
  return table;
}

/// What was held fixed.
ReportTable heldTable(const CalibrationResult& result) {
  ReportTable table{"held",
                    "Held fixed, not corrected: distances of strips above it, and its height above "
                    "the rest of the block if that were not known, m",
                    {"surface", "strips", "pairs", "RMS before", "RMS after", "mean before",
                     "mean after", "height", "std"},
                    {}};
  for (const FixedSurface& s : result.held) {
    std::string strips;
    for (const std::string& strip : s.strips) strips += (strips.empty() ? "" : ", ") + strip;
    table.rows.push_back({s.name, strips, grouped(s.correspondences), numberText(s.rms_before, 4),
                          numberText(s.rms_after, 4), numberText(s.mean_before, 4),
                          numberText(s.mean_after, 4),
                          s.offset_determined ? numberText(s.offset, 4) : "not determined",
                          s.offset_determined ? numberText(s.offset_std, 4) : ""});
  }
  return table;
}

/// Numbered as on the map.
ReportTable largeCorrectionTable(const CalibrationResult& result) {
  ReportTable table{
      "large_corrections",
      "Largest errors of the trajectory, assumed − true; times: seconds, on the trajectory's "
      "clock; ratio: error over the standard deviation of an ordinary one; on the ground: how far "
      "it moves points at the edge of the swath",
      {"number", "strip", "from, s", "to, s", "axis", "error", "std", "unit", "ratio",
       "on the ground, m", "probable cause"},
      {}};
  for (const LargeCorrection& correction : result.large_corrections) {
    const TrajectoryAxis& axis = correction.axisInfo();
    const double std = correction.std / axis.internal_per_unit;
    const int digits = decimalsOfStd(std);
    table.rows.push_back(
        {std::to_string(table.rows.size() + 1), correction.strip, numberText(correction.from, 1),
         numberText(correction.to, 1), std::string(axis.name),
         numberText(correction.value / axis.internal_per_unit, digits), numberText(std, digits),
         std::string(axis.unit), numberText(correction.ratio(), 1),
         numberText(correction.on_ground, 2), causeText(correction)});
  }
  return table;
}

/// With four significant digits: the units of the errors differ by orders of magnitude.
std::string significant(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

/// What differs between the systems of a block; the parameters of the first one have their own
/// table.
ReportTable systemTable(const CalibrationResult& result) {
  ReportTable table{"systems",
                    "Systems with biases of their own, assumed − true (offsets: to the first one)",
                    {"system", "strips", "parameter", "unit", "bias", "std", "std of difference"},
                    {}};
  for (const SystemEstimate& system : result.systems) {
    const auto add = [&](std::string_view name, std::string_view unit, double value, double std,
                         double difference_std) {
      table.rows.push_back({system.group.name, grouped(system.group.strips.size()),
                            std::string(name), std::string(unit), significant(value),
                            significant(std),
                            difference_std > 0.0 ? significant(difference_std) : ""});
    };
    for (const SystemParameterInfo& info : systemParameters()) {
      const auto i = static_cast<std::size_t>(indexOf(info.parameter));
      const double here = system.parameters[i].bias, first = result.parameters[i].bias;
      const bool differs = std::any_of(
          result.systems.begin(), result.systems.end(),
          [&](const SystemEstimate& other) { return other.parameters[i].bias != first; });
      if (differs)
        add(headingOf(info.parameter), unitText(info.parameter), here / info.internal_per_unit,
            system.parameters[i].std / info.internal_per_unit,
            system.difference_std[indexOf(info.parameter)] / info.internal_per_unit);
    }
    constexpr std::array<const char*, 3> kAxes{"offset east", "offset north", "offset up"};
    for (int i = 0; i < 3; ++i)
      if (system.offset_std[i] > 0.0)
        add(kAxes[static_cast<std::size_t>(i)], "m", system.offset[i], system.offset_std[i],
            system.offset_std[i]);
  }
  return table;
}

void addParameters(HtmlReport& report, const CalibrationResult& result) {
  report.addSection("Parameters");
  report.addTable(parameterTable(result));
  if (!result.systems.empty()) report.addTable(systemTable(result));
  report.addPicture(drawParameters(result, {1400, 900}),
                    "Estimated biases with 95 % intervals; an interval shorter than its dot is not "
                    "visible; the figures on the right state it.");
  if (result.correlation_order.size() > 1) {
    report.addPicture(drawCorrelation(result, kSquare),
                      "Correlation of the estimates: near ±1, the block can hardly separate two "
                      "parameters.");
  }
  if (!result.observability.empty()) {
    report.addText("What the block determines:");
    report.addList(result.observability);
  }
}

void addDiagnosis(HtmlReport& report, const CalibrationResult& result) {
  if (result.diagnosis.empty()) return;
  report.addSection("Diagnosis");
  report.addText(
      "Probability that each error is present, given the data; its size (assumed - true) where it "
      "is; and how far it moves points at the edge of the highest swath.");
  ReportTable table{
      "",
      "Possible causes of the misfit",
      {"error", "probability", "value", "std", "unit", "effect, mm", "corrected", "evidence"},
      {}};
  for (const ErrorFinding& f : result.diagnosis) {
    if (f.determined) {
      table.rows.push_back({f.title, numberText(f.probability, 3), significant(f.value),
                            significant(f.std), f.unit, numberText(1000.0 * f.effect, 1),
                            f.corrected ? "yes" : "no", f.evidence});
    } else {
      table.rows.push_back({f.title, "not determined", "", "", f.unit, "", "no", f.evidence});
    }
  }
  report.addTable(table);
  const std::vector<std::string> remedies = remediesOf(result);
  if (!remedies.empty()) report.addList(remedies);
  if (!result.scan_angle_curve.empty())
    report.addPicture(drawScanAngleCurve(result, kWide),
                      "Errors of the scan angle that depend on the scan angle.");
}

void addFits(HtmlReport& report, const CalibrationResult& result) {
  report.addSection("Fit");
  report.addTable(pairTable(result));
  if (!result.pairs.empty()) {
    report.addPicture(drawPairs(result, {1400, heightForRows(result.pairs.size())}),
                      "Fit of every pair of overlapping strips before and after.");
  }
  if (!result.residuals.edges.empty()) {
    report.addPicture(drawResiduals(result, kWide),
                      "Normal distances of all pairs before and after.");
  }
  if (!result.control.empty()) report.addTable(controlTable(result));
  if (!result.control_points.empty()) report.addTable(controlPointTable(result));
  if (!result.held.empty()) report.addTable(heldTable(result));
  if (!result.iterations.empty()) {
    report.addPicture(drawConvergence(result, kWide), "Update and fit by iteration.");
  }
  if (!result.large_corrections.empty()) report.addTable(largeCorrectionTable(result));
  if (!result.strip_errors.empty()) {
    report.addPicture(drawStripErrors(result, {1400, 760}),
                      "What each strip's trajectory was found to be wrong by, over time.");
  }
}

/// A roof before and after, as in Figure 4 of Habib et al. 2011.
void addProfile(HtmlReport& report, const SurveyReader& survey, const CalibrationResult& result,
                const std::shared_ptr<const Trajectory>& trajectory) {
  if (!result.converged) return;
  report.addSection("Profile");
  const auto profile = findProfile(survey, BiasEvaluator(trajectory, result.biases()));
  if (!profile || profile->after.seen() == 0) {
    report.addText("No two strips cover the same gable roof or slope.");
    return;
  }
  SectionPicture picture;
  picture.setTitle("Where the misfit of the strips shows best");
  picture.setStrips(survey.strips());
  picture.addPanel("As delivered", profile->before);
  picture.addPanel("Calibrated", profile->after);
  // High enough that heights are not drawn smaller than lengths, if the page permits.
  PictureSize size{1400, 800};
  while (size.height < 1600 && picture.exaggeration(size) < 1.0) size.height += 100;
  report.addPicture(picture.draw(size),
                    "Section through a " + describe(profile->place) +
                        " before; points by strip, as delivered and calibrated on the same axes.");
}

void addSummary(HtmlReport& report, const CalibrationResult& result) {
  report.addText("sigma0 " + numberText(result.sigma0, 3) + ", redundancy " +
                 grouped(static_cast<std::size_t>(std::max(0L, result.redundancy))) + ", " +
                 std::to_string(result.iterations.size()) + " iterations, model " +
                 std::string(modelName(result.attitude)) + ", " +
                 (result.converged ? "converged." : "not converged."));
  addWarnings(result.warnings, report);
}

}  // namespace

struct CalibrationPage::State {
  const SurveyReader* survey = nullptr;
  ObservedBlock block;
};

CalibrationPage::CalibrationPage(bool wanted) {
  if (wanted) state_ = std::make_unique<State>();
}

CalibrationPage::~CalibrationPage() = default;

SurveyObserver CalibrationPage::observer() {
  if (!state_) return {};
  SurveyObserver observer = state_->block.observer();
  observer.begin = [this, collect = std::move(observer.begin)](const SurveyReader& survey) {
    state_->survey = &survey;
    collect(survey);
  };
  return observer;
}

void CalibrationPage::write(const ReportOrigin& origin, const CalibrationResult& result,
                            const std::vector<SurveyArea>& areas,
                            const std::shared_ptr<const Trajectory>& trajectory) const {
  HtmlReport report(
      origin.titleOr("Calibration of " + std::to_string(state_->block.strips.size()) + " strips"),
      origin.program);
  addVerdict(verdictOf(result), report);
  addSummary(report, result);
  addParameters(report, result);
  addDiagnosis(report, result);
  addFits(report, result);

  addProfile(report, *state_->survey, result, trajectory);
  addMap(origin.control, *state_->block.coverage, state_->block.strips, areas, report,
         result.large_corrections);
  addOrigin(origin, result.inputs, report);
  report.write(origin.folder);
}

}  // namespace pcl_als
