// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <sstream>

#include <pcl_als/common/class_name.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/curve_panels.h>
#include <pcl_als/drawing/row_plots.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/report/intensity_page.h>

#include "intensity_verdict.h"
#include "report_parts.h"

namespace pcl_als {
namespace {

constexpr std::size_t kBins = 64;     // of a histogram
constexpr std::size_t kFewest = 100;  // points that a ratio is drawn of
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

class PairTable {
 public:
  PairTable(const std::string& first, const std::string& caption) {
    table_.caption = caption;
    table_.columns = {first,        "points",   "mean before",          "sd before",
                      "mean after", "sd after", "variance/mean before", "after",
                      "change, %"};
  }
  void add(const std::string& name, const BeforeAfter& pair, double scale) {
    if (pair.before.count() == 0) return;
    const double before = varianceToMean(pair.before), after = scale * varianceToMean(pair.after);
    table_.rows.push_back(
        {name, grouped(pair.before.count()), numberText(pair.before.mean(), 1),
         numberText(pair.before.standardDeviation(), 1), numberText(pair.after.mean(), 1),
         numberText(pair.after.standardDeviation(), 1), numberText(before, 2), numberText(after, 2),
         before > 0.0 ? numberText(100.0 * (after / before - 1.0), 1) : ""});
  }
  const ReportTable& table() const { return table_; }

 private:
  ReportTable table_;
};

void addSlopes(const IntensityReport& intensity, HtmlReport& report) {
  const IntensityStatistics& statistics = intensity.result->outcome.statistics;
  const double scale = meanScale(statistics.all());
  PairTable table("slope, degrees", "Intensities by slope of the surface");
  CurvePlot plot{"Variance to mean of intensity by slope",
                 "slope of the surface, degrees",
                 "variance / mean",
                 {{"before", {}, {}, {}}, {"after", {}, {}, {}}}};
  for (std::size_t bin = 0; bin <= IntensityStatistics::kSlopeBins; ++bin) {
    const BeforeAfter pair = statistics.slope(bin);
    table.add(slopeName(bin), pair, scale);
    if (bin == IntensityStatistics::kSlopeBins || pair.before.count() < kFewest) continue;
    const double middle = IntensityStatistics::kSlopeStep * (static_cast<double>(bin) + 0.5);
    for (CurvePlot::Series& series : plot.series) series.x.push_back(middle);
    plot.series[0].y.push_back(varianceToMean(pair.before));
    plot.series[1].y.push_back(scale * varianceToMean(pair.after));
  }
  report.addSection("By slope");
  if (!plot.series[0].x.empty())
    report.addPicture(
        drawCurves(plot, kWide),
        "Variance-to-mean ratio before and after, at the same mean of all points; slopes with " +
            std::to_string(kFewest) + " points or more.");
  report.addTable(table.table());
}

void addClasses(const IntensityReport& intensity, HtmlReport& report) {
  const IntensityStatistics& statistics = intensity.result->outcome.statistics;
  PairTable table("class", "Intensities by class");
  for (int code = 0; code < 256; ++code)
    table.add(className(code), statistics.classOf(static_cast<std::uint8_t>(code)),
              meanScale(statistics.all()));
  report.addSection("By class");
  report.addTable(table.table());
}

/// Shares of values in bins up to the intensity that nearly all are below.
CurvePlot::Series histogramSeries(const std::string& name, const std::vector<std::uint64_t>& counts,
                                  std::size_t width, std::size_t bins) {
  CurvePlot::Series series;
  series.name = name;
  double sum = 0.0;
  for (const std::uint64_t count : counts) sum += static_cast<double>(count);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    double inside = 0.0;
    for (std::size_t i = bin * width; i < std::min((bin + 1) * width, counts.size()); ++i)
      inside += static_cast<double>(counts[i]);
    series.x.push_back((static_cast<double>(bin) + 0.5) * static_cast<double>(width) - 0.5);
    series.y.push_back(sum > 0.0 ? 100.0 * inside / sum : kNothing);
  }
  return series;
}

/// The intensity that 99 % of a strip's values do not exceed.
std::size_t mostOf(const std::vector<std::uint64_t>& counts) {
  std::uint64_t all = 0, below = 0;
  for (const std::uint64_t count : counts) all += count;
  std::size_t value = 0;
  while (value + 1 < counts.size() && (below += counts[value]) * 100 < all * 99) ++value;
  return value;
}

void addHistograms(const IntensityReport& intensity, HtmlReport& report) {
  const std::vector<IntensityHistogram>& histograms = intensity.result->outcome.histograms;
  std::size_t most = 1;
  for (const IntensityHistogram& histogram : histograms)
    most = std::max({most, mostOf(histogram.before), mostOf(histogram.after)});
  const std::size_t width = most / kBins + 1, bins = most / width + 1;
  CurvePanels plot;
  plot.title = "Intensities by strip";
  plot.x_label = "intensity as written in the file";
  plot.y_label = "share, %";
  for (std::size_t strip = 0; strip < histograms.size(); ++strip) {
    const IntensityHistogram& histogram = histograms[strip];
    if (mostOf(histogram.before) == 0) continue;
    plot.panels.push_back({"strip " + intensity.result->run->strips()[strip],
                           {histogramSeries("before", histogram.before, width, bins),
                            histogramSeries("after", histogram.after, width, bins)}});
  }
  if (plot.panels.empty()) return;
  if (plot.panels.size() > CurvePanels::kMaximumPanels)
    plot.title += " (" + std::to_string(CurvePanels::kMaximumPanels) + " of " +
                  std::to_string(plot.panels.size()) + ")";
  plot.keepLargest();
  report.addPicture(
      drawCurvePanels(plot, plot.panels.size() > 4 ? kTall : kWide),
      "Histograms of the strips in bins of " + std::to_string(width) + ", before and after.");
}

void addGains(const IntensityReport& intensity, HtmlReport& report) {
  IntervalPlot plot;
  plot.title = "Gains of the strips with 95 % intervals";
  plot.x_label = "factor on what the strip received";
  plot.reference = 1.0;
  bool any = false;
  for (std::size_t i = 0; i < intensity.result->run->strips().size() && i < 60; ++i) {
    const EstimatedTerm& gain = intensity.result->overlaps->gains[i];
    const bool known = gain.status == TermStatus::estimated;
    any = any || known;
    plot.rows.push_back(
        {"strip " + intensity.result->run->strips()[i], gain.value,
         known ? gain.value * gain.std : kNothing,
         known ? numberText(gain.value, 4) + " ± " + numberText(gain.value * gain.std, 4)
               : std::string(nameOf(gain.status))});
  }
  if (!any) return;
  report.addPicture(drawIntervals(plot, {1400, heightForRows(plot.rows.size())}),
                    "Gains that the overlaps show; their geometric mean is 1.");
}

void addStrips(const IntensityReport& intensity, HtmlReport& report) {
  const IntensityStatistics& statistics = intensity.result->outcome.statistics;
  PairTable table("strip", "Intensities by strip; ratios at the mean of the strip");
  for (std::size_t i = 0; i < statistics.strips(); ++i)
    table.add(intensity.result->run->strips()[i], statistics.strip(i),
              meanScale(statistics.strip(i)));
  report.addSection("By strip");
  addHistograms(intensity, report);
  if (intensity.result->overlaps) addGains(intensity, report);
  report.addTable(table.table());
}

/// Lines of a text as a list.
void addLines(const std::string& text, HtmlReport& report) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t start = line.find_first_not_of(' ');
    if (start != std::string::npos) lines.push_back(line.substr(start));
  }
  report.addList(std::move(lines));
}

