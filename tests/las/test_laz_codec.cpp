// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <mutex>
#include <set>
#include <thread>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/thread_limit.h>

#include "laz_file.h"
#include "laz_records.h"

namespace pcl_als {
namespace {

using test::ByteVector;
using test::LazRecords;
using test::PointKind;

LazSchema schemaOf(int format, std::size_t extra, std::uint32_t chunk_size) {
  return LazSchema::forFormat(format, test::kStandardLength[format] + extra, chunk_size);
}

class LazCodec : public testing::TestWithParam<int> {};

TEST_P(LazCodec, ThereAndBackKeepsEveryByte) {
  const int format = GetParam();
  for (const PointKind kind :
       {PointKind::survey, PointKind::random, PointKind::constant, PointKind::channels})
    for (const std::uint32_t chunk_size : {1U, 100U, 50000U}) {
      const std::size_t count = chunk_size == 1 ? 20 : 1234;
      const ByteVector records = LazRecords(format, 3, kind, 1).make(count);
      const LazSchema schema = schemaOf(format, 3, chunk_size);
      const ByteVector file = test::encode(schema, records);
      EXPECT_TRUE(test::decode(schema, file, count) == records)
          << "kind " << static_cast<int>(kind) << ", chunks of " << chunk_size;
    }
}

TEST_P(LazCodec, ThreadsChangeNothing) {
  const LazSchema schema = schemaOf(GetParam(), 0, 100);
  const ByteVector records = LazRecords(GetParam(), 0, PointKind::survey, 2).make(30000);
  const ByteVector file = test::encode(schema, records, 1);
  EXPECT_TRUE(test::encode(schema, records, 8) == file);
  EXPECT_TRUE(test::decode(schema, file, 30000, 8) == records);
}

TEST_P(LazCodec, AnyStepGivesTheSameRecords) {
  const LazSchema schema = schemaOf(GetParam(), 1, 64);
  const ByteVector records = LazRecords(GetParam(), 1, PointKind::survey, 3).make(1000);
  const ByteVector file = test::encode(schema, records);
  for (const std::size_t step : {1U, 63U, 64U, 65U, 1000U})
    EXPECT_TRUE(test::decode(schema, file, 1000, 2, step) == records) << step;
}

INSTANTIATE_TEST_SUITE_P(Formats, LazCodec, testing::Range(0, 11));

TEST(LazCodecSeek, ReadsAnyPlace) {
  for (const LazCompressor compressor :
       {LazCompressor::pointwise, LazCompressor::pointwise_chunked}) {
    LazSchema schema = schemaOf(1, 0, 50);
    schema.compressor = compressor;
    const ByteVector records = LazRecords(1, 0, PointKind::survey, 4).make(500);
    const ByteVector file = test::encode(schema, records);
    LazPointReader reader(schema, test::readFrom(file), {0, file.size(), 500}, "a.laz");
    ByteVector record(28);
    for (const std::size_t i : {499U, 0U, 250U, 251U, 249U, 50U, 49U}) {
      reader.read(i, 1, record.data());
      EXPECT_TRUE(std::equal(record.begin(), record.end(), records.begin() + 28 * i)) << i;
    }
    EXPECT_THROW(reader.read(400, 101, record.data()), UsageError);
  }
}

TEST(LazCodecChunks, OfVariableSizeAreKept) {
  for (const int format : {3, 6}) {
    const LazSchema schema = schemaOf(format, 0, kLazVariableChunks);
    const ByteVector records = LazRecords(format, 0, PointKind::survey, 5).make(1000);
    const ByteVector file = test::encode(schema, records, 2, {1, 2, 500, 503});
    EXPECT_TRUE(test::decode(schema, file, 1000, 2) == records);
  }
  EXPECT_THROW(LazPointWriter(schemaOf(3, 0, 10), nullptr, 0).endChunk(), UsageError);
}

TEST(LazCodecChunks, MayHoldMoreThanTheHeaderAnnounces) {
  for (const int format : {3, 6}) {
    const LazSchema schema = schemaOf(format, 0, 100);
    ByteVector records = LazRecords(format, 0, PointKind::survey, 8).make(350);
    const ByteVector file = test::encode(schema, records);
    records.resize(120 * schema.recordLength());
    EXPECT_TRUE(test::decode(schema, file, 120, 2) == records);
  }
}

TEST(LazCodecEmpty, FileWithoutPoints) {
  for (const int format : {0, 6}) {
    const LazSchema schema = schemaOf(format, 0, 100);
    EXPECT_EQ(test::encode(schema, {}).size(), 16U);  // position of the table, version, no chunks
    EXPECT_TRUE(test::decode(schema, test::encode(schema, {}), 0).empty());
  }
}

TEST(LazCodecFields, UnwantedLayersKeepTheFirstValueOfTheirChunk) {
  const LazSchema schema = schemaOf(7, 2, 100);
  const ByteVector records = LazRecords(7, 2, PointKind::survey, 6).make(300);
  const ByteVector file = test::encode(schema, records);
  const ByteVector some =
      test::decode(schema, file, 300, 1, 300, kLazZ | kLazGpsTime | kLazExtraBytes);
  for (std::size_t i = 0; i < 300; ++i) {
    const auto same = [&](std::size_t at, std::size_t size, std::size_t as) {
      return std::equal(&some[38 * i + at], &some[38 * i + at + size], &records[38 * as + at]);
    };
    const std::size_t first = i / 100 * 100;
    EXPECT_TRUE(same(0, 12, i) && same(22, 8, i) && same(36, 2, i)) << i;
    EXPECT_TRUE(same(12, 2, first) && same(16, 2, first) && same(30, 6, first)) << i;
  }
}

TEST(LazCodecMemory, UnwantedLayersAreNotRead) {
  const LazSchema schema = schemaOf(10, 0, 5000);
  const ByteVector records = LazRecords(10, 0, PointKind::random, 7).make(5000);
  const ByteVector file = test::encode(schema, records);
  std::size_t bytes_read = 0;
  const auto read = [&](std::uint64_t position, std::size_t bytes, void* out) {
    bytes_read += bytes;
    test::readFrom(file)(position, bytes, out);
  };
  LazPointReader reader(schema, read, {0, file.size(), 5000, kLazZ, 1}, "a.laz");
  ByteVector out(records.size());
  reader.read(0, 5000, out.data());
  // Random coordinates of 12 bytes, and what describes the returns, of 67 bytes.
  EXPECT_LT(bytes_read, file.size() / 2);
}

/// Threads that read the chunks of a file which is decoded with all cores.
std::size_t decodingThreads(const ByteVector& file, const LazSchema& schema, std::size_t count) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  const auto read = [&](std::uint64_t position, std::size_t bytes, void* out) {
    {
      const std::lock_guard<std::mutex> lock(mutex);
      threads.insert(std::this_thread::get_id());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    test::readFrom(file)(position, bytes, out);
  };
  LazPointReader reader(schema, read, {0, file.size(), count}, "a.laz");
  ByteVector out(count * schema.recordLength());
  reader.read(0, count, out.data());
  return threads.size();
}

TEST(LazCodecThreads, AreLimitedWithThoseOfTheProgram) {
  const LazSchema schema = schemaOf(6, 0, 5000);
  const ByteVector records = LazRecords(6, 0, PointKind::survey, 9).make(200000);
  const ByteVector file = test::encode(schema, records);
  limitThreads(1);
  EXPECT_EQ(decodingThreads(file, schema, 200000), 1U);
  limitThreads(3);
  const std::size_t threads = decodingThreads(file, schema, 200000);
  limitThreads(0);
  EXPECT_GT(threads, 1U);
}

/// An error of the output reaches the caller, whichever thread encodes meanwhile.
TEST(LazCodecThreads, AFailingOutputEndsTheEncoding) {
  const LazSchema schema = schemaOf(1, 0, 1000);
  const ByteVector records = LazRecords(1, 0, PointKind::survey, 10).make(100000);
  for (const int threads : {1, 4}) {
    std::uint64_t written = 0;
    LazPointWriter writer(
        schema,
        [&](std::uint64_t, std::size_t bytes, const void*) {
          if ((written += bytes) > 100000) throw InputError("the disk is full");
        },
        0, threads);
    EXPECT_THROW(
        {
          for (std::size_t i = 0; i < 100; ++i) writer.write(&records[28000 * i], 1000);
          writer.finish();
        },
        InputError);
  }
}

TEST(LazSchemaTest, SurvivesItsBytes) {
  for (int format = 0; format <= 10; ++format) {
    const LazSchema schema = schemaOf(format, 7, 1000);
    EXPECT_EQ(schema.recordLength(), test::kStandardLength[format] + 7);
    const ByteVector payload = schema.serialise();
    const LazSchema back = LazSchema::parse(payload.data(), payload.size(), "a.laz");
    EXPECT_EQ(back.serialise(), payload);
    EXPECT_EQ(back.chunk_size, 1000U);
    EXPECT_EQ(back.layered(), format >= 6);
  }
}

}  // namespace
}  // namespace pcl_als
