// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/registration/point_view.h>
#include <pcl_als/survey/strip_arrangement.h>

namespace pcl_als {

/// Source of the points of a strip: files, and the points of these that belong to it.
struct StripFiles {
  std::vector<std::filesystem::path> files;
  std::string strip;  ///< name, where the files contain several
  /// Arrangement of files that include these; null: all points belong to the strip.
  const StripArrangement* arrangement = nullptr;
  std::vector<std::size_t> places;  ///< index of each file in the arrangement
  int index = -1;                   ///< of the strip in the arrangement; -1: all strips in use
  /// Box of the points of the strip, metres; empty: that of all points of the files.
  Eigen::AlignedBox3d box;

  std::string name() const;  ///< "strip1.las", "strip 3"
};

/// A strip before its points are read.
struct StripFileInfo {
  Eigen::AlignedBox3d box;           ///< metres
  std::vector<std::string> remarks;  ///< headers that state another box
  std::vector<PointFileInfo> files;
  double resolution = 0.001;
  std::uint64_t points = 0;
};

/// \param measured whether the box is that of the points, for which all files are read, or that of
/// the headers. InputError for a file that cannot be read.
StripFileInfo stripFileInfo(const StripFiles& strip, bool measured);

/** \brief Positions of a strip inside a plan box: 12 bytes each, floats relative to an origin in
 * the middle of the box. First of several returns, vegetation (classes 3 to 5), noise (7 and 18)
 * and withheld points are left out.
 */
struct StripPoints {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> positions;
  std::uint64_t read = 0;  ///< points of the strip, inside or not
  /// Whether the headers, if the box of the strip is taken from them, state that of the points.
  bool headers_right = true;

  PointView view() const;
};
StripPoints readStripPoints(const StripFiles& strip, const Eigen::AlignedBox2d& box,
                            const Eigen::Vector3d& origin);

}  // namespace pcl_als
