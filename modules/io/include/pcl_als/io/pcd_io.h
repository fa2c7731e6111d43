// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/common/strip.h>

namespace pcl_als {

/** \brief Writes a strip as binary PCD with every field of PointLidar.
 *
 * The frame's origin is the file's VIEWPOINT (ground = VIEWPOINT + point), strip id and CRS are
 * comment lines; every value survives to the last bit. PCL's own readers and tools take the file
 * as any PCD; through PCL's float VIEWPOINT the origin stays exact where it is a multiple of 10 m
 * (see LocalFrame). AtomicFile; InputError names the file.
 */
void savePcd(const std::filesystem::path& path, const Strip<PointLidar>& strip);

/// A field besides those of PointLidar: one float per point.
struct PcdColumn {
  std::string name;
  std::vector<float> values;
};
/// The same with further fields behind the others. UsageError where a column is not as long as the
/// cloud.
void savePcd(const std::filesystem::path& path, const Strip<PointLidar>& strip,
             const std::vector<PcdColumn>& columns);

/** \brief Reads any PCD with float or double x, y, z; fields are found by name without regard to
 * case and underscores, those that are missing keep PointLidar's defaults, points without finite
 * coordinates are excluded.
 *
 * The id is that of savePcd; else the point source id where all points have the same and it is not
 * 0; else the file's stem. The frame's origin is the VIEWPOINT of files of this library; in others
 * that is the pose of the sensor, which is not added, unless it cannot be one (the module's README
 * has the rule). Coordinates stored as double get a frame around their centre. Times that a filter
 * averaged byte by byte are zero (PcdFindings::time_fault).
 */
Strip<PointLidar> loadPcd(const std::filesystem::path& path);
/// What a cloud does not show of the file that it was read from.
struct PcdFindings {
  std::vector<std::string> remarks;  ///< PointReader::remarks()
  std::string time_fault;            ///< PointFileInfo::time_fault
  bool has_intensity = true, has_flags = true;
  /// Channels of the scanner of all points, in the field that was asked for; empty where none was,
  /// and for a scanner channel in a file without flags.
  std::vector<std::uint8_t> channels;
  /// This field, where PointLidar has no such field: for copies of the file.
  std::vector<PcdColumn> channel_column;
};
/// The same, for jobs that tell it. \a channel_field: PointWindow::channel_field; empty: channels
/// are not needed. InputError where the file has no field of that name.
Strip<PointLidar> loadPcd(const std::filesystem::path& path, const std::string& channel_field,
                          PcdFindings& findings);

}  // namespace pcl_als
