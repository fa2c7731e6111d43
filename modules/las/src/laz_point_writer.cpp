// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/las/laz_point_writer.h>

#include "chunk_coder.h"
#include "chunk_table.h"

namespace pcl_als {
namespace {

constexpr std::size_t kBatchPerThread = 2;                 ///< chunks
constexpr std::size_t kBatchBytes = std::size_t{1} << 20;  ///< of records, at least
constexpr std::size_t kRunBytes = std::size_t{1} << 18;    ///< of records, for one thread
constexpr std::uint64_t kPointer = 8;

}  // namespace

struct LazPointWriter::State {
  LazSchema schema;
  LazWriteAt write_at;
  std::uint64_t offset_to_points = 0, position = 0;
  int threads = 0;
  std::size_t record_length = 0;
  std::vector<std::uint8_t> pending;  ///< records
  std::vector<std::size_t> ends;      ///< of the complete chunks in it, in points
  std::vector<std::uint32_t> chunk_points, chunk_bytes;
  std::unique_ptr<laz::ChunkEncoder> stream;  ///< of a file without chunks
  std::mutex pool_mutex;
  std::vector<std::unique_ptr<laz::ChunkEncoder>> pool;

  std::size_t pendingPoints() const { return pending.size() / record_length; }
  bool batchComplete() const;
  void append(const std::uint8_t* records, std::size_t count);
  void encodePending();
  std::vector<std::uint8_t> encodeRun(std::size_t begin, std::size_t end,
                                      std::vector<std::uint32_t>& bytes);
  void put(const std::vector<std::uint8_t>& bytes);
};

bool LazPointWriter::State::batchComplete() const {
  return ends.size() >= kBatchPerThread * threadCount(threads) &&
         ends.back() * record_length >= kBatchBytes;
}

/// Takes records up to the end of the chunk that grows at most.
void LazPointWriter::State::append(const std::uint8_t* records, std::size_t count) {
  while (count > 0) {
    const std::size_t begun = pendingPoints() - (ends.empty() ? 0 : ends.back());
    const std::size_t part = std::min<std::size_t>(count, schema.chunk_size - begun);
    pending.insert(pending.end(), records, records + part * record_length);
    records += part * record_length;
    count -= part;
    if (begun + part < schema.chunk_size) continue;
    ends.push_back(pendingPoints());
    if (batchComplete()) encodePending();
  }
}

void LazPointWriter::State::put(const std::vector<std::uint8_t>& bytes) {
  write_at(position, bytes.size(), bytes.data());
  position += bytes.size();
}

/// Encodes the complete chunks [begin, end) of those pending.
std::vector<std::uint8_t> LazPointWriter::State::encodeRun(std::size_t begin, std::size_t end,
                                                           std::vector<std::uint32_t>& bytes) {
  std::unique_ptr<laz::ChunkEncoder> encoder;
  {
    const std::lock_guard<std::mutex> lock(pool_mutex);
    if (!pool.empty()) {
      encoder = std::move(pool.back());
      pool.pop_back();
    }
  }
  if (!encoder) encoder = laz::makeChunkEncoder(schema);
  std::vector<std::uint8_t> out;
  for (std::size_t i = begin; i < end; ++i) {
    const std::size_t first = i == 0 ? 0 : ends[i - 1], before = out.size();
    encoder->encode(ends[i] - first, pending.data() + first * record_length);
    encoder->finish(out);
    bytes.push_back(static_cast<std::uint32_t>(out.size() - before));
  }
  const std::lock_guard<std::mutex> lock(pool_mutex);
  pool.push_back(std::move(encoder));
  return out;
}

/// Encodes and writes all complete chunks.
void LazPointWriter::State::encodePending() {
  std::vector<std::size_t> runs{0};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const std::size_t run_begin = runs.back() == 0 ? 0 : ends[runs.back() - 1];
    if ((ends[i] - run_begin) * record_length >= kRunBytes || i + 1 == ends.size())
      runs.push_back(i + 1);
  }
  std::vector<std::vector<std::uint8_t>> encoded(runs.size() - 1);
  std::vector<std::vector<std::uint32_t>> bytes(encoded.size());
  parallelFor(encoded.size(), threads,
              [&](std::size_t i) { encoded[i] = encodeRun(runs[i], runs[i + 1], bytes[i]); });
  for (std::size_t i = 0; i < encoded.size(); ++i) {
    put(encoded[i]);
    chunk_bytes.insert(chunk_bytes.end(), bytes[i].begin(), bytes[i].end());
  }
  for (std::size_t i = 0; i < ends.size(); ++i)
    chunk_points.push_back(static_cast<std::uint32_t>(ends[i] - (i == 0 ? 0 : ends[i - 1])));
  if (!ends.empty())
    pending.erase(pending.begin(),
                  pending.begin() + static_cast<std::ptrdiff_t>(ends.back() * record_length));
  ends.clear();
}

LazPointWriter::LazPointWriter(LazSchema schema, LazWriteAt write, std::uint64_t offset_to_points,
                               int threads)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.schema = std::move(schema);
  s.write_at = std::move(write);
  s.offset_to_points = offset_to_points;
  s.threads = threads;
  s.record_length = s.schema.recordLength();
  s.position = offset_to_points + (s.schema.chunked() ? kPointer : 0);
  if (!s.schema.chunked()) s.stream = laz::makeChunkEncoder(s.schema);
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
  const std::size_t last = s.ends.empty() ? 0 : s.ends.back();
  if (s.pendingPoints() > last) s.ends.push_back(s.pendingPoints());
  if (s.batchComplete()) s.encodePending();
}

std::uint64_t LazPointWriter::finish() {
  State& s = *state_;
  if (s.stream) {
    std::vector<std::uint8_t> bytes;
    s.stream->finish(bytes);
    s.put(bytes);
    return s.position;
  }
  const std::size_t last = s.ends.empty() ? 0 : s.ends.back();
  if (s.pendingPoints() > last) s.ends.push_back(s.pendingPoints());
  s.encodePending();
  const std::uint64_t table = s.position;
  s.write_at(s.offset_to_points, sizeof table, &table);
  s.put(laz::serialiseChunkTable(s.schema, s.chunk_points, s.chunk_bytes));
  return s.position;
}

}  // namespace pcl_als
