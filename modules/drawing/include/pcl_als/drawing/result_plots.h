// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/canvas.h>

namespace pcl_als {

struct PictureSize {
  int width = 1600, height = 1000;
};
/// "1600x1000". UsageError unless 200x150 to 16384x16384, 40 million pixels at most.
PictureSize pictureSizeIn(const std::string& text);

/// A quantity against another, one line with points for each series.
struct CurvePlot {
  struct Series {
    std::string name;
    std::vector<double> x, y, std;  ///< std: half intervals at y; empty: none
  };
  std::string title, x_label, y_label;
  std::vector<Series> series;
};

/// Counts over bins, one outline for each series; shown as percent of the series.
struct HistogramPlot {
  struct Series {
    std::string name;
    std::vector<double> counts;
  };
  std::string title, x_label;
  std::vector<double> edges;  ///< one more than counts
  std::vector<Series> series;
};

/// Counts of a classification; rows are classified as, columns are reference.
struct ConfusionPlot {
  std::string title;
  std::vector<std::string> classes;
  std::vector<std::vector<double>> matrix;
};

/// The plots. UsageError where lengths do not match or there is nothing to draw. Series whose names
/// end in before or after have the colours used for these in every plot.
Canvas drawCurves(const CurvePlot& plot, PictureSize size = {});
Canvas drawHistogram(const HistogramPlot& plot, PictureSize size = {});
Canvas drawConfusion(const ConfusionPlot& plot, PictureSize size = {});

}  // namespace pcl_als
