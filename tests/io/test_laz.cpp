// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/las_writer.h>

#include "las_bytes.h"
#include "real_data.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;

const LasEdit kNothing = [](const LasRecordBlock&) {};

std::vector<std::byte> recordsOf(const LasFile& file) {
  std::vector<std::byte> records(file.header().point_count * file.header().record_length);
  file.readRecords(0, file.header().point_count, records.data());
  return records;
}

class LazMatrix : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(LazMatrix, ThereAndBackKeepsEveryByte) {
  const auto folder = test::scratch("laz_matrix");
  LasBytes las;
  std::tie(las.minor, las.format) = GetParam();
  las.count = 120000;  // more than two chunks of 50000
  las.extra = 4;
  las.vlrs = {LasBytes::vlr("someone", 1, "payload")};
  las.between = "bytes between";
  if (las.minor == 4) las.evlrs = {LasBytes::evlr("someone", 2, std::string(3000, 'w'))};
  test::writeBytes(folder / "in.las", las.str());
  rewriteLas(folder / "in.las", folder / "packed.laz", kNothing);
  EXPECT_LT(std::filesystem::file_size(folder / "packed.laz"), las.str().size() / 2);
  rewriteLas(folder / "packed.laz", folder / "again.laz", kNothing);
  rewriteLas(folder / "again.laz", folder / "out.las", kNothing);
  EXPECT_TRUE(test::readBytes(folder / "out.las") == las.str());
  EXPECT_TRUE(test::readBytes(folder / "again.laz") == test::readBytes(folder / "packed.laz"));
}

std::vector<std::pair<int, int>> specifiedFormats() {
  std::vector<std::pair<int, int>> formats;
  for (int format = 0; format <= 3; ++format) formats.emplace_back(2, format);
  for (int format = 0; format <= 5; ++format) formats.emplace_back(3, format);
  for (int format = 0; format <= 10; ++format) formats.emplace_back(4, format);
  return formats;
}
INSTANTIATE_TEST_SUITE_P(SpecifiedFormats, LazMatrix, testing::ValuesIn(specifiedFormats()));

TEST(Laz, SeeksBackAndForth) {
  const auto folder = test::scratch("laz_seek");
  LasBytes las;
  las.count = 120000;
  test::writeBytes(folder / "in.las", las.str());
  rewriteLas(folder / "in.las", folder / "packed.laz", kNothing);
  const LasFile file(folder / "packed.laz");
  std::vector<std::byte> record(30);
  for (const unsigned i : {110000U, 5U, 60000U, 60001U}) {
    file.readRecords(i, 1, record.data());
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(record.data()), 30), las.record(i));
  }
}

TEST(Laz, WriterMakesWhatReaderReads) {
  const auto folder = test::scratch("laz_writer");
  LasBytes las;
  test::writeBytes(folder / "in.las", las.str());
  const auto reader = PointReader::open(folder / "in.las");
  PointChunk chunk, back;
  reader->read(chunk);
  LasWriterOptions options;
  options.offset = {las.offset_x, las.offset_y, las.offset_z};
  LasWriter writer(folder / "out.laz", options);
  writer.append(chunk);
  writer.finish();
  const auto again = PointReader::open(folder / "out.laz");
  EXPECT_EQ(again->info().format, "LAZ 1.4, point format 6");
  EXPECT_EQ(again->info().maximum, reader->info().maximum);
  ASSERT_TRUE(again->read(back));
  EXPECT_EQ(back.x, chunk.x);
  EXPECT_EQ(back.gps_time, chunk.gps_time);
  EXPECT_EQ(back.flags, chunk.flags);
}

TEST(Laz, ATruncatedFileIsAnInputError) {
  const auto folder = test::scratch("laz_cut");
  LasBytes las;
  las.count = 120000;
  test::writeBytes(folder / "in.las", las.str());
  rewriteLas(folder / "in.las", folder / "packed.laz", kNothing);
  std::filesystem::resize_file(folder / "packed.laz",
                               std::filesystem::file_size(folder / "packed.laz") / 2);
  EXPECT_THROW(recordsOf(LasFile(folder / "packed.laz")), InputError);
}

class LazReal : public testing::TestWithParam<const char*> {};

TEST_P(LazReal, FileEqualsItsDecodedCopy) {
  const std::string name = GetParam();
  const auto packed = test::testData(name + ".laz");
  const auto plain = test::unpacked(name + ".las.xz");
  PCL_ALS_REQUIRE_DATA(packed);
  PCL_ALS_REQUIRE_DATA(plain);
  EXPECT_TRUE(recordsOf(LasFile(*packed)) == recordsOf(LasFile(*plain)));
  const auto folder = test::scratch("laz_real");
  rewriteLas(*plain, folder / "packed.laz", kNothing);
  rewriteLas(folder / "packed.laz", folder / "again.las", kNothing);
  EXPECT_TRUE(test::readBytes(folder / "again.las") == test::readBytes(*plain));
  // LASzip wrote the file: compression within 1 % of its.
  EXPECT_LT(static_cast<double>(std::filesystem::file_size(folder / "packed.laz")),
            1.01 * static_cast<double>(std::filesystem::file_size(*packed)));
}

INSTANTIATE_TEST_SUITE_P(Files, LazReal,
                         testing::Values("delft_ahn3/ahn3_cropped_1", "delft_ahn3/ahn3_cropped_2",
                                         "real/stbarth/stbarth", "real/titan/scan_cycle",
                                         "real/bcts/bcts_1", "real/bcts/bcts_2", "real/bcts/bcts_3",
                                         "real/bcts/bcts_4", "real/uav/truck", "real/feet/us_feet",
                                         "real/wires/wires"));

}  // namespace
}  // namespace pcl_als