void addEstimates(const IntensityReport& intensity, HtmlReport& report) {
  if (intensity.result->overlaps) {
    report.addSection("Overlaps");
    addLines(overlapText(*intensity.result->overlaps, intensity.result->run->strips()), report);
  }
  if (!intensity.result->reference) return;
  report.addSection("Targets");
  addLines(referenceText(*intensity.result->reference), report);
}

void addPoints(const IntensityReport& intensity, HtmlReport& report) {
  report.addSection("Points");
  for (std::size_t i = 0; i < intensity.result->run->files(); ++i) {
    report.addText(intensity.result->run->input(i).path());
    addLines(countsText(intensity.result->outcome.counts[i], *intensity.result->run), report);
  }
}

StripCoverage emptyCoverage(const IntensityRun& run) {
  Eigen::AlignedBox2d box;
  for (std::size_t i = 0; i < run.files(); ++i) {
    for (const PointSource& source : run.input(i).survey().sources.sources) {
      box.extend(Eigen::Vector2d(source.minimum.head<2>()));
      box.extend(Eigen::Vector2d(source.maximum.head<2>()));
    }
  }
  if (box.isEmpty() || run.strips().empty()) box.extend(Eigen::Vector2d(Eigen::Vector2d::Zero()));
  return {box.min(), box.max(), std::max<std::size_t>(1, run.strips().size())};
}

class DrawnIntensityPage : public IntensityPage {
 public:
  IntensityOptions::SeenPoint observe(const IntensityRun& run) override {
    coverage_.emplace(emptyCoverage(run));
    return [this](int strip, const Eigen::Vector3d& place) {
      coverage_->add(place, static_cast<std::size_t>(strip));
    };
  }
  void write(const ReportOrigin& origin, const IntensityReport& intensity) const override;

 private:
  std::optional<StripCoverage> coverage_;
};

void DrawnIntensityPage::write(const ReportOrigin& origin, const IntensityReport& intensity) const {
  const IntensityRun& run = *intensity.result->run;
  HtmlReport report(
      origin.titleOr("Intensity of " + std::to_string(run.strips().size()) + " strips"),
      origin.program);
  addVerdict(verdictOf(intensity), report);
  addWarnings(intensity.result->warnings, report);
  addSlopes(intensity, report);
  addStrips(intensity, report);
  addClasses(intensity, report);
  addEstimates(intensity, report);
  addPoints(intensity, report);
  if (!run.strips().empty()) addMap(origin.control, *coverage_, run.strips(), {}, report);
  std::vector<std::string> inputs;
  for (std::size_t i = 0; i < run.files(); ++i) inputs.push_back(run.input(i).path());
  addOrigin(origin, inputs, report);
  report.write(origin.folder);
}

}  // namespace

std::unique_ptr<IntensityPage> makeIntensityPage() {
  return std::make_unique<DrawnIntensityPage>();
}

}  // namespace pcl_als
