// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

namespace pcl_als {

/// Choice of the strips to be used.
struct StripChoice {
  std::vector<std::string> only;     ///< names of the strips that are used; empty: all
  std::vector<std::string> without;  ///< names of strips to exclude
  bool split = false;                ///< cut into flight lines by splitTrack()
  /// Without split: cut strips that are certainly several flight lines (leadBack()), as they are
  /// compared with others and not with themselves.
  bool divide_lines = false;
  /// Without split: keep points of GPS time 0 in files that have times.
  bool keep_timeless = false;
  /// The channels of the scanner in a strip are strips of their own: 3.ch0, 3.ch1 (SurveyReader).
  bool by_channel = false;
};

}  // namespace pcl_als
