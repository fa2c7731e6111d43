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

/// UsageError if \a count, the number of point files given to a job, is zero.
void requirePointFiles(std::size_t count);

/// InputError for .ply and .xyz files, of which no corrected copies can be written; they have to be
/// converted first.
void requireCopyable(const std::filesystem::path& file);

/** \brief Reads the points of a point file (kPointExtensions) chunk by chunk, in file order, in
 * constant memory.
 *
 * Coordinates are brought to metres from the unit that the file states (PointFileInfo::units); the
 * coordinates of PCD, PLY and XYZ files are metres.
 *
 * Every fault of the file is an InputError with the file, the fault and the remedy.
 * \code
 * const auto reader = pcl_als::PointReader::open("strip1.laz");
 * pcl_als::PointChunk chunk;
 * while (reader->read(chunk))
 *   for (std::size_t i = 0; i < chunk.size(); ++i) use(chunk.x[i], chunk.y[i], chunk.z[i]);
 * \endcode
 */
class PointReader {
 public:
  static constexpr std::size_t kChunk = std::size_t{1} << 17;  ///< largest number of points

  virtual ~PointReader() = default;
  /// Treatment of coordinates that are not map coordinates (degrees, geocentric coordinates).
  enum class OtherCoordinates { refuse, as_stored };
  /// Opens a file; its extension determines the format.
  static std::unique_ptr<PointReader> open(const std::filesystem::path& path,
                                           OtherCoordinates other = OtherCoordinates::refuse);
  /// Opens a part of a file. info() describes the part as far as it is known before the points are
  /// read.
  static std::unique_ptr<PointReader> open(const std::filesystem::path& path,
                                           const PointWindow& window,
                                           OtherCoordinates other = OtherCoordinates::refuse);

  virtual const PointFileInfo& info() const = 0;
  /// The part of a damaged file that cannot be read (PointWindow::keep_readable), in one line with
  /// the name of the file; empty if nothing is lost.
  virtual std::string damage() const { return {}; }
  /// Contents of the file that are not used, and assumptions about it, one line each without the
  /// name of the file.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// A remark if the header of the file states another box than that of the points which read()
  /// gave (\a points); otherwise empty. The points of a part of a file only have to lie within the
  /// box of the header.
  virtual std::string boxRemark(const Eigen::AlignedBox3d& /*points*/) const { return {}; }
  /// The next at most kChunk points; false (and an empty chunk) at the end.
  virtual bool read(PointChunk& chunk) = 0;
};

}  // namespace pcl_als
