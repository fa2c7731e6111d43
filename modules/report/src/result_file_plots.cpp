// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/field_node.h>
#include <pcl_als/common/input_file.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/drawing/calibration_plots.h>
#include <pcl_als/drawing/curve_panels.h>
#include <pcl_als/drawing/row_plots.h>
#include <pcl_als/drawing/waveform_plot.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/report/picture/result_file_plots.h>
#include <pcl_als/report/waveform_report.h>

namespace pcl_als {
namespace {

using Json = nlohmann::json;

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& value : list) {
    values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN()
                                     : value.get<double>());
  }
  return values;
}

/// Names become file names: characters other than letters, digits, - and _ are replaced.
std::string fileName(std::string name) {
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
  }
  return name.empty() ? "plot" : name;
}

void addCalibration(const std::filesystem::path& file, std::vector<NamedPlot>& plots) {
  const CalibrationResult result = readCalibration(file);
  using Draw = Canvas (*)(const CalibrationResult&, PictureSize);
  const auto add = [&](const char* name, Draw draw, bool possible) {
    if (!possible) return;
    plots.push_back({name, [result, draw](PictureSize size) { return draw(result, size); }});
  };
  add("parameters", drawParameters, true);
  add("correlation", drawCorrelation, !result.correlation_order.empty());
  add("pairs", drawPairs, !result.pairs.empty());
  add("convergence", drawConvergence, !result.iterations.empty());
  add("residuals", drawResiduals, !result.residuals.edges.empty());
  add("scan_angle_curve", drawScanAngleCurve, !result.scan_angle_curve.empty());
  add("strip_errors", drawStripErrors, !result.strip_errors.empty());
}

void addCurves(const Json& curves, std::vector<NamedPlot>& plots) {
  for (const Json& entry : curves) {
    CurvePlot plot{entry.value("title", ""), entry.at("x"), entry.at("y"), {}};
    for (const Json& series : entry.at("series")) {
      plot.series.push_back(
          {series.value("name", ""), numbers(series.at("x")), numbers(series.at("y")),
           series.contains("std") ? numbers(series["std"]) : std::vector<double>{}});
    }
    plots.push_back(
        {fileName(entry.at("name")), [plot](PictureSize size) { return drawCurves(plot, size); }});
  }
}

void addHistograms(const Json& histograms, std::vector<NamedPlot>& plots) {
  for (const Json& entry : histograms) {
    HistogramPlot plot{entry.value("title", ""), entry.at("x"), numbers(entry.at("edges")), {}};
    for (const Json& series : entry.at("series")) {
      plot.series.push_back({series.value("name", ""), numbers(series.at("counts"))});
    }
    plots.push_back({fileName(entry.at("name")),
                     [plot](PictureSize size) { return drawHistogram(plot, size); }});
  }
}

void addConfusion(const Json& confusion, std::vector<NamedPlot>& plots) {
  ConfusionPlot plot{"Confusion matrix", confusion.at("classes"), {}};
  for (const Json& row : confusion.at("matrix")) plot.matrix.push_back(numbers(row));
  plots.push_back({"confusion", [plot](PictureSize size) { return drawConfusion(plot, size); }});
}

std::string pairName(const Json& pair) {
  return pair.value("a", "") + " : " + pair.value("b", "");
}

/// Offsets of a pair in bins of a quantity, as pcl_als_check writes them; x counts from \a start.
CurvePlot::Series offsetSeries(const std::string& name, const Json& pair, const char* key,
                               double start) {
  CurvePlot::Series series;
  series.name = name;
  const Json profiles = pair.value("trends", Json::object()).value("profiles", Json::object());
  for (const Json& bin : profiles.value(key, Json::array())) {
    series.x.push_back(0.5 * (bin.at("from").get<double>() + bin.at("to").get<double>()) - start);
    series.y.push_back(bin.at("mean_m"));
    const double places = bin.value("places", 1.0);
    series.std.push_back(bin.value("sd_m", 0.0) / std::sqrt(std::max(1.0, places)));
  }
  return series;
}

/// The pair of the set before with the same strips; empty where there is none.
Json pairBefore(const Json& root, const Json& pair) {
  for (const Json& other : root.value("before", Json::object()).value("pairs", Json::array())) {
    if (other.value("a", "") == pair.value("a", "") && other.value("b", "") == pair.value("b", ""))
      return other;
  }
  return Json::object();
}

