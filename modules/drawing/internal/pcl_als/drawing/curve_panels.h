// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/** \brief The same quantity for many objects, a small plot for each with a common height axis, as
 * for the offsets of every pair of strips before and after.
 */
struct CurvePanels {
  struct Panel {
    std::string title;
    std::vector<CurvePlot::Series> series;
  };
  std::string title, x_label, y_label;
  std::vector<Panel> panels;
  bool common_x = true;  ///< false: every panel has its own range

  static constexpr std::size_t kMaximumPanels = 16;
  /// Keeps the panels with the largest absolute values, in their order.
  void keepLargest(std::size_t most = kMaximumPanels);
};

/// Series of the same name have the same colour in all panels; before and after their own.
/// UsageError where lengths do not match, or where no panel has a number.
Canvas drawCurvePanels(const CurvePanels& plot, PictureSize size = {});

}  // namespace pcl_als
