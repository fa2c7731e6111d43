// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <limits>

namespace pcl_als::registration {

/// Detects that updates no longer decrease: pairs that alternate between two patches, and weights
/// that follow the scatter, can lead to cycles of the motion of any size and length.
class UpdateHistory {
 public:
  /// True from the third update in a row that is not below 0.7 of the smallest so far.
  bool stalled(double update) {
    if (update < kProgress * best_) {
      best_ = update;
      without_progress_ = 0;
    } else {
      ++without_progress_;
    }
    return without_progress_ >= kStalledAfter;
  }

 private:
  static constexpr double kProgress = 0.7;
  static constexpr int kStalledAfter = 3;
  double best_ = std::numeric_limits<double>::infinity();
  int without_progress_ = 0;
};

}  // namespace pcl_als::registration
