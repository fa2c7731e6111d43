// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/// Named rows with a value before and one after on a common axis, and limits for comparison.
struct BeforeAfterPlot {
  struct Row {
    std::string name;
    double before, after;  ///< NaN: none
  };
  struct Limit {
    std::string name;
    double value;
  };
  std::string title, x_label;
  std::vector<Row> rows;
  std::vector<Limit> limits;
  std::string before = "as delivered", after = "calibrated";  ///< in the legend

  /// Keeps the rows with the largest values after (or before, where a row has no value after), in
  /// their order.
  void keepLargest(std::size_t most);
};

/// Named rows with a value and its 95 % interval on a common axis.
struct IntervalPlot {
  struct Row {
    std::string name;
    double value, std;  ///< std NaN: the value is not estimated, and is drawn in gray
    std::string text;   ///< beside it
  };
  std::string title, x_label;
  double reference = 0.0;  ///< a line at this value; NaN: none
  std::vector<Row> rows;
};

/// The plots. UsageError where there is no row.
Canvas drawBeforeAfter(const BeforeAfterPlot& plot, PictureSize size = {});
Canvas drawIntervals(const IntervalPlot& plot, PictureSize size = {});

/// A height sufficient for a number of rows.
int heightForRows(std::size_t rows);

}  // namespace pcl_als
