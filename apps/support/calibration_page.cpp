// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "calibration_page.h"

#include <algorithm>

#include <pcl_als/io/survey_io.h>
#include <pcl_als/visualization/block_map.h>
#include <pcl_als/visualization/calibration_plots.h>
#include <pcl_als/visualization/html_report.h>
#include <pcl_als/visualization/ticks.h>

#include "calibration_verdict.h"

namespace pcl_als::app {
namespace {

constexpr PictureSize kWide{1400, 640}, kSquare{1200, 900};

ReportTable parameterTable(const CalibrationResult& result) {
  ReportTable table{"parameters",
                    "Biases, assumed − true. std: what the pairs share is accounted for; formal "
                    "std: pairs taken as independent (Habib et al. 2011, Eq. 26)",
                    {"parameter", "unit", "bias", "std", "formal std", "status"},
                    {}};
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    const int digits = info.unit == "m" ? 4 : info.unit == "arcsec" ? 2 : 7;
    const bool known = estimate.status == ParameterStatus::estimated;
    const auto cell = [&](double value) {
      return known ? numberText(value / info.internal_per_unit, digits) : std::string();
    };
    std::string status(toString(estimate.status));
    if (!estimate.reason.empty()) status += ": " + estimate.reason;
    table.rows.push_back({std::string(info.name), std::string(info.unit), cell(estimate.bias),
                          cell(estimate.std), cell(estimate.std_formal), status});
  }
  return table;
}

ReportTable pairTable(const CalibrationResult& result) {
  ReportTable table{"",
                    "Normal distances of point-patch pairs, m; mean: first strip above the second",
                    {"strips", "pairs", "RMS before", "RMS after", "mean before", "mean after"},
                    {}};
  for (const PairFit& pair : result.pairs) {
    table.rows.push_back({pair.a + " : " + pair.b, countText(pair.correspondences),
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
    table.rows.push_back({fit.strip, countText(fit.points), numberText(fit.rms_before, 4),
                          numberText(fit.rms_after, 4), numberText(fit.mean_before, 4),
                          numberText(fit.mean_after, 4)});
  }
  return table;
}

void addParameters(HtmlReport& report, const CalibrationResult& result) {
  report.addSection("Parameters");
  report.addTable(parameterTable(result));
  report.addPicture(drawParameters(result, {1400, 900}).image(),
                    "Estimated biases with 95 % intervals; an interval shorter than its dot is not "
                    "seen, the figures on the right give it.");
  if (result.correlation_order.size() > 1) {
    report.addPicture(drawCorrelation(result, kSquare).image(),
                      "Correlation of the estimates: near ±1, the block can hardly tell two "
                      "parameters apart.");
  }
  if (!result.observability.empty()) {
    report.addText("What the block determines:");
    report.addList(result.observability);
  }
}

void addFits(HtmlReport& report, const CalibrationResult& result) {
  report.addSection("Fit");
  report.addTable(pairTable(result));
  if (!result.pairs.empty()) {
    const int rows = static_cast<int>(std::min<std::size_t>(result.pairs.size(), 60));
    report.addPicture(drawPairs(result, {1400, 220 + 26 * rows}).image(),
                      "Fit of every pair of overlapping strips before and after.");
  }
  if (!result.residuals.edges.empty()) {
    report.addPicture(drawResiduals(result, kWide).image(),
                      "Normal distances of all pairs before and after.");
  }
  if (!result.control.empty()) report.addTable(controlTable(result));
  if (!result.iterations.empty()) {
    report.addPicture(drawConvergence(result, kWide).image(), "Update and fit by iteration.");
  }
  if (!result.strip_errors.empty()) {
    report.addPicture(drawStripErrors(result, {1400, 760}).image(),
                      "What each strip's trajectory was found to be wrong by, over time.");
  }
}

void addSummary(HtmlReport& report, const CalibrationResult& result) {
  report.addText("sigma0 " + numberText(result.sigma0, 3) + ", redundancy " +
                 countText(static_cast<std::size_t>(std::max(0L, result.redundancy))) + ", " +
                 std::to_string(result.iterations.size()) + " iterations, model " +
                 std::string(modelName(result.attitude)) + ", " +
                 (result.converged ? "converged." : "not converged."));
  if (result.warnings.empty()) return;
  report.addSection("Warnings");
  report.addList(result.warnings);
}

}  // namespace

struct CalibrationPage::State {
  const SurveyReader& survey;
  StripCoverage coverage;
};

CalibrationPage::CalibrationPage(const SurveyReader& survey, bool wanted) {
  if (!wanted) return;
  state_ = std::make_unique<State>(
      State{survey, {survey.corner(), survey.farCorner(), survey.strips().size()}});
}

CalibrationPage::~CalibrationPage() = default;

bool CalibrationPage::draws() {
  return true;
}

void CalibrationPage::add(int strip, const CalibrationPoint* points, std::size_t count) {
  if (!state_) return;
  for (std::size_t i = 0; i < count; ++i) {
    state_->coverage.add(points[i].position, static_cast<std::size_t>(strip));
  }
}

void CalibrationPage::write(const CommandLine& line, const CalibrationResult& result,
                            const std::vector<SurveyArea>& areas) const {
  HtmlReport report("Calibration of " + std::to_string(state_->survey.strips().size()) + " strips",
                    line.toolAndVersion());
  const CalibrationVerdict verdict = verdictOf(result);
  report.setVerdict(verdict.grade, verdict.headline);
  for (const std::string& sentence : verdict.sentences) report.addVerdict(sentence);
  addSummary(report, result);
  addParameters(report, result);
  addFits(report, result);

  BlockMap map;
  map.setTitle("Strips, overlaps and the areas that were used");
  std::vector<BlockMap::Area> boxes;
  for (const SurveyArea& area : areas) {
    boxes.push_back({area.minimum, area.minimum + Eigen::Vector2d::Constant(area.size)});
  }
  map.setAreas(std::move(boxes));
  if (line.has("control")) {
    std::vector<Eigen::Vector2d> places;
    for (const ControlPoint& point : readControl(line.text("control"))) {
      places.emplace_back(point.position.head<2>());
    }
    map.setControl(std::move(places));
  }
  report.addSection("Map");
  report.addPicture(map.draw(state_->coverage, state_->survey.strips(), {1400, 1000}).image(),
                    "Outlines of the strips, how many see a place, areas that were used, control.");
  for (const std::string& input : result.inputs) report.addInput(input);
  for (const auto& [name, value] : line.settings()) report.addSetting(name, value);
  report.write(line.text("report"));
}

}  // namespace pcl_als::app
