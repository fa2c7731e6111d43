// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "quality_pictures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/class_map.h>

namespace pcl_als {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kRows = 60, kBins = 60;

const std::vector<ProfileBin>& binsOf(const CheckedPair& pair, OffsetAgainst against) {
  const OverlapTrends& trends = pair.assessment.trends;
  return against == OffsetAgainst::distance     ? trends.by_distance
         : against == OffsetAgainst::scan_angle ? trends.by_scan_angle
                                                : trends.by_time;
}

CurvePlot::Series seriesOf(const std::string& name, const std::vector<ProfileBin>& bins,
                           double start) {
  CurvePlot::Series series;
  series.name = name;
  for (const ProfileBin& bin : bins) {
    if (bin.count == 0) continue;
    series.x.push_back(0.5 * (bin.from + bin.to) - start);
    series.y.push_back(bin.mean);
    series.std.push_back(bin.std / std::sqrt(static_cast<double>(bin.count)));
  }
  return series;
}

/// Samples of level ground.
std::vector<double> heightsOf(const CheckedBlock& block) {
  std::vector<double> heights;
  for (const CheckedPair& pair : block.pairs) {
    if (!judged(pair)) continue;
    for (const OffsetSample& sample : pair.samples)
      if (sample.level) heights.push_back(sample.vertical);
  }
  return heights;
}

/// Limit on both sides of zero that contains most values.
double reachOf(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto most = values.begin() + static_cast<std::ptrdiff_t>(0.99 * values.size());
  std::nth_element(values.begin(), most, values.end());
  return std::max(1.15 * *most, 0.01);
}

std::vector<double> countsIn(const std::vector<double>& edges, const std::vector<double>& values) {
  std::vector<double> counts(edges.size() - 1, 0.0);
  const double width = edges[1] - edges[0];
  for (const double value : values) {
    const double bin = std::floor((value - edges.front()) / width);
    if (bin >= 0.0 && bin < static_cast<double>(counts.size()))
      ++counts[static_cast<std::size_t>(bin)];
  }
  return counts;
}

ClassRaster rasterOf(const SeparationOverview& overview) {
  return {overview.columns, overview.rows, overview.cell, overview.north_west, overview.codes};
}

}  // namespace

BeforeAfterPlot heightPlot(const QualityReport& report) {
  BeforeAfterPlot plot;
  plot.title = "Height differences of overlapping strips on level ground";
  plot.x_label = "RMSDz, m";
  plot.before = "before";
  plot.after = report.before ? "after" : "strips as given";
  for (const CheckedPair& pair : report.block.pairs) {
    if (!judged(pair)) continue;
    const CheckedPair* before = pairBefore(report, pair);
    const bool known = before != nullptr && judged(*before);
    plot.rows.push_back({pair.a + " : " + pair.b,
                         known ? before->assessment.vertical.rms : kNothing,
                         pair.assessment.vertical.rms});
  }
  if (plot.rows.size() > kRows) plot.title += " (the " + std::to_string(kRows) + " largest)";
  plot.keepLargest(kRows);
  std::string names;
  const auto& levels = qualityLevels();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    names += (names.empty() ? "QL" : ", QL") + std::to_string(levels[i].level);
    const double limit = levels[i].swath_overlap_rmsdz;
    if (i + 1 < levels.size() && levels[i + 1].swath_overlap_rmsdz == limit) continue;
    plot.limits.push_back({names, limit});
    names.clear();
  }
  return plot;
}

CurvePanels offsetPanels(const QualityReport& report, OffsetAgainst against) {
  static const char* const kAgainst[] = {"distance from the centre line of the overlap, m",
                                         "scan angle of the first strip, degrees",
                                         "time of the first strip, s from the overlap's start"};
  CurvePanels plot;
  plot.x_label = kAgainst[static_cast<int>(against)];
  static const char* const kTitles[] = {"across the overlap", "over the scan angle", "over time"};
  plot.title = std::string("Height of the first strip above the second, ") +
               kTitles[static_cast<int>(against)];
  plot.y_label = "offset, m";
  plot.common_x = against != OffsetAgainst::time;
  for (const CheckedPair& pair : report.block.pairs) {
    if (!judged(pair)) continue;
    CurvePanels::Panel panel;
    panel.title = pair.a + " : " + pair.b;
    const auto& bins = binsOf(pair, against);
    const double start = against == OffsetAgainst::time && !bins.empty() ? bins.front().from : 0.0;
    const CheckedPair* before = pairBefore(report, pair);
    if (before != nullptr && judged(*before))
      panel.series.push_back(seriesOf("before", binsOf(*before, against), start));
    panel.series.push_back(seriesOf(report.before ? "after" : "as given", bins, start));
    const bool any = std::any_of(panel.series.begin(), panel.series.end(),
                                 [](const auto& series) { return !series.x.empty(); });
    if (any) plot.panels.push_back(std::move(panel));
  }
  if (plot.panels.size() > CurvePanels::kMaximumPanels)
    plot.title +=
        " (the " + std::to_string(CurvePanels::kMaximumPanels) + " pairs with the largest)";
  plot.keepLargest();
  return plot;
}

std::optional<HistogramPlot> offsetHistogram(const QualityReport& report) {
  const std::vector<double> after = heightsOf(report.block);
  const std::vector<double> before =
      report.before ? heightsOf(*report.before) : std::vector<double>();
  if (after.empty()) return std::nullopt;
  const double reach = std::max(reachOf(after), before.empty() ? 0.0 : reachOf(before));
  HistogramPlot plot;
  plot.title = "Height differences at places of all pairs";
  plot.x_label = "first strip above the second, m";
  for (std::size_t i = 0; i <= kBins; ++i)
    plot.edges.push_back(reach * (2.0 * static_cast<double>(i) / kBins - 1.0));
  if (!before.empty()) plot.series.push_back({"before", countsIn(plot.edges, before)});
  plot.series.push_back({report.before ? "after" : "as given", countsIn(plot.edges, after)});
  return plot;
}

std::optional<Canvas> separationMap(const QualityReport& report, int width) {
  if (!report.block.separation) return std::nullopt;
  const SeparationSummary& separation = *report.block.separation;
  const std::string once = numberText(100.0 * separation.limit, 0) + " cm",
                    twice = numberText(200.0 * separation.limit, 0) + " cm";
  ClassMapPicture picture;
  picture.setTitle("Vertical separation of strips");
  picture.setLegendHeading("separation");
  // Green, yellow and red as the specification asks, in tones that readers of any colour vision
  // tell apart.
  picture.setClasses({{SeparationOverview::within_limit, "up to " + once, Color::rgb(0x009e73)},
                      {SeparationOverview::within_twice, "up to " + twice, Color::rgb(0xf0e442)},
                      {SeparationOverview::beyond, "more", Color::rgb(0xb2182b)},
                      {SeparationOverview::one_strip, "one strip", Color::rgb(0xc4c4c4)}});
  if (report.before && report.before->separation)
    picture.addMap("Before", rasterOf(report.before->separation->overview));
  picture.addMap(report.before ? "After" : "", rasterOf(separation.overview));
  return picture.draw(width, picture.heightFor(width));
}

}  // namespace pcl_als
