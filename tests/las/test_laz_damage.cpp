// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <chrono>

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
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_NE(messageOf(schema, file, 1000000000).find("hold 300 of the 1000000000"),
              std::string::npos);
    // The chunk table says so: nothing is decoded. Seconds for a machine under load.
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
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
