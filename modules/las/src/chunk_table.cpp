// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "chunk_table.h"

#include <algorithm>

#include "chunk_coder.h"
#include "integer_predictor.h"
#include "point_context.h"

namespace pcl_als::laz {
namespace {

constexpr std::uint64_t kPointer = 8, kTableHeader = 8;
constexpr std::size_t kPointsContext = 0, kBytesContext = 1;
// The shares of the other symbols of an alphabet of n are at least (n - 3) / 2^15. A point costs a
// symbol of 64 or 128 for what changes, and at least two of 33 for x and y: 0.0065 bits or more,
// which is at most 1250 points in a byte.
constexpr std::uint64_t kMostPointsPerByte = 2048;
// Extra bytes of layered points that never change cost nothing. Records of 256 bytes remain
// possible at any density, while a small file cannot ask for an unlimited time.
constexpr std::uint64_t kMostRecordBytesPerByte = 256 * kMostPointsPerByte;

std::uint64_t loadPointer(const LazReadAt& read, std::uint64_t position) {
  std::uint8_t bytes[kPointer];
  read(position, kPointer, bytes);
  return load<std::uint64_t>(bytes);
}

/// In place of the position of the chunk table: it is at the end of the file.
constexpr std::uint64_t kStreamed = ~std::uint64_t{0};

/// Position of the chunk table; 0 where there is none.
std::uint64_t findTable(const LazReadAt& read, const PointExtent& extent) {
  const std::uint64_t chunks = extent.offset_to_points + kPointer;
  if (extent.file_size < chunks) throw Damage("the file ends before its points");
  std::uint64_t table = loadPointer(read, extent.offset_to_points);
  if (table == kStreamed && extent.file_size >= chunks + kTableHeader + kPointer)
    table = loadPointer(read, extent.file_size - kPointer);
  const bool inside = table >= chunks && extent.file_size >= kTableHeader &&
                      table <= extent.file_size - kTableHeader;
  return inside ? table : 0;
}

void checkPoints(const ChunkTable& table, const PointExtent& extent) {
  const std::uint64_t points =
      table.chunks.empty() ? 0 : table.chunks.back().first + table.chunks.back().points;
  if (points < extent.point_count)
    throw Damage("its chunks hold " + std::to_string(points) + " of the " +
                 std::to_string(extent.point_count) + " points that the header announces");
}

/// Reads the table at a position, which ends before the file does.
ChunkTable readTable(const LazSchema& schema, const LazReadAt& read, const PointExtent& extent,
                     std::uint64_t position) {
  EntropyDecoder coder;
  ByteSource& source = coder.source();
  source.open(&read, position, extent.file_size);
  if (source.nextU32() != 0) throw Damage("its chunk table is of an unknown version");
  const std::uint64_t count = source.nextU32();
  Chunk next;
  next.end = extent.offset_to_points + kPointer;
  if (count > (position - next.end) / schema.recordLength())
    throw Damage("its chunk table announces more chunks than fit into the file");
  ChunkTable table;
  table.from_table = true;
  table.end = source.position();
  if (count == 0) return table;
  coder.start();
  IntegerPredictor<EntropyDecoder> numbers(32, 2);
  std::int32_t points = 0, bytes = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    if (schema.variableChunks()) points = numbers.code(coder, points, 0, kPointsContext);
    bytes = numbers.code(coder, bytes, 0, kBytesContext);
    next.first += next.points;
    next.points = schema.variableChunks() ? static_cast<std::uint32_t>(points) : schema.chunk_size;
    next.begin = next.end;
    next.end += static_cast<std::uint32_t>(bytes);
    if (next.end > position) throw Damage("its chunk table reaches past the chunks");
    table.chunks.push_back(next);
  }
  table.end = source.position();
  return table;
}

/// The last chunk of a fixed size holds what is left. No chunk is decoded beyond the points that
/// the header announces: a chunk size without sense must not ask for memory.
void limitPoints(ChunkTable& table, const LazSchema& schema, const PointExtent& extent) {
  const bool counted = schema.variableChunks() || (schema.layered() && !table.from_table);
  for (Chunk& chunk : table.chunks) {
    chunk.first = std::min(chunk.first, extent.point_count);
    const std::uint64_t left = extent.point_count - chunk.first;
    if (chunk.points <= left) continue;
    chunk.points = left;
    chunk.holds_more = counted || &chunk != &table.chunks.back();
  }
}

/// Follows the sizes in layered chunks up to the announced number of points.
ChunkTable walkLayers(const LazSchema& schema, const LazReadAt& read, const PointExtent& extent) {
  ChunkTable table;
  Chunk next;
  next.end = extent.offset_to_points + kPointer;
  while (next.first + next.points < extent.point_count) {
    next.first += next.points;
    next.begin = next.end;
    LayeredExtent found;
    try {
      found = layeredExtent(schema, read, next.begin, extent.file_size);
    } catch (const Damage&) {
      break;  // checkPoints() says how many points are missing
    }
    if (found.points == 0) break;
    next.points = found.points;
    next.end = found.end;
    table.chunks.push_back(next);
  }
  return table;
}

/// A file without table whose chunks are found in decoding.
ChunkTable beginWalk(const LazSchema& schema, const PointExtent& extent) {
  if (schema.variableChunks())
    throw Damage(
        "its chunk table is missing or damaged, without which chunks of variable size "
        "cannot be found");
  ChunkTable table;
  Chunk first;
  first.begin = extent.offset_to_points + (schema.chunked() ? kPointer : 0);
  first.end = extent.file_size;
  first.points = extent.point_count;
  if (schema.chunked()) first.points = std::min<std::uint64_t>(first.points, schema.chunk_size);
  if (first.begin > first.end) throw Damage("the file ends before its points");
  table.complete = first.points == extent.point_count;
  table.chunks.push_back(first);
  return table;
}

ChunkTable findChunks(const LazSchema& schema, const LazReadAt& read, const PointExtent& extent) {
  if (!schema.chunked()) return beginWalk(schema, extent);
  const std::uint64_t position = findTable(read, extent);
  if (position != 0) {
    try {
      ChunkTable table = readTable(schema, read, extent, position);
      if (loadPointer(read, extent.offset_to_points) == kStreamed) table.end = 0;
      return table;
    } catch (const Damage&) {
      if (schema.variableChunks() && !schema.layered()) throw;
    }
  }
  return schema.layered() ? walkLayers(schema, read, extent) : beginWalk(schema, extent);
}

}  // namespace

