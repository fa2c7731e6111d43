// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/** \brief Creates a PLY or ASCII XYZ file chunk by chunk, in constant memory: append, finish().
 *
 * The file has the fields of PointLidar as properties or columns, without gps_time where the points
 * have none (TimeKind::none). Coordinates are metres in the ground frame: double in binary PLY, in
 * text with the decimals of PointFileInfo::resolution. Times and all other values survive to the
 * last bit. CRS, name of the strip and record of corrections are comments, which PointReader reads.
 * Output through AtomicFile; InputError names the file.
 */
class ExchangeWriter {
 public:
  struct Options {
    std::string strip_id;    ///< name of the strip; empty: none is stored
    bool ascii_ply = false;  ///< PLY as text, in place of binary_little_endian
  };

  /// \param path .ply or .xyz; UsageError for another extension \param info of the points: kind of
  /// time, resolution, CRS and corrections
  ExchangeWriter(const std::filesystem::path& path, const PointFileInfo& info,
                 const Options& options);
  ~ExchangeWriter();
  ExchangeWriter(const ExchangeWriter&) = delete;
  ExchangeWriter& operator=(const ExchangeWriter&) = delete;

  /// Appends the rows [from, to).
  void append(const PointChunk& chunk, std::size_t from, std::size_t to);
  std::uint64_t pointCount() const;
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
