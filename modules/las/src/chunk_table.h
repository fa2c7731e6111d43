// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/las/laz_io.h>
#include <pcl_als/las/laz_schema.h>

namespace pcl_als::laz {

/// One compressed chunk of a file.
struct Chunk {
  std::uint64_t first = 0;   ///< index of its first point
  std::uint64_t points = 0;  ///< that are decoded
  std::uint64_t begin = 0, end = 0;
  /// The chunk holds further points, which the header does not announce.
  bool holds_more = false;
};

/// Where the points of a file lie.
struct PointExtent {
  std::uint64_t offset_to_points = 0, file_size = 0, point_count = 0;
};

/** \brief The chunks of a file, from its chunk table or, where there is none, from the chunks.
 *
 * Without a table, the chunks of layered files follow from the sizes in them. Pointwise chunks of a
 * fixed size are found one by one in decoding: until then `complete` is false, the chunks beyond
 * the last known one are missing and its end is the end of the file.
 */
struct ChunkTable {
  std::vector<Chunk> chunks;
  bool complete = true;
  bool from_table = false;  ///< the chunks are those of the chunk table of the file
  /// Position behind the chunk table; 0: not known, or the table is at the end of the file.
  std::uint64_t end = 0;
  /// Index of the chunk with a point.
  std::size_t chunkOf(std::uint64_t point) const;
  /// Whether Chunk::end is known before the chunk is decoded.
  bool knowsEnds(const LazSchema& schema) const { return from_table || schema.layered(); }
};

/// Damage where the chunks cannot hold the announced points.
/// \param incomplete accepts chunks that hold fewer, and chunks that cannot hold their points
ChunkTable readChunkTable(const LazSchema& schema, const LazReadAt& read, const PointExtent& extent,
                          bool incomplete = false);
/// Damage where the bytes of a chunk cannot hold its points, or not plausibly.
/// \param record_length bytes of a decoded point
void checkDensity(const Chunk& chunk, std::size_t record_length);

/// Bytes of the chunk table. \param points per chunk, used where their number varies.
std::vector<std::uint8_t> serialiseChunkTable(const LazSchema& schema,
                                              const std::vector<std::uint32_t>& points,
                                              const std::vector<std::uint32_t>& bytes);

}  // namespace pcl_als::laz
