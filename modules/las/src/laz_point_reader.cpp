// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/las/damaged_file.h>
#include <pcl_als/las/laz_point_reader.h>

#include "byte_source.h"
#include "chunk_coder.h"
#include "chunk_table.h"
#include "intact_chunks.h"
#include "ordered_work.h"

namespace pcl_als {
namespace {

using laz::Chunk;

constexpr std::size_t kLargestDecodedChunk = std::size_t{1} << 26;  ///< bytes of records
constexpr std::size_t kReadAheadPerThread = 2;                      ///< runs of chunks
constexpr std::size_t kSkippedRecords = 4096;

/// Consecutive chunks [begin, end) in memory.
struct Decoded {
  std::size_t begin = 0, end = 0;
  std::uint64_t first = 0, count = 0;  ///< points
  std::vector<std::uint8_t> records;
  bool holds(std::uint64_t point) const { return point >= first && point - first < count; }
};

/// Where the decoder of a file that is decoded in order stands.
struct Cursor {
  std::unique_ptr<laz::ChunkDecoder> decoder;
  std::size_t chunk = 0;
  std::uint64_t next = 0;  ///< point
  bool open = false;
};

}  // namespace

struct LazPointReader::State {
  LazSchema schema;
  LazReadAt read_at;
  LazPoints points;
  std::string name;
  std::size_t record_length = 0;
  laz::ChunkTable table;
  bool in_order = false;  ///< chunks too large for memory, or found in decoding only
  std::mutex mutex;
  Decoded decoded;
  std::uint64_t expected = 0;    ///< the next point of a reader that proceeds in order
  std::size_t next_ahead = 0;    ///< the chunk behind those that are decoded ahead
  std::uint64_t ahead_from = 0;  ///< the first point of these
  std::vector<std::vector<std::uint8_t>> spare;
  Cursor cursor;
  std::mutex pool_mutex;
  std::vector<std::unique_ptr<laz::ChunkDecoder>> pool;
  std::unique_ptr<laz::OrderedWork<Decoded>> ahead;  ///< ends before the pool does

