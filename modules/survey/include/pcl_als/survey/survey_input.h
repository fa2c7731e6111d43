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
 * What a job reads its points from. The same points in the same order give the same result,
 * whatever the source is.
 */
struct SurveyInput {
  /// A reader that stands at the first point; may be called by several threads.
  std::function<std::unique_ptr<PointReader>()> open;
  std::string strip;  ///< that all points are of; empty: strips are told apart by StripNaming
  std::optional<TimeAlignment> time;  ///< to the trajectory's clock; default: reconcileTimes()

  static SurveyInput ofFile(const std::filesystem::path& path);
};

}  // namespace pcl_als
