// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/io/las_header.h>

namespace pcl_als::detail {

/// The record that LASzip adds to the VLRs of a compressed file; plain LAS does not have it.
inline constexpr const char* kLaszipUser = "laszip encoded";
inline constexpr std::uint16_t kLaszipRecord = 22204;

/// Compressed points as the packed records of plain LAS.
class LazReader {
 public:
  virtual ~LazReader() = default;
  virtual void read(std::uint64_t first, std::size_t count, std::byte* out) = 0;
};

/// Packed records compressed into an existing file, from begin() on.
class LazWriter {
 public:
  virtual ~LazWriter() = default;
  /// The VLR (header and payload) that the file needs among its others.
  virtual std::vector<std::byte> vlr() = 0;
  virtual void begin(const std::string& path, std::uint64_t offset_to_points) = 0;
  virtual void write(const std::byte* records, std::size_t count) = 0;
  virtual void finish() = 0;
};

bool lazSupported();
/// \param name for messages. InputError without LASzip support, telling how to get it.
std::unique_ptr<LazReader> openLazReader(const std::string& path, const LasHeader& header,
                                         const std::string& name);
std::unique_ptr<LazWriter> makeLazWriter(const LasHeader& header, const std::string& name);

}  // namespace pcl_als::detail
