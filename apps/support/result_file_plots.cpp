// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "result_file_plots.h"

#include <cmath>
#include <fstream>
#include <limits>

#include <nlohmann/json.hpp>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/visualization/calibration_plots.h>

namespace pcl_als::app {
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

/// Names become file names: what is no letter, digit, - or _ is replaced.
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

/// Offsets of strip pairs in bins of a quantity, as pcl_als_check writes them.
void addOffsets(const Json& pairs, std::vector<NamedPlot>& plots) {
  struct Against {
    const char *key, *name, *label;
  };
  static constexpr Against kAgainst[] = {
      {"distance_m", "offset_against_distance", "distance from the middle of the overlap, m"},
      {"time_s", "offset_against_time", "time, s"},
      {"scan_angle_deg", "offset_against_scan_angle", "scan angle, degrees"}};
  for (const Against& against : kAgainst) {
    CurvePlot plot{std::string("Height offset of strips against ") + against.label,
                   against.label,
                   "first strip above the second, m",
                   {}};
    for (const Json& pair : pairs) {
      const Json profiles = pair.value("trends", Json::object()).value("profiles", Json::object());
      CurvePlot::Series series;
      series.name = pair.value("a", "") + " : " + pair.value("b", "");
      for (const Json& bin : profiles.value(against.key, Json::array())) {
        series.x.push_back(0.5 * (bin.at("from").get<double>() + bin.at("to").get<double>()));
        series.y.push_back(bin.at("mean_m"));
        const double places = bin.value("places", 1.0);
        series.std.push_back(bin.value("sd_m", 0.0) / std::sqrt(std::max(1.0, places)));
      }
      if (!series.x.empty()) plot.series.push_back(std::move(series));
    }
    if (plot.series.empty()) continue;
    plots.push_back({against.name, [plot](PictureSize size) { return drawCurves(plot, size); }});
  }
}

}  // namespace

std::vector<NamedPlot> plotsOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw InputError(file.string() + ": cannot be read");
  }
  std::vector<NamedPlot> plots;
  try {
    const Json root = Json::parse(stream);
    if (!root.is_object()) throw InputError(file.string() + ": is no result of a pcl_als tool");
    if (root.value("format", "") == "pcl_als calibration") addCalibration(file, plots);
    if (root.contains("curves")) addCurves(root["curves"], plots);
    if (root.contains("histograms")) addHistograms(root["histograms"], plots);
    if (root.contains("confusion")) addConfusion(root["confusion"], plots);
    if (root.value("format", "") == "pcl_als quality") addOffsets(root.at("pairs"), plots);
  } catch (const nlohmann::json::exception& error) {
    const std::string what = error.what();
    const std::size_t end = what.find("] ");
    throw InputError(file.string() + ": is no result of a pcl_als tool: " +
                     (end == std::string::npos ? what : what.substr(end + 2)));
  }
  if (plots.empty()) throw InputError(file.string() + ": holds nothing that can be plotted");
  return plots;
}

}  // namespace pcl_als::app
