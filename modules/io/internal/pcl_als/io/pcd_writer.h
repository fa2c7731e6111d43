// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/local_frame.h>

namespace pcl_als {

/** \brief Creates a binary PCD of PointLidar chunk by chunk, in constant memory: append, finish().
 *
 * The file is that of savePcd(). Coordinates are floats relative to the origin of the frame and
 * are rounded to them: by 0.12 mm up to 4 km from the origin. Output through AtomicFile.
 */
class PcdWriter {
 public:
  /// Distance from the origin along an axis, metres, from which on steps of floats exceed 2 mm.
  static constexpr double kFarthest = 32768.0;

  /// \param strip_id name of the strip; empty: none is stored
  /// \param corrections record of applied corrections (PointFileInfo); empty: none is stored
  PcdWriter(const std::filesystem::path& path, LocalFrame frame, std::string strip_id = {},
            std::string corrections = {});
  ~PcdWriter();

  /// Appends the rows [from, to). InputError for a point farther than kFarthest from the origin.
  void append(const PointChunk& chunk, std::size_t from, std::size_t to);
  std::uint64_t pointCount() const;
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
