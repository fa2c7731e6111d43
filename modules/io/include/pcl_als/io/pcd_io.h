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
 * The frame's origin is the file's VIEWPOINT (ground = VIEWPOINT + point); strip id and CRS are
 * comment lines. Every value is kept bit for bit. PCL's own readers and tools read the file as any
 * PCD; an origin that is a multiple of 10 m remains exact in PCL's float VIEWPOINT (see
 * LocalFrame). The file appears only when it is complete. InputError names the file.
 */
void savePcd(const std::filesystem::path& path, const Strip<PointLidar>& strip);

/// A field besides those of PointLidar: one float per point.
struct PcdColumn {
  std::string name;
  std::vector<float> values;
};
/// Writes a strip with further fields after those of PointLidar. UsageError if a column does not
/// have one value per point.
void savePcd(const std::filesystem::path& path, const Strip<PointLidar>& strip,
             const std::vector<PcdColumn>& columns);

/** \brief Reads any PCD with float or double x, y, z.
 *
 * Fields are found by name without regard to case and underscores; missing fields keep the defaults
 * of PointLidar. Points without finite coordinates are excluded. InputError names the file.
 *
 * The strip id is that of savePcd(), else the point source id if all points have the same one
 * other than 0, else the stem of the file name. In files of this library the VIEWPOINT is the
 * origin of the frame. In other files it is the pose of the sensor and is not added, unless it
 * cannot be a pose (the rule is on the page of module io). Coordinates stored as double get a frame
 * around their centre. Times that a filter averaged byte by byte are set to zero
 * (PcdFindings::time_fault).
 */
Strip<PointLidar> loadPcd(const std::filesystem::path& path);
/// Facts about a PCD file that the cloud read from it does not contain.
struct PcdFindings {
  std::vector<std::string> remarks;  ///< PointReader::remarks()
  std::string time_fault;            ///< PointFileInfo::time_fault
  bool has_intensity = true, has_flags = true;
  /// Scanner channel of each point from the requested field; empty if no field was requested, or if
  /// the flags were requested and the file has none.
  std::vector<std::uint8_t> channels;
  /// The requested field if PointLidar does not have it, for copies of the file.
  std::vector<PcdColumn> channel_column;
};
/// Reads a PCD as above and sets \a findings. \a channel_field: PointWindow::channel_field; empty:
/// channels are not needed. InputError if the file has no field of that name.
Strip<PointLidar> loadPcd(const std::filesystem::path& path, const std::string& channel_field,
                          PcdFindings& findings);

}  // namespace pcl_als