void addOffsets(const Json& root, std::vector<NamedPlot>& plots) {
  struct Against {
    const char *key, *name, *label;
    bool common_x;
  };
  static constexpr Against kAgainst[] = {
      {"distance_m", "offset_against_distance", "distance from the centre line of the overlap, m",
       true},
      {"time_s", "offset_against_time", "time of the first strip, s from the overlap's start",
       false},
      {"scan_angle_deg", "offset_against_scan_angle", "scan angle of the first strip, degrees",
       true}};
  const bool both = root.contains("before");
  for (const Against& against : kAgainst) {
    CurvePanels plot;
    plot.title = "Height of the first strip above the second";
    plot.x_label = against.label;
    plot.y_label = "offset, m";
    plot.common_x = against.common_x;
    for (const Json& pair : root.at("pairs")) {
      CurvePanels::Panel panel;
      panel.title = pairName(pair);
      double start = 0.0;
      if (!against.common_x) {
        const CurvePlot::Series series = offsetSeries("", pair, against.key, 0.0);
        if (!series.x.empty()) start = series.x.front();
      }
      const Json before = pairBefore(root, pair);
      if (!before.empty())
        panel.series.push_back(offsetSeries("before", before, against.key, start));
      panel.series.push_back(offsetSeries(both ? "after" : "as given", pair, against.key, start));
      if (!panel.series.back().x.empty()) plot.panels.push_back(std::move(panel));
    }
    if (plot.panels.empty()) continue;
    plot.keepLargest();
    plots.push_back(
        {against.name, [plot](PictureSize size) { return drawCurvePanels(plot, size); }});
  }
}

double numberAt(const Json& json, const char* outer, const char* inner) {
  const Json value = json.value(outer, Json::object()).value(inner, Json());
  return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

void addHeights(const Json& root, std::vector<NamedPlot>& plots) {
  BeforeAfterPlot plot;
  plot.title = "Height differences of overlapping strips on level ground";
  plot.x_label = "RMSDz, m";
  plot.before = "before";
  plot.after = root.contains("before") ? "after" : "strips as given";
  for (const Json& pair : root.at("pairs")) {
    const double after = numberAt(pair, "vertical", "rms_m");
    if (!std::isfinite(after)) continue;
    plot.rows.push_back(
        {pairName(pair), numberAt(pairBefore(root, pair), "vertical", "rms_m"), after});
  }
  if (plot.rows.empty()) return;
  plot.keepLargest(60);
  plots.push_back({"heights", [plot](PictureSize size) { return drawBeforeAfter(plot, size); }});
}

/// Variance to mean by slope, histograms and gains of strips, as pcl_als_intensity writes them.
void addIntensity(const Json& root, std::vector<NamedPlot>& plots) {
  const Json report = root.value("report", Json::object());
  CurvePlot slopes{"Variance to mean of intensity by slope",
                   "slope of the surface, degrees",
                   "variance / mean",
                   {{"before", {}, {}, {}}, {"after", {}, {}, {}}}};
  for (const Json& bin : report.value("slopes", Json::array())) {
    // Neither points without a surface, nor too few for a variance.
    if (!bin.at("slope_from_deg").is_number() || numberAt(bin, "before", "points") < 100.0)
      continue;
    const double middle =
        0.5 * (bin["slope_from_deg"].get<double>() + bin.at("slope_to_deg").get<double>());
    for (CurvePlot::Series& series : slopes.series) {
      series.x.push_back(middle);
      series.y.push_back(numberAt(bin, series.name.c_str(), "variance_to_mean"));
    }
  }
  if (!slopes.series[0].x.empty())
    plots.push_back(
        {"variance_to_mean", [slopes](PictureSize size) { return drawCurves(slopes, size); }});
  CurvePanels histograms;
  histograms.title = "Intensities by strip";
  histograms.x_label = "intensity as written in the file";
  histograms.y_label = "points";
  for (const Json& strip : report.value("strips", Json::array())) {
    const Json& histogram = strip.at("histogram");
    CurvePanels::Panel panel{"strip " + strip.value("strip", ""), {}};
    for (const char* set : {"before", "after"}) {
      CurvePlot::Series series{set, {}, numbers(histogram.at(set)), {}};
      for (std::size_t i = 0; i < series.y.size(); ++i)
        series.x.push_back((static_cast<double>(i) + 0.5) *
                           histogram.at("bin_width").get<double>());
      panel.series.push_back(std::move(series));
    }
    if (!panel.series[0].x.empty()) histograms.panels.push_back(std::move(panel));
  }
  if (histograms.panels.empty()) return;
  histograms.keepLargest();
  plots.push_back(
      {"histograms", [histograms](PictureSize size) { return drawCurvePanels(histograms, size); }});
}

void addGains(const Json& root, std::vector<NamedPlot>& plots) {
  IntervalPlot plot;
  plot.title = "Gains of the strips with 95 % intervals";
  plot.x_label = "factor on what the strip received";
  plot.reference = 1.0;
  bool any = false;
  for (const Json& gain : root.value("strip_gains", Json::array())) {
    const double value = gain.at("value");
    const bool known = gain.value("status", "") == "estimated" && gain.at("std").is_number();
    const double std =
        known ? value * gain["std"].get<double>() : std::numeric_limits<double>::quiet_NaN();
    any = any || known;
    plot.rows.push_back(
        {"strip " + gain.value("strip", ""), value, std,
         known ? numberText(value, 4) + " ± " + numberText(std, 4) : gain.value("status", "")});
  }
  if (!any) return;
  plots.push_back({"strip_gains", [plot](PictureSize size) { return drawIntervals(plot, size); }});
}

WaveformPlot::Panel panelOf(const WaveformExample& waveform, const std::string& item) {
  std::size_t fresh = 0;
  WaveformPlot::Panel panel;
  panel.spacing = waveform.spacing;
  panel.samples = waveform.samples;
  panel.model = waveform.model;
  for (std::size_t i = 0; i < waveform.samples.size(); ++i)
    panel.residuals.push_back(waveform.residual(i));
  panel.baseline = waveform.baseline;
  panel.noise = waveform.noise;
  for (const WaveformExample::Echo& echo : waveform.echoes) {
    panel.echoes.push_back({echo.time, echo.amplitude, echo.new_echo});
    fresh += echo.new_echo ? 1 : 0;
  }
  panel.returns = waveform.returns;
  panel.title = item + " " + std::to_string(waveform.number) + ": " +
                std::to_string(waveform.echoes.size()) +
                (waveform.echoes.size() == 1 ? " echo" : " echoes");
  if (fresh > 0) panel.title += ", " + std::to_string(fresh) + " new";
  return panel;
}

/// The response and waveforms, as pcl_als_waveform writes them.
void addWaveforms(const std::string& text, const std::string& file, std::vector<NamedPlot>& plots) {
  const FieldValue value = parseJson(text, file);
  const FieldNode root(value, file);
  const FieldNode response = root["response"];
  CurvePlot pulse{"Response of the system to a point target",
                  "time from its maximum, ns",
                  "share of the maximum",
                  {}};
  CurvePlot::Series& series = pulse.series.emplace_back();
  const double first = response["first_ns"].number(), spacing = response["spacing_ns"].number();
  for (const FieldNode& share : response["values"].items()) {
    series.x.push_back(first + spacing * static_cast<double>(series.x.size()));
    series.y.push_back(share.number());
  }
  plots.push_back({"pulse", [pulse](PictureSize size) { return drawCurves(pulse, size); }});
  WaveformPlot plot{"Waveforms, their echoes and residuals", {}};
  const char* item = root["counts"]["pulses"].count() > 0 ? "pulse" : "point";
  for (const FieldNode& node : root["waveforms"].items()) {
    WaveformExample waveform;
    waveformExampleFields().read(waveform, node);
    plot.panels.push_back(panelOf(waveform, item));
  }
  if (plot.panels.empty()) return;
  if (plot.panels.size() > CurvePanels::kMaximumPanels)
    plot.title += " (the first " + std::to_string(CurvePanels::kMaximumPanels) + " of " +
                  std::to_string(plot.panels.size()) + ")";
  plot.panels.resize(std::min(plot.panels.size(), CurvePanels::kMaximumPanels));
  plots.push_back({"waveforms", [plot](PictureSize size) { return drawWaveforms(plot, size); }});
}

}  // namespace

