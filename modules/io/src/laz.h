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

/// Packed records compressed into a file that LASzip creates; finish() closes it.
class LazWriter {
 public:
  virtual ~LazWriter() = default;
  virtual void write(const std::byte* records, std::size_t count) = 0;
  virtual void finish() = 0;
};

bool lazSupported();
/// \param name for messages. InputError without LASzip support, telling how to get it.
std::unique_ptr<LazReader> openLazReader(const std::string& path, const LasHeader& header,
                                         const std::string& name);
/** \param head header block, VLRs and the bytes between them and the points, as in plain LAS; what
 * follows the points (EVLRs) is the caller's to append. */
std::unique_ptr<LazWriter> createLazWriter(const std::string& path,
                                           const std::vector<std::byte>& head,
                                           const LasHeader& header, const std::string& name);

}  // namespace pcl_als::detail
