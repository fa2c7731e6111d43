// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "intact_chunks.h"

#include <algorithm>

#include <pcl_als/common/parallel.h>

#include "byte_source.h"
#include "chunk_coder.h"

namespace pcl_als::laz {
namespace {

constexpr std::size_t kDecodedBytes = std::size_t{1} << 18;  ///< of records that are not kept

/// Whether all points of a chunk can be decoded and its data end behind them.
bool decodes(ChunkDecoder& decoder, const LazReadAt& read, const Chunk& chunk,
             std::size_t record_length, bool knows_end) {
  const std::size_t most = std::max<std::size_t>(1, kDecodedBytes / record_length);
  try {
    checkDensity(chunk, record_length);
    decoder.open(&read, chunk.begin, chunk.end);
    std::vector<std::uint8_t> records(std::min<std::uint64_t>(most, chunk.points) * record_length);
    for (std::uint64_t done = 0; done < chunk.points;) {
      const std::size_t part = std::min<std::uint64_t>(most, chunk.points - done);
      decoder.decode(part, records.data());
      done += part;
    }
    requireEnd(decoder, chunk, knows_end);
  } catch (const Damage&) {
    return false;
  }
  return true;
}

/// The chunks of a file without table up to the first one that cannot be decoded.
std::vector<Chunk> walkIntact(const LazSchema& schema, const LazReadAt& read,
                              const LazPoints& points, Chunk next) {
  std::vector<Chunk> intact;
  const auto decoder = makeChunkDecoder(schema, points.fields);
  while (next.points > 0 && decodes(*decoder, read, next, schema.recordLength(), false)) {
    next.end = decoder->end();
    intact.push_back(next);
    next.first += next.points;
    next.points = std::min<std::uint64_t>(schema.chunk_size, points.point_count - next.first);
    next.begin = next.end;
    next.end = points.file_size;
  }
  return intact;
}

}  // namespace

LazIntact findIntactChunks(const LazSchema& schema, const LazReadAt& read, const LazPoints& points,
                           ChunkTable& table) {
  LazIntact found;
  if (table.chunks.empty()) return found;
  if (!schema.chunked() || !table.complete) {
    table.chunks = walkIntact(schema, read, points, table.chunks.front());
    table.complete = true;
    for (const Chunk& chunk : table.chunks) found.chunks.push_back({chunk.first, chunk.points});
    return found;
  }
  std::vector<char> intact(table.chunks.size());
  parallelFor(table.chunks.size(), points.threads, [&](std::size_t i) {
    const Chunk& chunk = table.chunks[i];
    const auto decoder = makeChunkDecoder(schema, points.fields);
    intact[i] = chunk.points > 0 &&
                decodes(*decoder, read, chunk, schema.recordLength(), table.knowsEnds(schema));
  });
  if (table.from_table) found.chunk_count = table.chunks.size();
  for (std::size_t i = 0; i < intact.size(); ++i)
    if (intact[i] != 0) found.chunks.push_back({table.chunks[i].first, table.chunks[i].points});
  return found;
}

}  // namespace pcl_als::laz
