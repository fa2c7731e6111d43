// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "laz_file.h"
#include "laz_records.h"

namespace pcl_als {
namespace {

using test::ByteVector;

const LazSchema kPointwise = LazSchema::forFormat(1, 28, 100);
const LazSchema kLayered = LazSchema::forFormat(6, 30, 100);

ByteVector fileOf(const LazSchema& schema, std::size_t count) {
  const int format = schema.layered() ? 6 : 1;
  return test::encode(schema, test::LazRecords(format, 0, test::PointKind::survey, 1).make(count));
}

/// One line that names the file; anything but an InputError fails.
std::string messageOf(const LazSchema& schema, const ByteVector& file, std::size_t count) {
  try {
    LazPointReader reader(schema, test::readFrom(file), {0, file.size(), count}, "a.laz");
    ByteVector records(count * schema.recordLength());
    reader.read(0, count, records.data());
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("a.laz: "), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "";
}

void put64(ByteVector& file, std::size_t at, std::uint64_t value) {
  std::memcpy(&file[at], &value, sizeof value);
}

TEST(LazDamage, ABillionPointsInASmallFile) {
  for (const LazSchema& schema : {kPointwise, kLayered}) {
    const ByteVector file = fileOf(schema, 250);
    // The number follows from the chunk table, without decoding a chunk.
    EXPECT_NE(messageOf(schema, file, 1000000000).find("hold 300 of the 1000000000"),
              std::string::npos);
  }
}

TEST(LazDamage, ABillionPointsInOneChunk) {
  LazSchema schema = LazSchema::forFormat(1, 28, 2000000000);
  const ByteVector file = fileOf(schema, 250);
  EXPECT_NE(messageOf(schema, file, 1000000000).find("cannot hold 1000000000 points"),
            std::string::npos);
  schema.compressor = LazCompressor::pointwise;
  EXPECT_NE(messageOf(schema, fileOf(schema, 250), 1000000000).find("cannot hold"),
            std::string::npos);
}

TEST(LazDamage, TruncationIsNamedAtEveryLength) {
  for (const LazSchema& schema : {kPointwise, kLayered}) {
    const ByteVector whole = fileOf(schema, 250);
    std::uint64_t table = 0;
    std::memcpy(&table, whole.data(), sizeof table);
    for (std::size_t size = 0; size < table; size += 7) {
      const ByteVector cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      EXPECT_NE(messageOf(schema, cut, 250), "") << size;
    }
  }
}

TEST(LazDamage, AMissingTableIsNoDamage) {
  for (const LazSchema& schema : {kPointwise, kLayered}) {
    ByteVector file = fileOf(schema, 250);
    const ByteVector records = test::decode(schema, file, 250);
    std::uint64_t table = 0;
    std::memcpy(&table, file.data(), sizeof table);
    file.resize(table);  // as after an interruption: the pointer was never set
    put64(file, 0, 0);
    EXPECT_TRUE(test::decode(schema, file, 250) == records);
  }
}

TEST(LazDamage, ChunksOfVariableSizeNeedTheirTable) {
  LazSchema schema = kPointwise;
  schema.chunk_size = kLazVariableChunks;
  ByteVector file = fileOf(schema, 250);
  put64(file, 0, 3);
  EXPECT_NE(messageOf(schema, file, 250).find("chunk table is missing"), std::string::npos);
}

TEST(LazDamage, AShiftedChunkIsNamed) {
  const ByteVector whole = fileOf(kPointwise, 250);
  ByteVector file = whole;
  file.insert(file.begin() + 200, 3, 0);  // bytes in the first chunk
  std::uint64_t table = 0;
  std::memcpy(&table, whole.data(), sizeof table);
  put64(file, 0, table + 3);
  const std::string message = messageOf(kPointwise, file, 250);
  EXPECT_NE(message.find("chunk 1 (points 1 to 100)"), std::string::npos) << message;
}

/// Mutations of valid files: right records or an InputError, nothing else, and no read outside.
TEST(LazDamage, AnyChangedByteIsSurvived) {
  test::Numbers numbers(1);
  for (const LazSchema& schema : {kPointwise, kLayered}) {
    const ByteVector whole = fileOf(schema, 250);
    for (int round = 0; round < 2000; ++round) {
      ByteVector file = whole;
      for (unsigned i = 0; i <= numbers.below(3); ++i)
        file[numbers.below(static_cast<unsigned>(file.size()))] =
            static_cast<std::uint8_t>(numbers.next());
      messageOf(schema, file, 250);
    }
  }
}

/// The chunk size of the VLR asks for no memory: only the points that there are need some.
TEST(LazDamage, AChunkSizeWithoutSense) {
  for (const LazSchema& right : {kPointwise, kLayered}) {
    const ByteVector file = fileOf(right, 250);
    for (const std::uint32_t size :
         {1U, 2U, 99U, 101U, 249U, 250U, 0x7FFFFFFFU, 0x80000000U, 0xFFFFFFFEU}) {
      LazSchema schema = right;
      schema.chunk_size = size;
      EXPECT_NE(messageOf(schema, file, 250), "") << size;
    }
  }
}

TEST(LazDamage, NoByteHoldsMorePointsThanIsAssumed) {
  constexpr std::size_t count = 2000000;
  for (const int format : {0, 1, 6}) {
    const LazSchema schema = LazSchema::forFormat(format,
                                                  format == 0   ? 20
                                                  : format == 1 ? 28
                                                                : 30,
                                                  2 * count);
    const ByteVector records(count * schema.recordLength());
    const ByteVector file = test::encode(schema, records);
    EXPECT_LT(count / file.size(), 1250U);
    EXPECT_GT(count / file.size(), 400U);
    EXPECT_TRUE(test::decode(schema, file, count) == records);
  }
}

TEST(LazDamage, AHugeRecordInASmallFile) {
  const LazSchema schema = LazSchema::forFormat(6, 65535, 2000000000);
  const ByteVector file = test::encode(schema, ByteVector(65535 * 3));
  EXPECT_NE(messageOf(schema, file, 100000000).find("cannot hold 100000000 points"),
            std::string::npos);
}

/// The position behind the compressed points.
std::size_t tableOf(const ByteVector& file) {
  std::uint64_t table = 0;
  std::memcpy(&table, file.data(), sizeof table);
  return table;
}

/// The format has no checksum, but decoding that has lost its way does not end where it must.
TEST(LazDamage, NoiseInsideAChunkIsNoticed) {
  test::Numbers numbers(2);
  const auto noise = [&numbers](ByteVector& file, std::size_t from, std::size_t bytes) {
    for (std::size_t i = 0; i < bytes; ++i)
      file[from + i] = static_cast<std::uint8_t>(numbers.next());
  };
  for (const int format : {1, 6}) {
    LazSchema schema = LazSchema::forFormat(format, format == 1 ? 28 : 30, 4000);
    const ByteVector whole =
        test::encode(schema, test::LazRecords(format, 0, test::PointKind::survey, 1).make(10000));
    const std::size_t begin = 8, end = tableOf(whole);
    for (int round = 0; round < 100; ++round) {
      ByteVector file = whole;
      const auto room = static_cast<unsigned>(end - begin - 2000);
      noise(file, begin + numbers.below(room), 2000);
      EXPECT_NE(messageOf(schema, file, 10000), "") << format << ' ' << round;
    }
    // The last chunk, which has fewer points than the others, is checked like them.
    ByteVector file = whole;
    noise(file, end - 500, 100);
    const std::string message = messageOf(schema, file, 10000);
    EXPECT_NE(message.find("chunk 3 (points 8001 to 10000)"), std::string::npos) << message;
  }
}

/// A file without chunks or without a chunk table ends like others.
TEST(LazDamage, NoiseIsNoticedWithoutAChunkTable) {
  test::Numbers numbers(3);
  LazSchema schema = LazSchema::forFormat(1, 28, 4000);
  ByteVector whole =
      test::encode(schema, test::LazRecords(1, 0, test::PointKind::survey, 1).make(4000));
  whole.resize(tableOf(whole));
  put64(whole, 0, 0);
  int noticed = 0;
  for (int round = 0; round < 100; ++round) {
    ByteVector file = whole;
    for (unsigned i = 0; i < 100; ++i)
      file[1000 + 5 * static_cast<std::size_t>(round) + i] =
          static_cast<std::uint8_t>(numbers.next());
    if (!messageOf(schema, file, 4000).empty()) ++noticed;
  }
  EXPECT_GE(noticed, 90);
}

TEST(LazDamage, AHeaderWithTooFewPointsIsNoDamageOfOtherChunks) {
  for (const LazSchema& schema : {kPointwise, kLayered}) {
    const ByteVector file = fileOf(schema, 250), all = test::decode(schema, file, 250);
    // Within the second of three chunks; at the end of the second; nothing at all.
    for (const std::size_t count : {150U, 200U, 0U}) {
      const ByteVector part = test::decode(schema, file, count);
      EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin())) << count;
    }
    EXPECT_NE(messageOf(schema, file, 249).find("or the header announces too few"),
              std::string::npos);
  }
}

struct BadRecord {
  const char* message;
  std::size_t at;
  std::uint16_t value;
};

TEST(LazDamage, TheRecordIsChecked) {
  const BadRecord records[] = {{"compressor 0", 0, 0},
                               {"compressor 4", 0, 4},
                               {"entropy coder", 2, 1},
                               {"the items that it announces", 32, 9},
                               {"the items that it announces", 32, 0},
                               {"item of type 5, which is unknown", 34, 5},
                               {"which its compressor lacks", 34, 10},
                               {"of 21 bytes", 36, 21},
                               {"of version 3", 38, 3},
                               {"does not begin with", 34, 7}};
  for (const BadRecord& bad : records) {
    ByteVector payload = LazSchema::forFormat(1, 28).serialise();
    std::memcpy(&payload[bad.at], &bad.value, 2);
    if (bad.value == 7) payload[36] = 8;
    try {
      LazSchema::parse(payload.data(), payload.size(), "a.laz");
      FAIL() << bad.message;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(bad.message), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(LazSchema::parse(nullptr, 0, "a.laz"), InputError);
}

}  // namespace
}  // namespace pcl_als
