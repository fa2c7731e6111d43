// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/** \brief A source of points of a survey: a point file, or a cloud (makeCloudInput()).
 *
 * Jobs read points from sources. The same points in the same order give the same result, whatever
 * the source is.
 */
struct SurveyInput {
  /// A reader positioned at the first point, with the values of an extra-bytes field
  /// (PointWindow::extra_field) where that is not empty; may be called by several threads.
  std::function<std::unique_ptr<PointReader>(const std::string& extra_field)> open;
  std::filesystem::path path;  ///< of a file; empty: another source
  std::string strip;           ///< strip of all points; empty: strips are named by StripNaming
  /// to the time system of the trajectory; default: reconcileTimes()
  std::optional<TimeAlignment> time;

  static SurveyInput ofFile(const std::filesystem::path& path, const PointWindow& window = {});
};

}  // namespace pcl_als