std::size_t ChunkTable::chunkOf(std::uint64_t point) const {
  const auto after =
      std::upper_bound(chunks.begin(), chunks.end(), point,
                       [](std::uint64_t p, const Chunk& chunk) { return p < chunk.first; });
  return static_cast<std::size_t>(after - chunks.begin()) - 1;
}

void checkDensity(const Chunk& chunk, std::size_t record_length) {
  const std::uint64_t bytes = chunk.end - chunk.begin;
  if (chunk.points / kMostPointsPerByte > bytes ||
      chunk.points / (kMostRecordBytesPerByte / record_length) > bytes)
    throw Damage("a chunk of " + std::to_string(bytes) + " bytes cannot hold " +
                 std::to_string(chunk.points) + " points");
}

ChunkTable readChunkTable(const LazSchema& schema, const LazReadAt& read, const PointExtent& extent,
                          bool incomplete) {
  if (extent.point_count == 0) return ChunkTable();
  ChunkTable table = findChunks(schema, read, extent);
  if (table.complete && !incomplete) checkPoints(table, extent);
  limitPoints(table, schema, extent);
  if (incomplete) return table;
  for (const Chunk& chunk : table.chunks) checkDensity(chunk, schema.recordLength());
  return table;
}

std::vector<std::uint8_t> serialiseChunkTable(const LazSchema& schema,
                                              const std::vector<std::uint32_t>& points,
                                              const std::vector<std::uint32_t>& bytes) {
  std::vector<std::uint8_t> out(kTableHeader);
  store(&out[4], static_cast<std::uint32_t>(bytes.size()));
  if (bytes.empty()) return out;
  EntropyEncoder coder;
  coder.start();
  IntegerPredictor<EntropyEncoder> numbers(32, 2);
  std::uint32_t last_points = 0, last_bytes = 0;
  const auto code = [&](std::uint32_t& last, std::uint32_t now, std::size_t context) {
    numbers.code(coder, static_cast<std::int32_t>(last), static_cast<std::int32_t>(now), context);
    last = now;
  };
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (schema.variableChunks()) code(last_points, points[i], kPointsContext);
    code(last_bytes, bytes[i], kBytesContext);
  }
  coder.finish();
  out.insert(out.end(), coder.data(), coder.data() + coder.size());
  return out;
}

}  // namespace pcl_als::laz
