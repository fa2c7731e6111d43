// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include <pcl_als/io/atomic_file.h>
#include <pcl_als/io/las_header.h>

#include "laz.h"

namespace pcl_als::detail {

/// Plain or compressed (by extension .laz) point records into an AtomicFile.
class LasOutput {
 public:
  /// \param head header block, VLRs and the bytes between them and the points, as in plain LAS
  LasOutput(const std::filesystem::path& path, const std::vector<std::byte>& head,
            const LasHeader& header);

  void append(const std::byte* records, std::size_t count);
  /// Plain LAS only: records at an index; by several threads at once.
  void putAt(std::uint64_t first, const std::byte* records, std::size_t count);
  bool compressed() const { return laz_ != nullptr; }
  AtomicFile& file() { return file_; }
  std::uint64_t endOfPoints();  ///< ends the points (of a compressed file); where the file ends now

  /// Stores counts and bounding box of \a header and makes the file appear.
  void finish(const LasHeader& header);

 private:
  AtomicFile file_;
  std::unique_ptr<LazWriter> laz_;
  std::uint64_t offset_to_points_;
  std::size_t record_length_;
};

bool wantsLaz(const std::filesystem::path& path);

}  // namespace pcl_als::detail