std::vector<NamedPlot> plotsOf(const std::filesystem::path& file) {
  std::vector<NamedPlot> plots;
  try {
    const std::string text = readWholeFile(file, kJsonLimits);
    const Json root = Json::parse(text);
    if (!root.is_object()) throw InputError(file.string() + ": is no result of a pcl_als tool");
    if (root.value("format", "") == "pcl_als calibration") addCalibration(file, plots);
    if (root.contains("curves")) addCurves(root["curves"], plots);
    if (root.contains("histograms")) addHistograms(root["histograms"], plots);
    if (root.contains("confusion")) addConfusion(root["confusion"], plots);
    if (root.value("format", "") == "pcl_als quality") {
      addHeights(root, plots);
      addOffsets(root, plots);
    }
    if (root.value("format", "") == "pcl_als waveform") addWaveforms(text, file.string(), plots);
    if (root.value("format", "") == "pcl_als intensity") {
      addIntensity(root, plots);
      addGains(root, plots);
    }
  } catch (const nlohmann::json::exception& error) {
    const std::string what = error.what();
    const std::size_t end = what.find("] ");
    throw InputError(file.string() + ": is no result of a pcl_als tool: " +
                     (end == std::string::npos ? what : what.substr(end + 2)));
  }
  if (plots.empty()) throw InputError(file.string() + ": holds nothing that can be plotted");
  return plots;
}

std::vector<NamedPlot> plotsOfAll(const std::vector<std::filesystem::path>& files) {
  std::vector<NamedPlot> plots;
  std::set<std::string> names;
  for (const std::filesystem::path& file : files) {
    for (NamedPlot& plot : plotsOf(file)) {
      const std::string own = file.stem().string() + "_" + plot.name;
      if (names.count(plot.name) != 0) plot.name = own;
      for (int i = 2; !names.insert(plot.name).second; ++i) plot.name = own + std::to_string(i);
      plot.file = file.string();
      plots.push_back(std::move(plot));
    }
  }
  return plots;
}

std::vector<NamedPlot> plotsNamed(const std::vector<NamedPlot>& plots,
                                  const std::vector<std::string>& names) {
  std::vector<NamedPlot> chosen;
  for (const std::string& name : names) {
    const auto found = std::find_if(plots.begin(), plots.end(),
                                    [&](const NamedPlot& plot) { return plot.name == name; });
    if (found == plots.end()) {
      std::vector<std::string> all;
      for (const NamedPlot& plot : plots) all.push_back(plot.name);
      throw UsageError("there is no '" + name + "'; the files hold " + joined(all));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace pcl_als
