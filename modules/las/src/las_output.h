// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_header.h>

#include "laz.h"

namespace pcl_als::detail {

/// What comes before the points of a plain LAS file: header block, VLRs, bytes between.
struct LasHead {
  std::vector<std::byte> bytes;
  LasHeader header;
  std::size_t vlrs_end = 0;  ///< where the VLRs end in `bytes`
};

/// The head of an existing file; of a compressed one as if it were plain: without the records that
/// describe its compression and the octree of its chunks (COPC).
LasHead readLasHead(const LasFile& file);

/// Whether a VLR of this user id and record id is of some kind.
using VlrKind = std::function<bool(const std::string& user_id, std::uint16_t record_id)>;

/// Removes the VLRs of a kind; returns where the first one was, or the end of the VLRs.
std::size_t eraseVlrs(LasHead& head, const VlrKind& is_erased);
/// Inserts the bytes of a whole VLR between two others or behind the last one.
void insertVlr(LasHead& head, std::size_t at, const std::vector<std::byte>& vlr);

/// Whether a record (VLR or EVLR) describes how the points of its file are compressed or where
/// their chunks are: it does not hold for a file that is written anew.
bool describesChunks(const std::string& user_id, std::uint16_t record_id);
/// Whether a record (VLR or EVLR) describes extra bytes.
bool describesExtraBytes(const std::string& user_id, std::uint16_t record_id);

/// Plain or compressed (by extension .laz) point records into an AtomicFile.
class LasOutput {
 public:
  /// \param threads that compress; 0: all cores.
  LasOutput(const std::filesystem::path& path, LasHead head, int threads = 0);

  void append(const std::byte* records, std::size_t count);
  /// Plain LAS only: records at an index; by several threads at once.
  void putAt(std::uint64_t first, const std::byte* records, std::size_t count);
  bool compressed() const { return laz_ != nullptr; }
  std::uint64_t endPoints();  ///< no more points; the position behind the last

  /// Bytes at a position of the file, behind the points or in the header.
  void put(std::uint64_t position, const std::byte* bytes, std::size_t count);
  /// Stores the counts and the bounding box of a header; InputError where the version of the file
  /// cannot hold so many points.
  void putCounts(const LasHeader& header);
  void commit() { file_.commit(); }

 private:
  std::string name_;
  AtomicFile file_;
  /// The kernel lets one thread at a time write to a file and makes the others spin: with other
  /// work on the machine copying takes five times as long. Waiting here costs nothing.
  std::mutex one_writer_;
  std::unique_ptr<LazPointWriter> laz_;
  std::uint64_t offset_to_points_;
  std::size_t record_length_;
};

}  // namespace pcl_als::detail
