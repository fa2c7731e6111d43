// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/laz_point_writer.h>

#include "chunk_coder.h"
#include "chunk_table.h"
#include "encoding_queue.h"

namespace pcl_als {
namespace {

constexpr std::size_t kRunBytes = std::size_t{1} << 18;  ///< of records, for one thread
constexpr std::uint64_t kPointer = 8;

}  // namespace

struct LazPointWriter::State {
  LazSchema schema;
  LazWriteAt write_at;
  std::uint64_t offset_to_points = 0, position = 0;
  std::size_t record_length = 0;
  std::unique_ptr<laz::EncodingRun> run;  ///< that grows
  std::vector<std::uint32_t> chunk_points, chunk_bytes;
  std::unique_ptr<laz::ChunkEncoder> stream;  ///< of a file without chunks
  std::unique_ptr<laz::EncodingQueue> queue;  ///< of one with chunks

  void append(const std::uint8_t* records, std::size_t count);
  void endChunk();
  void submit();
  void put(const std::vector<std::uint8_t>& bytes);
  void putRun(const laz::EncodingRun& run);
};

/// Takes records up to the end of the chunk that grows at most.
void LazPointWriter::State::append(const std::uint8_t* records, std::size_t count) {
  while (count > 0) {
    if (!run) run = queue->emptyRun();
    const std::size_t begun = run->points(record_length) - run->ended();
    const std::size_t part = std::min<std::size_t>(count, schema.chunk_size - begun);
    run->records.insert(run->records.end(), records, records + part * record_length);
    records += part * record_length;
    count -= part;
    if (begun + part == schema.chunk_size) endChunk();
  }
}

/// Ends the chunk that grows, if it has a point.
void LazPointWriter::State::endChunk() {
  if (!run || run->points(record_length) == run->ended()) return;
  run->ends.push_back(run->points(record_length));
  if (run->records.size() >= kRunBytes) submit();
}

void LazPointWriter::State::submit() {
  queue->submit(std::move(run));
}

void LazPointWriter::State::put(const std::vector<std::uint8_t>& bytes) {
  write_at(position, bytes.size(), bytes.data());
  position += bytes.size();
}

void LazPointWriter::State::putRun(const laz::EncodingRun& encoded) {
  put(encoded.bytes);
  chunk_bytes.insert(chunk_bytes.end(), encoded.chunk_bytes.begin(), encoded.chunk_bytes.end());
  std::size_t first = 0;
  for (const std::size_t end : encoded.ends) {
    chunk_points.push_back(static_cast<std::uint32_t>(end - first));
    first = end;
  }
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
    s.queue = std::make_unique<laz::EncodingQueue>(
        s.schema, threads, [&s](const laz::EncodingRun& run) { s.putRun(run); });
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
  if (s.run) s.submit();
  s.queue->finish();
  const std::uint64_t table = s.position;
  s.write_at(s.offset_to_points, sizeof table, &table);
  s.put(laz::serialiseChunkTable(s.schema, s.chunk_points, s.chunk_bytes));
  return s.position;
}

}  // namespace pcl_als
