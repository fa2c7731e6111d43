// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include <pcl_als/common/input_file.h>
#include <pcl_als/io/point_reader.h>

#include "pcd_header.h"

namespace pcl_als::detail {

/// Packed records of a file in file order, whichever of the three ways it stores them.
class PcdRecords {
 public:
  virtual ~PcdRecords() = default;
  virtual void next(std::size_t count, std::byte* out) = 0;
};

/** \brief The points of a PCD or PLY file as columns, coordinates relative to origin().
 *
 * Clouds of this library have their origin in VIEWPOINT. PCL defines VIEWPOINT as the pose of the
 * sensor, which is not added to the points of other files, unless it cannot be that: it is farther
 * than 10 km from zero in plan, and the first point, of single precision, is nearer to zero than
 * to it.
 *
 * GPS times are zero here where most are averages of bytes (timeFault()).
 *
 * Points without finite coordinates are excluded. Constant memory for ascii and binary; a
 * binary_compressed file is one compressed block and is held in memory as a whole.
 */
class PcdFile {
 public:
  /// \param channel_field PointWindow::channel_field
  explicit PcdFile(const std::filesystem::path& path, const std::string& channel_field = {});
  ~PcdFile();
  PcdFile(const PcdFile&) = delete;
  PcdFile& operator=(const PcdFile&) = delete;

  const PcdHeader& header() const { return header_; }
  /// Metres, ground frame.
  const Eigen::Vector3d& origin() const { return origin_; }
  /// Of the coordinates: that of single precision, or of double where all fields have it.
  double relativeStep() const;
  bool hasTimes() const { return header_.find("gps_time") != nullptr && !times_are_averages_; }
  /// Whether it has the field with the channel of the scanner.
  bool hasChannels() const { return !channel_field_.empty() || header_.find("flags") != nullptr; }
  /// Why its times are not used (PointFileInfo::time_fault).
  std::string timeFault() const;
  /// What is not used of the file, and how its VIEWPOINT is understood.
  std::vector<std::string> remarks() const;
  const std::string& name() const { return file_.name(); }
  const FileVersion& version() const { return file_.version(); }
  /// The next points out of at most \a records records; false at the end of the file.
  bool read(std::size_t records, PointChunk& chunk);
  /// Of the times so far, per second (timeUnitsPerSecond()).
  double timeUnits() const { return time_units_; }
  void rewind();

 private:
  void checkFields() const;
  void readFirst();
  void fill(const std::byte* records, std::size_t count, PointChunk& chunk);

  InputFile file_;
  PcdHeader header_;
  std::string channel_field_;  ///< empty: bits of the flags
  std::unique_ptr<PcdRecords> records_;
  std::uint64_t position_ = 0;
  double time_units_ = 1.0;
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  bool times_are_averages_ = false;
  std::vector<std::byte> buffer_;
};

/// The three ways of storing records.
std::unique_ptr<PcdRecords> openPcdRecords(const InputFile& file, const PcdHeader& header);

}  // namespace pcl_als::detail
