// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/registration/point_view.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

/// A strip of a survey, or the strips of one of its files.
struct StripPart {
  std::shared_ptr<const SurveyReader> survey;
  std::string name;               ///< for messages: "strip1.las", "strip 3"
  SurveyReader::Reading reading;  ///< of its points
  Eigen::AlignedBox3d box;        ///< of its points, metres, as far as it is known

  /// All files of a strip.
  static StripPart ofStrip(std::shared_ptr<const SurveyReader> survey, int strip,
                           const Eigen::AlignedBox3d& box);
  /// A file, with the box that is known of it.
  static StripPart ofFile(std::shared_ptr<const SurveyReader> survey, std::size_t file);
  /// What is known of the files.
  std::vector<PointFileInfo> files() const;
};

/** \brief Positions of a strip inside a plan box: 12 bytes each, floats relative to an origin in
 * the middle of the box. First of several returns, vegetation (classes 3 to 5), noise (7 and 18)
 * and withheld points are excluded.
 */
struct StripPoints {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> positions;
  std::uint64_t read = 0;  ///< points of the strip, inside or not
  /// Whether the box that was known of the strip is theirs: that of a header may be wrong.
  bool box_right = true;

  PointView view() const;
};
/// InputError for a strip without points.
StripPoints readStripPoints(const StripPart& strip, const Eigen::AlignedBox2d& box,
                            const Eigen::Vector3d& origin);

}  // namespace pcl_als
