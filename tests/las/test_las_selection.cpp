// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/las_selection.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;

/// Writes the records [first, first + count) of a file.
void select(const LasFile& file, const std::filesystem::path& output, std::uint64_t first,
            std::size_t count) {
  std::vector<std::byte> records(count * file.header().record_length);
  file.readRecords(first, count, records.data());
  LasSelectionWriter writer(output, file, 2);
  writer.append(records.data(), count);
  EXPECT_EQ(writer.pointCount(), count);
  writer.finish();
}

class LasSelectionMatrix : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(LasSelectionMatrix, AllPointsGiveTheSameBytes) {
  const auto folder = test::scratch("las_selection_all");
  const std::string bytes =
      test::fullFile(std::get<0>(GetParam()), std::get<1>(GetParam()), 300).str();
  test::writeBytes(folder / "in.las", bytes);
  select(LasFile(folder / "in.las"), folder / "out.las", 0, 300);
  EXPECT_EQ(test::readBytes(folder / "out.las"), bytes);
}

TEST_P(LasSelectionMatrix, APartHasItsOwnCountsAndBox) {
  const auto folder = test::scratch("las_selection_part");
  const LasBytes las = test::fullFile(std::get<0>(GetParam()), std::get<1>(GetParam()), 300);
  test::writeBytes(folder / "in.las", las.str());
  const LasFile in(folder / "in.las");
  select(in, folder / "out.laz", 100, 31);
  const LasFile out(folder / "out.laz");
  const LasHeader& h = out.header();
  EXPECT_EQ(h.point_count, 31U);
  // Return numbers are 1, 2, 3 in turn; record 100 has the second.
  EXPECT_EQ(h.points_by_return[0], 10U);
  EXPECT_EQ(h.points_by_return[1], 11U);
  EXPECT_EQ(h.points_by_return[2], 10U);
  EXPECT_EQ(h.minimum.x(), LasBytes::X(100) * las.scale + las.offset_x);
  EXPECT_EQ(h.maximum.x(), LasBytes::X(130) * las.scale + las.offset_x);
  EXPECT_EQ(h.minimum.y(), LasBytes::Y(130) * las.scale + las.offset_y);
  EXPECT_EQ(h.evlr_count, in.header().evlr_count);
  std::vector<std::byte> record(h.record_length);
  out.readRecords(30, 1, record.data());
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(record.data()), record.size()),
            las.record(130));
}

INSTANTIATE_TEST_SUITE_P(VersionsAndFormats, LasSelectionMatrix,
                         testing::Values(std::tuple(2, 0), std::tuple(2, 3), std::tuple(3, 5),
                                         std::tuple(4, 1), std::tuple(4, 6), std::tuple(4, 10),
                                         std::tuple(5, 6), std::tuple(5, 10)));

TEST(LasSelection, NoPointsGiveAnEmptyBox) {
  const auto folder = test::scratch("las_selection_none");
  test::writeBytes(folder / "in.las", LasBytes().str());
  select(LasFile(folder / "in.las"), folder / "out.las", 0, 0);
  const LasFile out(folder / "out.las");
  EXPECT_EQ(out.header().point_count, 0U);
  EXPECT_EQ(out.header().maximum, Eigen::Vector3d::Zero());
}

TEST(LasSelection, RefusesItsOwnInputAsOutput) {
  const auto folder = test::scratch("las_selection_same");
  test::writeBytes(folder / "in.las", LasBytes().str());
  const LasFile in(folder / "in.las");
  EXPECT_THROW(LasSelectionWriter(folder / "in.las", in), UsageError);
  EXPECT_EQ(test::readBytes(folder / "in.las"), LasBytes().str());
}

TEST(LasSelection, RecordsMoveToAnotherOffset) {
  const auto folder = test::scratch("las_selection_offset");
  LasBytes las;
  test::writeBytes(folder / "a.las", las.str());
  las.offset_x += 1000.0;
  las.offset_z -= 7.25;
  test::writeBytes(folder / "b.las", las.str());
  const auto steps = stepsBetween(LasFile(folder / "b.las"), LasFile(folder / "a.las"));
  EXPECT_EQ(steps, (std::array<std::int64_t, 3>{1000000, 0, -7250}));
  std::string record = las.record(3);
  auto* bytes = reinterpret_cast<std::byte*>(record.data());
  moveRecords(steps, bytes, 1, record.size(), "b.las");
  EXPECT_EQ(loadLas<std::int32_t>(bytes), LasBytes::X(3) + 1000000);
  EXPECT_EQ(loadLas<std::int32_t>(bytes + 8), LasBytes::Z(3) - 7250);
  EXPECT_THROW(moveRecords({std::int64_t{1} << 32, 0, 0}, bytes, 1, record.size(), "b.las"),
               InputError);
}

TEST(LasSelection, RecordsThatDoNotFitAreRefusedByName) {
  const auto folder = test::scratch("las_selection_refused");
  test::writeBytes(folder / "a.las", LasBytes().str());
  const LasFile a(folder / "a.las");
  const auto refused = [&](const LasBytes& other, const std::string& what) {
    test::writeBytes(folder / "b.las", other.str());
    try {
      stepsBetween(LasFile(folder / "b.las"), a);
      ADD_FAILURE() << what << " is not refused";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  LasBytes other;
  other.format = 7;
  refused(other, "point format");
  other = LasBytes();
  other.extra = 2;
  refused(other, "record length");
  other = LasBytes();
  other.scale = 0.01;
  refused(other, "scale");
  other = LasBytes();
  other.offset_y += 0.0004;
  refused(other, "offset");
  other = LasBytes();
  other.encoding = 0;
  refused(other, "GPS time");
}

TEST(LasSelection, AppendsFieldsToItsRecords) {
  const auto folder = test::scratch("las_selection_fields");
  const LasBytes las = test::fullFile(4, 6, 20);
  test::writeBytes(folder / "in.las", las.str());
  const LasFile in(folder / "in.las");
  LasExtraField field;
  field.name = "added";
  field.type = LasExtraType::u16;
  const std::vector<LasExtraField> placed = placeExtension(in, {field});
  const std::size_t length = in.header().record_length;
  ASSERT_EQ(placed[0].position, length);
  LasSelectionWriter writer(folder / "out.laz", in, {field});
  // More records than the file has.
  for (unsigned i = 0; i < 50; ++i) {
    std::vector<std::byte> record(length + 2);
    in.readRecords(i % 20, 1, record.data());
    storeLas(&record[length], static_cast<std::uint16_t>(7 * i));
    writer.append(record.data(), 1);
  }
  writer.finish();
  const LasFile out(folder / "out.laz");
  EXPECT_EQ(out.header().point_count, 50U);
  EXPECT_EQ(out.header().record_length, length + 2);
  EXPECT_EQ(out.extraFields().back().name, "added");
  EXPECT_EQ(out.header().evlr_count, in.header().evlr_count);
  std::vector<std::byte> record(length + 2);
  out.readRecords(33, 1, record.data());
  EXPECT_EQ(std::string(reinterpret_cast<const char*>(record.data()), length), las.record(13));
  EXPECT_EQ(loadLas<std::uint16_t>(&record[length]), 231);
}

}  // namespace
}  // namespace pcl_als
