// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/las/las_window.h>
#include <pcl_als/las/laz_io.h>
#include <pcl_als/las/laz_schema.h>

namespace pcl_als {

/// Where the compressed points lie in a file, and how they are wanted.
struct LazPoints {
  std::uint64_t offset_to_points = 0;
  std::uint64_t file_size = 0;
  std::uint64_t point_count = 0;
  unsigned fields = kLazAllFields;  ///< LazField bits
  int threads = 0;                  ///< 0: all cores
  /// Accept a damaged file: only the records of findIntact() can be read.
  bool keep_intact = false;
};

/// The chunks of a damaged file that can be decoded.
struct LazIntact {
  std::vector<LasRecordRange> chunks;  ///< their records, in file order
  /// Chunks of the file; 0: not known, because the chunk table is lost.
  std::uint64_t chunk_count = 0;
};

/** \brief Decodes the point records of a LAZ file.
 *
 * Chunks are decoded on several threads, ahead of a reader that proceeds in the order of the file.
 * The memory depends on the number of threads and the size of a chunk, not on the file; chunks of
 * more than 64 MB of points are decoded in pieces. The records do not depend on the number of
 * threads.
 *
 * \code
 * LazPointReader reader(schema, read_at, {offset_to_points, file_size, point_count}, "a.laz");
 * reader.read(0, 1000, records.data());
 * \endcode
 */
class LazPointReader {
 public:
  /// InputError where the chunk table contradicts the file. \param name for messages.
  LazPointReader(LazSchema schema, LazReadAt read, const LazPoints& points, std::string name);
  ~LazPointReader();

  /** Records [first, first + count), packed as in a plain LAS file; several threads may call at
   * once. InputError, which names the chunk, where the compressed data are damaged or cut off.
   */
  void read(std::uint64_t first, std::size_t count, void* out);
  /// The records of several ranges, one behind the other; nothing is decoded ahead.
  void read(const std::vector<LasRecordRange>& ranges, void* out);
  /// The records of the chunk in the bytes [begin, end) of the file; no records where the file has
  /// no such chunk.
  LasRecordRange chunkAt(std::uint64_t begin, std::uint64_t end);
  /// Decodes the whole file once, on several threads where its chunk table is intact, in constant
  /// memory. Without a table, chunks of pointwise files are found up to the first damaged one.
  LazIntact findIntact();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
