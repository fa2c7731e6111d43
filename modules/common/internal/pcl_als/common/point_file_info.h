// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <Eigen/Core>

#include <pcl_als/common/file_version.h>
#include <pcl_als/common/linear_units.h>

namespace pcl_als {

/// What the coordinates of a coordinate reference system are.
enum class CrsKind {
  unknown,     ///< none is given, PROJ does not know it, or it is of heights only
  projected,   ///< a map projection: lengths
  local,       ///< an engineering system: lengths from an origin that is not known
  geographic,  ///< longitude and latitude
  geocentric   ///< X, Y, Z from the centre of the Earth
};

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
  /// A CRS that the file states and that cannot be used, and why: "EPSG:65535 is not known to
  /// PROJ".
  std::string crs_ignored;
  CrsKind crs_kind = CrsKind::unknown;
  LinearUnits units;  ///< of the file; everything else here is in metres
  TimeKind time_kind = TimeKind::none;
  /// Added to the times that the file stores (offset GPS time of LAS 1.5), seconds; those of its
  /// points contain it.
  double time_shift = 0.0;
  /// Why the times that the file has are not used, without its name: "its GPS times are …"; empty:
  /// they are used, or it has none.
  std::string time_fault;
  FileVersion version;  ///< of the file when it was opened
  /// Sensor by the header of a LAS file; empty: not stated, or the name of a process there.
  std::string system;
  std::string format;  ///< "LAS 1.4, point format 6", "PCD binary"
  /// Record of the corrections that were applied to the points (io/applied_correction.h), as the
  /// file stores it; empty: none is recorded.
  std::string corrections;
};

}  // namespace pcl_als
