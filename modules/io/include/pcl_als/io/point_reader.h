// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_file_info.h>
#include <pcl_als/io/point_window.h>

namespace pcl_als {

/// UsageError where a job is given no point file at all.
void requirePointFiles(std::size_t count);

/// InputError for a file that can be read but of which no corrected copy can be written, .ply and
/// .xyz: it must be converted first.
void requireCopyable(const std::filesystem::path& file);

/** \brief Reads the points of a point file (kPointExtensions) chunk by chunk, in file order, in
 * constant memory.
 *
 * Coordinates are brought to metres from the unit that the file states (PointFileInfo::units); the
 * coordinates of PCD, PLY and XYZ files are metres.
 *
 * Everything that is wrong with the file is an InputError that names file, what is wrong and what
 * to do.
 */
class PointReader {
 public:
  static constexpr std::size_t kChunk = std::size_t{1} << 17;

  virtual ~PointReader() = default;
  /// What is done with coordinates that are no map coordinates: degrees or geocentric ones.
  enum class OtherCoordinates { refuse, as_stored };
  /// Opens by extension.
  static std::unique_ptr<PointReader> open(const std::filesystem::path& path,
                                           OtherCoordinates other = OtherCoordinates::refuse);
  /// Opens a part of a file: info() describes the part, as far as that is known before its points
  /// are read.
  static std::unique_ptr<PointReader> open(const std::filesystem::path& path,
                                           const PointWindow& window,
                                           OtherCoordinates other = OtherCoordinates::refuse);

  virtual const PointFileInfo& info() const = 0;
  /// What of a damaged file cannot be read (PointWindow::keep_readable), as one line with the name
  /// of the file; empty: nothing.
  virtual std::string damage() const { return {}; }
  /// What is not used of the file, and what is assumed of it, one line each without its name.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Of the box of all points that read() gave: that the header of the file states another one;
  /// empty: it does not. Points in a part of the file must only be within the box of the header.
  virtual std::string boxRemark(const Eigen::AlignedBox3d& /*points*/) const { return {}; }
  /// The next at most kChunk points; false (and an empty chunk) at the end.
  virtual bool read(PointChunk& chunk) = 0;
};

}  // namespace pcl_als
