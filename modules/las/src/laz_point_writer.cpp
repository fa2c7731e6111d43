// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/laz_point_writer.h>

#include "chunk_coder.h"
#include "chunk_table.h"
#include "ordered_work.h"

namespace pcl_als {
namespace {

constexpr std::size_t kRunsPerThread = 2;  ///< that wait at most
constexpr std::uint64_t kPointer = 8;
constexpr std::uint64_t kMostReserved = 8 * laz::kRunBytes;  ///< more grows with the records

/// Consecutive chunks that one thread encodes.
struct Run {
  std::vector<std::uint8_t> records;
  std::vector<std::size_t> ends;  ///< of the complete chunks, in points of this run

  std::vector<std::uint8_t> bytes;         ///< encoded
  std::vector<std::uint32_t> chunk_bytes;  ///< of each chunk

  std::size_t ended() const { return ends.empty() ? 0 : ends.back(); }
  /// Keeps the memory.
  void clear() { records.clear(), ends.clear(), bytes.clear(), chunk_bytes.clear(); }
};

}  // namespace

struct LazPointWriter::State {
  LazSchema schema;
  LazWriteAt write_at;
  std::uint64_t offset_to_points = 0, position = 0;
  std::size_t record_length = 0;
  Run run;  ///< that grows
  std::vector<Run> spare;
  std::vector<std::uint32_t> chunk_points, chunk_bytes;
  std::unique_ptr<laz::ChunkEncoder> stream;  ///< of a file without chunks
  std::mutex pool_mutex;
  std::vector<std::unique_ptr<laz::ChunkEncoder>> pool;
  std::unique_ptr<laz::OrderedWork<Run>> work;  ///< of one with chunks; ends before the pool does

  std::size_t points() const { return run.records.size() / record_length; }
  void append(const std::uint8_t* records, std::size_t count);
  void endChunk();
  void submit();
  void encode(Run& chunks);
  void write(std::size_t most_waiting);
  void put(const std::vector<std::uint8_t>& bytes);
};

/// Takes records up to the end of the chunk that grows at most.
void LazPointWriter::State::append(const std::uint8_t* records, std::size_t count) {
  while (count > 0) {
    const std::size_t begun = points() - run.ended();
    const std::size_t part = std::min<std::size_t>(count, schema.chunk_size - begun);
    if (run.records.empty())
      run.records.reserve(std::min(kMostReserved, schema.chunk_size * record_length));
    run.records.insert(run.records.end(), records, records + part * record_length);
    records += part * record_length;
    count -= part;
    if (begun + part == schema.chunk_size) endChunk();
  }
}

/// Ends the chunk that grows, if it has a point.
void LazPointWriter::State::endChunk() {
  if (points() == run.ended()) return;
  run.ends.push_back(points());
  if (run.records.size() >= laz::kRunBytes) submit();
}

void LazPointWriter::State::submit() {
  work->submit(std::move(run));
  run = Run();
  if (!spare.empty()) {
    run = std::move(spare.back());
    spare.pop_back();
  }
  write(work->threads() > 1 ? kRunsPerThread * work->threads() : 0);
}

void LazPointWriter::State::encode(Run& chunks) {
  std::unique_ptr<laz::ChunkEncoder> encoder;
  {
    const std::lock_guard<std::mutex> lock(pool_mutex);
    if (!pool.empty()) {
      encoder = std::move(pool.back());
      pool.pop_back();
    }
  }
  if (!encoder) encoder = laz::makeChunkEncoder(schema);
  std::size_t first = 0;
  for (const std::size_t end : chunks.ends) {
    const std::size_t before = chunks.bytes.size();
    encoder->encode(end - first, chunks.records.data() + first * record_length);
    encoder->finish(chunks.bytes);
    chunks.chunk_bytes.push_back(static_cast<std::uint32_t>(chunks.bytes.size() - before));
    first = end;
  }
  const std::lock_guard<std::mutex> lock(pool_mutex);
  pool.push_back(std::move(encoder));
}

/// Writes the runs that are encoded, in order, and others until at most so many wait.
void LazPointWriter::State::write(std::size_t most_waiting) {
  while (work->size() > most_waiting || work->firstIsDone()) {
    Run done = work->take();
    put(done.bytes);
    chunk_bytes.insert(chunk_bytes.end(), done.chunk_bytes.begin(), done.chunk_bytes.end());
    std::size_t first = 0;
    for (const std::size_t end : done.ends) {
      chunk_points.push_back(static_cast<std::uint32_t>(end - first));
      first = end;
    }
    done.clear();
    spare.push_back(std::move(done));
  }
}

void LazPointWriter::State::put(const std::vector<std::uint8_t>& bytes) {
  write_at(position, bytes.size(), bytes.data());
  position += bytes.size();
}

LazPointWriter::LazPointWriter(LazSchema schema, LazWriteAt write, std::uint64_t offset_to_points,
                               int threads)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.schema = std::move(schema);
  s.write_at = std::move(write);
  s.offset_to_points = offset_to_points;
  s.record_length = s.schema.recordLength();
  s.position = offset_to_points + (s.schema.chunked() ? kPointer : 0);
  if (s.schema.chunked())
    s.work = std::make_unique<laz::OrderedWork<Run>>(threads, [&s](Run& run) { s.encode(run); });
  else
    s.stream = laz::makeChunkEncoder(s.schema);
}

LazPointWriter::~LazPointWriter() = default;

void LazPointWriter::write(const void* records, std::size_t count) {
  const auto* bytes = static_cast<const std::uint8_t*>(records);
  if (state_->stream)
    state_->stream->encode(count, bytes);
  else
    state_->append(bytes, count);
}

void LazPointWriter::endChunk() {
  State& s = *state_;
  if (!s.schema.variableChunks()) throw UsageError("the chunks of this LAZ file have a fixed size");
  s.endChunk();
}

std::uint64_t LazPointWriter::finish() {
  State& s = *state_;
  if (s.stream) {
    std::vector<std::uint8_t> bytes;
    s.stream->finish(bytes);
    s.put(bytes);
    return s.position;
  }
  s.endChunk();
  if (!s.run.ends.empty()) s.submit();
  s.write(0);
  const std::uint64_t table = s.position;
  s.write_at(s.offset_to_points, sizeof table, &table);
  s.put(laz::serialiseChunkTable(s.schema, s.chunk_points, s.chunk_bytes));
  return s.position;
}

}  // namespace pcl_als
