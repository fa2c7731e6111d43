// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <pcl_als/las/laz_io.h>
#include <pcl_als/las/laz_schema.h>

#include "chunk_table.h"

namespace pcl_als::laz {

/// Decodes the points of one chunk after the other; every chunk in pieces of any size.
class ChunkDecoder {
 public:
  virtual ~ChunkDecoder() = default;
  /// Begins the chunk in the bytes [begin, end) of the file.
  virtual void open(const LazReadAt* read, std::uint64_t begin, std::uint64_t end) = 0;
  /// The next records of the chunk. Damage where the bytes contradict themselves.
  virtual void decode(std::size_t records, std::uint8_t* out) = 0;
  /// Where the chunk ends in the file, after its last record was decoded.
  virtual std::uint64_t end() const = 0;
  /// Whether the compressed data end behind the records that were decoded, as an encoder ends them.
  /// Layers must take all of their bytes, and the chunk must have no further record. Nearly all
  /// damaged chunks that can be decoded at all do not end so.
  virtual bool ended() const = 0;
};

/// Encodes one chunk after the other.
class ChunkEncoder {
 public:
  virtual ~ChunkEncoder() = default;
  virtual void encode(std::size_t records, const std::uint8_t* data) = 0;
  /// Appends the bytes of the chunk, if it has a record, and begins the next one.
  virtual void finish(std::vector<std::uint8_t>& out) = 0;
};

/// Damage where a decoder that has decoded all points of a chunk does not stand at its end: the
/// format has no checksum, but behind most damage decoding loses its way.
/// \param knows_end the end of the chunk is known from elsewhere
void requireEnd(const ChunkDecoder& decoder, const Chunk& chunk, bool knows_end);

/// \param fields LazField bits, of layered chunks.
std::unique_ptr<ChunkDecoder> makeChunkDecoder(const LazSchema& schema, unsigned fields);
std::unique_ptr<ChunkEncoder> makeChunkEncoder(const LazSchema& schema);

/// End of a layered chunk from the sizes of its layers, without decoding; and its points.
struct LayeredExtent {
  std::uint64_t end = 0;
  std::uint32_t points = 0;
};
LayeredExtent layeredExtent(const LazSchema& schema, const LazReadAt& read, std::uint64_t begin,
                            std::uint64_t end);

}  // namespace pcl_als::laz
