// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/las/las_compatibility.h>
#include <pcl_als/las/las_record.h>

#include "laz_file.h"
#include "laz_records.h"

// The files in data/ were compressed by LASzip (commit ac3e9e9) from the records that LazRecords
// makes with the seed 1000 format + 100 version + kind.
namespace pcl_als {
namespace {

using test::LazFile;
using test::PointKind;

struct Reference {
  const char* name;
  int format;
  std::size_t extra;
  PointKind kind;
  std::size_t count;
  int version;
};

std::vector<test::ByteVector::value_type> expected(const Reference& r) {
  const auto seed = static_cast<std::uint64_t>(r.format * 1000 + r.version * 100) +
                    static_cast<std::uint64_t>(r.kind);
  return test::LazRecords(r.format, r.extra, r.kind, seed).make(r.count);
}

LazFile open(const Reference& r) {
  return LazFile(std::string(PCL_ALS_LAZ_FILES) + "/" + r.name + ".laz");
}

const Reference kReferences[] = {
    {"format0_v1", 0, 2, PointKind::survey, 250, 1},
    {"format0_v2", 0, 2, PointKind::survey, 250, 2},
    {"format1_v1", 1, 0, PointKind::survey, 250, 1},
    {"format1_v2", 1, 0, PointKind::survey, 250, 2},
    {"format2_v1", 2, 2, PointKind::survey, 250, 1},
    {"format2_v2", 2, 2, PointKind::survey, 250, 2},
    {"format3_v1", 3, 0, PointKind::survey, 250, 1},
    {"format3_v2", 3, 0, PointKind::survey, 250, 2},
    {"format4_v1", 4, 2, PointKind::survey, 250, 1},
    {"format4_v2", 4, 2, PointKind::survey, 250, 2},
    {"format5_v1", 5, 0, PointKind::survey, 250, 1},
    {"format5_v2", 5, 0, PointKind::survey, 250, 2},
    {"format6_v3", 6, 0, PointKind::channels, 250, 3},
    {"format6_v4", 6, 0, PointKind::channels, 250, 4},
    {"format7_v3", 7, 3, PointKind::channels, 250, 3},
    {"format7_v4", 7, 3, PointKind::channels, 250, 4},
    {"format8_v3", 8, 0, PointKind::channels, 250, 3},
    {"format8_v4", 8, 0, PointKind::channels, 250, 4},
    {"format9_v3", 9, 3, PointKind::channels, 250, 3},
    {"format9_v4", 9, 3, PointKind::channels, 250, 4},
    {"format10_v3", 10, 0, PointKind::channels, 250, 3},
    {"format10_v4", 10, 0, PointKind::channels, 250, 4},
    {"random3", 3, 1, PointKind::random, 100, 2},
    {"random10", 10, 1, PointKind::random, 100, 3},
    {"unchunked1", 1, 0, PointKind::survey, 250, 1},
    {"unchunked3", 3, 2, PointKind::survey, 250, 2},
    {"single1", 1, 0, PointKind::survey, 15, 2},
    {"single7", 7, 1, PointKind::survey, 15, 3},
    {"variable3", 3, 0, PointKind::survey, 250, 2},
    {"variable6", 6, 0, PointKind::survey, 250, 3},
    {"constant1", 1, 2, PointKind::constant, 120, 2},
    {"constant9", 9, 2, PointKind::constant, 120, 3},
    {"streamed1", 1, 0, PointKind::survey, 150, 2},
    {"streamed6", 6, 0, PointKind::survey, 150, 3},
    {"tableless1", 1, 0, PointKind::survey, 250, 2},
    {"tableless6", 6, 0, PointKind::survey, 250, 3},
};

/// Files that LASzip wrote in LAS 1.4 compatibility mode from records of formats 6 and 8.
TEST(LazCompatibility, ColumnsHaveTheValuesOfLas14) {
  for (const int format : {6, 8}) {
    const LasFile file(std::string(PCL_ALS_LAZ_FILES) + "/compatible" + std::to_string(format) +
                       ".laz");
    EXPECT_EQ(file.header().point_format, format == 6 ? 1 : 3);
    const auto compatibility = LasCompatibility::of(file);
    ASSERT_TRUE(compatibility.has_value());
    const auto columns = [](const void* records, std::size_t length, int of_format) {
      PointChunk chunk;
      decodeLasRecords(static_cast<const std::byte*>(records), 250, length,
                       LasRecordLayout::of(of_format), Eigen::Vector3d::Ones(),
                       Eigen::Vector3d::Zero(), chunk);
      return chunk;
    };
    const std::size_t length = file.header().record_length;
    std::vector<std::byte> stored(250 * length);
    file.readRecords(0, 250, stored.data());
    PointChunk read = columns(stored.data(), length, file.header().point_format);
    compatibility->restore(stored.data(), length, read);
    test::LazRecords records(format, 0, PointKind::channels, 1000U * static_cast<unsigned>(format));
    const PointChunk right = columns(records.make(250).data(), records.length(), format);
    EXPECT_EQ(read.return_number, right.return_number);
    EXPECT_EQ(read.number_of_returns, right.number_of_returns);
    EXPECT_EQ(read.classification, right.classification);
    EXPECT_EQ(read.flags, right.flags);
    EXPECT_EQ(read.scan_angle, right.scan_angle);
    EXPECT_EQ(read.x, right.x);
    EXPECT_EQ(read.gps_time, right.gps_time);
  }
  EXPECT_FALSE(LasCompatibility::of(LasFile(std::string(PCL_ALS_LAZ_FILES) + "/format1_v2.laz")));
}

class LazReference : public testing::TestWithParam<Reference> {};

TEST_P(LazReference, IsDecodedBitForBit) {
  const LazFile file = open(GetParam());
  EXPECT_EQ(file.schema.recordLength(),
            test::kStandardLength[GetParam().format] + GetParam().extra);
  const auto records = expected(GetParam());
  EXPECT_TRUE(file.decode(1) == records);
  EXPECT_TRUE(file.decode(3) == records);
}

TEST_P(LazReference, IsEncodedToTheSameBytes) {
  const LazFile file = open(GetParam());
  const std::string name = GetParam().name;
  if (name.find("streamed") == 0 || name.find("tableless") == 0)
    GTEST_SKIP() << "written in an order that this writer does not have";
  std::vector<std::size_t> ends;  // as the file was made
  if (file.schema.variableChunks())
    for (std::size_t end = 7; end < GetParam().count; end = 2 * end + 3) ends.push_back(end);
  const auto ours = test::encode(file.schema, expected(GetParam()), 2, ends);
  // Only the position of the chunk table depends on the place of the points.
  const std::size_t skipped = file.schema.chunked() ? 8 : 0;
  const test::ByteVector theirs(
      file.bytes.begin() + static_cast<std::ptrdiff_t>(file.points.offset_to_points + skipped),
      file.bytes.end());
  EXPECT_TRUE(test::ByteVector(ours.begin() + static_cast<std::ptrdiff_t>(skipped), ours.end()) ==
              theirs);
}

INSTANTIATE_TEST_SUITE_P(Files, LazReference, testing::ValuesIn(kReferences),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace pcl_als
