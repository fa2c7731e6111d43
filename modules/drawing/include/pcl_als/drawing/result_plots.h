// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/canvas.h>

namespace pcl_als {

/// Size of a picture, pixels.
struct PictureSize {
  int width = 1600, height = 1000;
};
/// The size in a text such as "1600x1000". UsageError unless it is between 200x150 and 16384x16384
/// and has at most 40 million pixels.
PictureSize pictureSizeIn(const std::string& text);

/// Plot of one quantity against another; each series is a line with points.
struct CurvePlot {
  struct Series {
    std::string name;
    std::vector<double> x, y, std;  ///< std: half lengths of the error bars of y; empty: none
  };
  std::string title, x_label, y_label;
  std::vector<Series> series;
};

/// Histogram with one outline per series, in percent of the counts of the series.
struct HistogramPlot {
  struct Series {
    std::string name;
    std::vector<double> counts;
  };
  std::string title, x_label;
  std::vector<double> edges;  ///< one more than counts
  std::vector<Series> series;
};

/// Confusion matrix; rows are the assigned classes, columns the reference classes.
struct ConfusionPlot {
  std::string title;
  std::vector<std::string> classes;
  std::vector<std::vector<double>> matrix;
};

/// Draw the plots. UsageError if lengths do not match or there is nothing to draw. Series whose
/// names end in "before" and "after" have the same colours in every plot.
/// \code
/// pcl_als::CurvePlot plot{"Offset", "distance across the overlap, m", "offset, m", {series}};
/// pcl_als::drawCurves(plot).write("offset.svg");
/// \endcode
Canvas drawCurves(const CurvePlot& plot, PictureSize size = {});
Canvas drawHistogram(const HistogramPlot& plot, PictureSize size = {});
Canvas drawConfusion(const ConfusionPlot& plot, PictureSize size = {});

}  // namespace pcl_als
