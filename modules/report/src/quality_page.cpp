// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/number_text.h>
#include <pcl_als/report/quality_page.h>

#include "quality_pictures.h"
#include "quality_verdict.h"
#include "report_parts.h"

namespace pcl_als {
namespace {

/// Numbers as they are written in text: with a true minus sign.
std::string shown(std::string cell) {
  if (cell.size() > 1 && cell[0] == '-') cell.replace(0, 1, "−");
  return cell;
}

void addQualityTable(const QualityTable& table, HtmlReport& report) {
  if (table.rows.empty()) return;
  ReportTable shown_table{"", table.caption, table.columns, {}, table.failed};
  for (const auto& row : table.rows) {
    auto& cells = shown_table.rows.emplace_back();
    for (const std::string& cell : row) cells.push_back(cell == "-" ? "" : shown(cell));
  }
  report.addTable(std::move(shown_table));
}

void addPictures(const QualityReport& quality, HtmlReport& report) {
  const BeforeAfterPlot heights = heightPlot(quality);
  if (!heights.rows.empty())
    report.addPicture(drawBeforeAfter(heights, {1400, heightForRows(heights.rows.size())}),
                      "RMSDz of every pair against the limits of the quality levels.");
  if (const auto histogram = offsetHistogram(quality))
    report.addPicture(drawHistogram(*histogram, kWide),
                      "Height differences on level ground, at most " +
                          grouped(CheckedPair::kScatter) + " places of a pair.");
  static constexpr std::pair<OffsetAgainst, const char*> kOffsets[] = {
      {OffsetAgainst::distance,
       "Offsets across the overlap: a line that slopes shows an error of roll or scan angle "
       "scale."},
      {OffsetAgainst::scan_angle, "Offsets over the scan angle of the first strip."},
      {OffsetAgainst::time,
       "Offsets over time: waves and steps come from the trajectory. Bars: standard deviation of "
       "the mean, as if places were independent."}};
  for (const auto& [against, caption] : kOffsets) {
    const CurvePanels panels = offsetPanels(quality, against);
    if (panels.panels.empty()) continue;
    report.addPicture(drawCurvePanels(panels, panels.panels.size() > 4 ? kTall : kWide), caption);
  }
}

void addSeparation(const QualityReport& quality, HtmlReport& report) {
  const auto map = separationMap(quality, 1400);
  if (!map) return;
  report.addSection("Swath separation");
  report.addPicture(*map,
                    "Highest minus lowest strip, cell by cell; each dot shows what most of its "
                    "cells are. Trees, eaves and walls separate strips, too. In full: " +
                        quality.block.separation->files.back() + " and GeoTIFFs beside this page.");
}

std::vector<std::string> inputsOf(const QualityReport& quality) {
  std::vector<std::string> inputs = quality.block.files;
  if (quality.before)
    inputs.insert(inputs.end(), quality.before->files.begin(), quality.before->files.end());
  return inputs;
}

}  // namespace

struct QualityPage::State {
  ObservedBlock block;
};

QualityPage::QualityPage(bool wanted) {
  if (wanted) state_ = std::make_unique<State>();
}

QualityPage::~QualityPage() = default;

SurveyObserver QualityPage::observer() {
  return state_ ? state_->block.observer() : SurveyObserver();
}

const std::vector<std::string>& QualityPage::strips() const {
  return state_->block.strips;
}

const StripCoverage& QualityPage::coverage() const {
  return *state_->block.coverage;
}

void QualityPage::write(const ReportOrigin& origin, const QualityReport& quality,
                        const std::vector<SurveyArea>& areas) const {
  HtmlReport report(
      origin.titleOr("Check of " + std::to_string(state_->block.strips.size()) + " strips"),
      origin.program);
  addVerdict(verdictOf(quality), report);
  addWarnings(quality.block.warnings, report);
  const std::vector<QualityTable> tables = qualityTables(quality);
  const std::size_t of_pairs = tables.size() - (quality.block.control ? 1 : 0);
  if (!quality.block.pairs.empty()) report.addSection("Strips against each other");
  addQualityTable(tables[0], report);
  addPictures(quality, report);
  for (std::size_t i = 1; i < of_pairs; ++i) addQualityTable(tables[i], report);
  if (quality.block.control) {
    report.addSection("Control");
    addQualityTable(tables.back(), report);
  }
  addSeparation(quality, report);
  addMap(origin.control, *state_->block.coverage, state_->block.strips, areas, report);
  addOrigin(origin, inputsOf(quality), report);
  report.write(origin.folder);
}

}  // namespace pcl_als
