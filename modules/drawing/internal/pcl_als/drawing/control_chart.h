// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/// A quantity that was measured again and again, in order of time.
struct ControlChart {
  struct Sample {
    std::string label;          ///< date or name, below the axis
    double value = 0.0;         ///< NaN: not measured
    double std = 0.0;           ///< of the value
    double expected = 0.0;      ///< the value of the model at this sample
    double expected_std = 0.0;  ///< of a value that follows the model: half width of the limits / 2
    bool marked = false;        ///< disagrees with the others
  };
  std::string title, y_label;
  std::vector<Sample> samples;
};

/// Values with their 95 % intervals, the line of the model, which has a gap at steps, and limits at
/// two standard deviations around it. UsageError without a measured sample.
Canvas drawControlChart(const ControlChart& chart, PictureSize size = {});

}  // namespace pcl_als
