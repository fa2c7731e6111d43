// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include <pcl_als/las/laz_io.h>
#include <pcl_als/las/laz_schema.h>

namespace pcl_als {

/** \brief Encodes point records into a LAZ file.
 *
 * Chunks are encoded on several threads and written in the order of the file; the bytes do not
 * depend on the number of threads. Files without chunks (LazCompressor::pointwise) are kept in
 * memory until finish().
 *
 * \code
 * LazPointWriter writer(LazSchema::forFormat(6, 30), write_at, offset_to_points);
 * writer.write(records.data(), 1000);
 * const std::uint64_t end = writer.finish();
 * \endcode
 */
class LazPointWriter {
 public:
  /// \param threads 0: all cores.
  LazPointWriter(LazSchema schema, LazWriteAt write, std::uint64_t offset_to_points,
                 int threads = 0);
  ~LazPointWriter();

  void write(const void* records, std::size_t count);
  /// Ends a chunk where the schema has chunks of variable size; UsageError else.
  void endChunk();
  /// Writes what is left and the chunk table. \return the position behind it.
  std::uint64_t finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
