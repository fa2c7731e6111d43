// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/linear_units.h>
#include <pcl_als/io/crs.h>

namespace pcl_als {

/// How the times of a point file count, as its header declares it.
enum class TimeKind { none, week_seconds, adjusted_standard };

/// Properties of a point file that are known before its points are read.
struct PointFileInfo {
  std::filesystem::path path;
  std::uint64_t point_count = 0;
  Eigen::Vector3d minimum =
      Eigen::Vector3d::Zero();  ///< header's bounding box, metres, ground frame
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  Eigen::Vector3d resolution = Eigen::Vector3d::Constant(0.001);  ///< coordinate step, metres
  std::string crs;  ///< WKT or "EPSG:…", of the file's own unit; empty when unknown
  CrsKind crs_kind = CrsKind::unknown;
  LinearUnits units;  ///< of the file; everything else here is in metres
  TimeKind time_kind = TimeKind::none;
  std::string format;  ///< "LAS 1.4, point format 6", "PCD binary"
};

/// Points as columns: ground frame in metres and double, one entry per point in each.
struct PointChunk {
  std::vector<double> x, y, z, gps_time;
  std::vector<float> intensity, scan_angle;
  std::vector<std::uint16_t> point_source_id;
  std::vector<std::uint8_t> return_number, number_of_returns, classification,
      flags;  ///< flags: PointFlag

  std::size_t size() const { return x.size(); }
  void resize(std::size_t count);
};

/** \brief Reads the points of a .las, .laz or .pcd file chunk by chunk, in file order, in constant
 * memory.
 *
 * Coordinates are brought to metres from the unit that the file states (PointFileInfo::units); the
 * coordinates of a PCD are metres.
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

  virtual const PointFileInfo& info() const = 0;
  /// The next at most kChunk points; false (and an empty chunk) at the end.
  virtual bool read(PointChunk& chunk) = 0;
};

}  // namespace pcl_als