  void open();
  bool holdsLargeChunk() const;
  [[noreturn]] void refuse(std::size_t chunk, const char* what) const;
  std::unique_ptr<laz::ChunkDecoder> takeDecoder();
  void decodeChunk(laz::ChunkDecoder& decoder, std::size_t index, std::uint8_t* out) const;
  Decoded placed(std::size_t begin, std::size_t end) const;
  std::size_t runEnd(std::size_t begin) const;
  void decodeChunks(std::size_t begin, std::size_t end, Decoded& to);
  void decodeFrom(std::uint64_t point, std::uint64_t wanted_end);
  void decodeAhead();
  void takeNext(std::uint64_t point);
  void readDecoded(std::uint64_t first, std::size_t count, std::uint8_t* out);
  void readInOrder(std::uint64_t first, std::size_t count, std::uint8_t* out);
  void readRanges(const std::vector<LasRecordRange>& ranges, std::uint8_t* out);
  void checkRange(std::uint64_t first, std::uint64_t count) const;
  void placeCursor(std::uint64_t point);
  void openNextChunk();
  void advance(std::size_t count, std::uint8_t* out);
};

void LazPointReader::State::open() {
  record_length = schema.recordLength();
  try {
    table = laz::readChunkTable(schema, read_at,
                                {points.offset_to_points, points.file_size, points.point_count},
                                points.keep_intact);
  } catch (const laz::Damage& damage) {
    throw DamagedFile(name + ": " + damage.what() + " (is the file complete?)");
  }
  in_order = !table.complete || holdsLargeChunk();
}

bool LazPointReader::State::holdsLargeChunk() const {
  return std::any_of(table.chunks.begin(), table.chunks.end(), [this](const Chunk& chunk) {
    return chunk.points > kLargestDecodedChunk / record_length;
  });
}

void LazPointReader::State::refuse(std::size_t chunk, const char* what) const {
  const Chunk& c = table.chunks[chunk];
  throw DamagedFile(name + ": chunk " + std::to_string(chunk + 1) + " (points " +
                    std::to_string(c.first + 1) + " to " + std::to_string(c.first + c.points) +
                    "): " + what + " (damaged or truncated copy?)");
}

std::unique_ptr<laz::ChunkDecoder> LazPointReader::State::takeDecoder() {
  const std::lock_guard<std::mutex> lock(pool_mutex);
  if (pool.empty()) return laz::makeChunkDecoder(schema, points.fields);
  auto decoder = std::move(pool.back());
  pool.pop_back();
  return decoder;
}

void LazPointReader::State::decodeChunk(laz::ChunkDecoder& decoder, std::size_t index,
                                        std::uint8_t* out) const {
  const Chunk& chunk = table.chunks[index];
  if (chunk.points == 0) return;
  try {
    decoder.open(&read_at, chunk.begin, chunk.end);
    decoder.decode(chunk.points, out);
    laz::requireEnd(decoder, chunk, table.knowsEnds(schema));
  } catch (const laz::Damage& damage) {
    refuse(index, damage.what());
  }
}

/// The chunks [begin, end), not yet decoded.
Decoded LazPointReader::State::placed(std::size_t begin, std::size_t end) const {
  Decoded chunks;
  chunks.begin = begin, chunks.end = end;
  chunks.first = table.chunks[begin].first;
  const Chunk& last = table.chunks[end - 1];
  chunks.count = last.first + last.points - chunks.first;
  return chunks;
}

/// The end of a run of chunks for one thread.
std::size_t LazPointReader::State::runEnd(std::size_t begin) const {
  std::size_t end = begin + 1;
  std::uint64_t count = table.chunks[begin].points;
  for (; end < table.chunks.size() && count * record_length < laz::kRunBytes; ++end)
    count += table.chunks[end].points;
  return end;
}

/// Decodes some of the chunks that have their place.
void LazPointReader::State::decodeChunks(std::size_t begin, std::size_t end, Decoded& to) {
  auto decoder = takeDecoder();
  for (std::size_t i = begin; i < end; ++i) {
    const std::uint64_t before = table.chunks[i].first - to.first;
    decodeChunk(*decoder, i, to.records.data() + before * record_length);
  }
  const std::lock_guard<std::mutex> lock(pool_mutex);
  pool.push_back(std::move(decoder));
}

/// Decodes the chunks from that of \a point on that reach up to \a wanted_end.
void LazPointReader::State::decodeFrom(std::uint64_t point, std::uint64_t wanted_end) {
  const std::size_t first = table.chunkOf(point);
  std::vector<std::size_t> runs{first};
  std::uint64_t count = 0;
  for (std::size_t i = first; i < table.chunks.size(); i = runs.back()) {
    if (count > 0 &&
        (table.chunks[i].first >= wanted_end || count * record_length >= kLargestDecodedChunk))
      break;
    runs.push_back(runEnd(i));
    count = placed(first, runs.back()).count;
  }
  decoded.count = 0;  // nothing is held if an exception leaves from here
  Decoded chunks = placed(first, runs.back());
  chunks.records = std::move(decoded.records);
  chunks.records.resize(chunks.count * record_length);
  parallelFor(runs.size() - 1, points.threads,
              [&](std::size_t i) { decodeChunks(runs[i], runs[i + 1], chunks); });
  decoded = std::move(chunks);
}

/// Hands runs of chunks to the threads that decode ahead.
void LazPointReader::State::decodeAhead() {
  const std::size_t most = kReadAheadPerThread * ahead->threads();
  while (next_ahead < table.chunks.size() && ahead->size() < most) {
    Decoded run = placed(next_ahead, runEnd(next_ahead));
    const std::uint64_t held = run.first + run.count - ahead_from;
    if (ahead->size() > 0 && held * record_length > kLargestDecodedChunk) return;
    next_ahead = run.end;
    if (!spare.empty()) {
      run.records = std::move(spare.back());
      spare.pop_back();
    }
    ahead->submit(std::move(run));
  }
}

/// The run of chunks with \a point, of a reader that proceeds in order.
void LazPointReader::State::takeNext(std::uint64_t point) {
  if (!ahead) {
    ahead = std::make_unique<laz::OrderedWork<Decoded>>(points.threads, [this](Decoded& run) {
      run.records.resize(run.count * record_length);
      decodeChunks(run.begin, run.end, run);
    });
  }
  const std::size_t chunk = table.chunkOf(point);
  if (ahead->size() == 0 || table.chunks[chunk].first != ahead_from) {
    ahead->clear();
    next_ahead = chunk;
    ahead_from = table.chunks[chunk].first;
  }
  if (!decoded.records.empty()) spare.push_back(std::move(decoded.records));
  decoded = Decoded();
  decodeAhead();
  ahead_from = ~std::uint64_t{0};  // nothing is known if an exception leaves from here
  decoded = ahead->take();
  ahead_from = decoded.first + decoded.count;
  decodeAhead();
}

void LazPointReader::State::readDecoded(std::uint64_t first, std::size_t count, std::uint8_t* out) {
  const std::uint64_t end = first + count;
  const bool in_sequence = first == expected;
  while (first < end) {
    if (!decoded.holds(first) && in_sequence)
      takeNext(first);
    else if (!decoded.holds(first))
      decodeFrom(first, end);
    const std::uint64_t part = std::min(end, decoded.first + decoded.count) - first;
    const std::uint8_t* from = decoded.records.data() + (first - decoded.first) * record_length;
    out = std::copy(from, from + part * record_length, out);
    first += part;
  }
  expected = end;
}

/// Moves the cursor to a chunk at or before a point.
void LazPointReader::State::placeCursor(std::uint64_t point) {
  const std::size_t chunk = table.chunkOf(point);
  if (cursor.open && cursor.next <= point && cursor.chunk >= chunk) return;
  if (!cursor.decoder) cursor.decoder = laz::makeChunkDecoder(schema, points.fields);
  cursor.chunk = chunk;
  cursor.next = table.chunks[chunk].first;
  cursor.decoder->open(&read_at, table.chunks[chunk].begin, table.chunks[chunk].end);
  cursor.open = true;
}

void LazPointReader::State::openNextChunk() {
  const Chunk last = table.chunks[cursor.chunk];
  ++cursor.chunk;
  if (cursor.chunk == table.chunks.size()) {
    Chunk next;
    next.first = last.first + last.points;
    next.points = std::min<std::uint64_t>(schema.chunk_size, points.point_count - next.first);
    next.begin = cursor.decoder->end();
    next.end = points.file_size;
    table.chunks.back().end = next.begin;
    table.chunks.push_back(next);
  }
  const Chunk& chunk = table.chunks[cursor.chunk];
  cursor.decoder->open(&read_at, chunk.begin, chunk.end);
}

/// Decodes records of the cursor's chunk, opening the next chunk where it ends.
void LazPointReader::State::advance(std::size_t count, std::uint8_t* out) {
  while (count > 0) {
    const Chunk& chunk = table.chunks[cursor.chunk];
    const std::uint64_t left = chunk.first + chunk.points - cursor.next;
    if (left == 0) {
      openNextChunk();
      continue;
    }
    const std::size_t part = std::min<std::uint64_t>(left, count);
    cursor.decoder->decode(part, out);
    out += part * record_length;
    cursor.next += part;
    count -= part;
    if (part == left) laz::requireEnd(*cursor.decoder, chunk, table.knowsEnds(schema));
  }
}

void LazPointReader::State::readInOrder(std::uint64_t first, std::size_t count, std::uint8_t* out) {
  try {
    placeCursor(first);
    std::vector<std::uint8_t> skipped;
    while (cursor.next < first) {
      const std::size_t part = std::min<std::uint64_t>(kSkippedRecords, first - cursor.next);
      skipped.resize(part * record_length);
      advance(part, skipped.data());
    }
    advance(count, out);
  } catch (const laz::Damage& damage) {
    cursor.open = false;
    refuse(cursor.chunk, damage.what());
  } catch (...) {
    cursor.open = false;
    throw;
  }
}

void LazPointReader::State::checkRange(std::uint64_t first, std::uint64_t count) const {
  if (first > points.point_count || count > points.point_count - first)
    throw UsageError(name + ": point records past the end were asked for");
}

/// Whole chunks are decoded where their records are to be, on several threads; parts of chunks one
/// after the other.
void LazPointReader::State::readRanges(const std::vector<LasRecordRange>& ranges,
                                       std::uint8_t* out) {
  struct Part {
    std::size_t chunk;
    std::uint8_t* out;
  };
  std::vector<Part> whole;
  for (const LasRecordRange& range : ranges) {
    checkRange(range.first, range.count);
    if (in_order) {
      readInOrder(range.first, range.count, out);
      out += range.count * record_length;
      continue;
    }
    for (std::uint64_t at = range.first, end = range.first + range.count; at < end;) {
      const std::size_t index = table.chunkOf(at);
      const Chunk& chunk = table.chunks[index];
      const std::uint64_t count = std::min(end, chunk.first + chunk.points) - at;
      if (count == chunk.points)
        whole.push_back({index, out});
      else
        readDecoded(at, count, out);
      out += count * record_length;
      at += count;
    }
  }
  parallelFor(whole.size(), points.threads, [&](std::size_t i) {
    auto decoder = takeDecoder();
    decodeChunk(*decoder, whole[i].chunk, whole[i].out);
    const std::lock_guard<std::mutex> lock(pool_mutex);
    pool.push_back(std::move(decoder));
  });
}

LazPointReader::LazPointReader(LazSchema schema, LazReadAt read, const LazPoints& points,
                               std::string name)
    : state_(std::make_unique<State>()) {
  state_->schema = std::move(schema);
  state_->read_at = std::move(read);
  state_->points = points;
  state_->name = std::move(name);
  state_->open();
}

LazPointReader::~LazPointReader() = default;

void LazPointReader::read(std::uint64_t first, std::size_t count, void* out) {
  State& s = *state_;
  s.checkRange(first, count);
  if (count == 0) return;
  const std::lock_guard<std::mutex> lock(s.mutex);
  auto* to = static_cast<std::uint8_t*>(out);
  if (s.in_order)
    s.readInOrder(first, count, to);
  else
    s.readDecoded(first, count, to);
}

void LazPointReader::read(const std::vector<LasRecordRange>& ranges, void* out) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  state_->readRanges(ranges, static_cast<std::uint8_t*>(out));
}

LazIntact LazPointReader::findIntact() {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  if (state_->ahead) state_->ahead->clear();
  LazIntact found =
      laz::findIntactChunks(state_->schema, state_->read_at, state_->points, state_->table);
  state_->in_order = state_->holdsLargeChunk();
  return found;
}

LasRecordRange LazPointReader::chunkAt(std::uint64_t begin, std::uint64_t end) {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  const std::vector<Chunk>& chunks = state_->table.chunks;
  const auto found =
      std::lower_bound(chunks.begin(), chunks.end(), begin,
                       [](const Chunk& chunk, std::uint64_t at) { return chunk.begin < at; });
  if (found == chunks.end() || found->begin != begin || found->end != end) return {};
  return {found->first, found->points};
}

}  // namespace pcl_als
