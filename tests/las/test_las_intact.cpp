// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/las_selection.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;
namespace fs = std::filesystem;

constexpr unsigned kPoints = 230000;  // five chunks of 50,000, the last one of 30,000

/// A compressed file with an extended VLR, and what it was made of.
struct Packed {
  LasBytes las;
  fs::path folder;
  std::string bytes;
};

const Packed& packed(int format) {
  static std::map<int, Packed> known;
  const auto [at, made] = known.try_emplace(format);
  Packed& file = at->second;
  if (!made) return file;
  file.las.format = format;
  file.las.count = kPoints;
  file.las.evlrs = {LasBytes::evlr("someone", 2, std::string(3000, 'w'))};
  file.folder = test::scratch("las_intact_" + std::to_string(format));
  test::writeBytes(file.folder / "in.las", file.las.str());
  rewriteLas(file.folder / "in.las", file.folder / "in.laz", [](const LasRecordBlock&) {});
  file.bytes = test::readBytes(file.folder / "in.laz");
  return file;
}

LasFile opened(const fs::path& path) {
  return LasFile(path, kLazAllFields, LasDamage::keep_intact);
}

/// Every record that is given as intact is that of the undamaged file.
void expectRecords(const LasFile& file, const LasBytes& las) {
  const std::size_t length = file.header().record_length;
  for (const LasRecordRange& range : file.intact().records) {
    std::vector<std::byte> records(range.count * length);
    file.readRanges({range}, records.data());
    for (const std::uint64_t i : {std::uint64_t{0}, range.count / 2, range.count - 1})
      EXPECT_EQ(std::string(reinterpret_cast<const char*>(&records[i * length]), length),
                las.record(static_cast<unsigned>(range.first + i)));
  }
}

class LasIntactFormats : public testing::TestWithParam<int> {};  // pointwise and layered chunks

TEST_P(LasIntactFormats, AnUndamagedFileIsComplete) {
  const Packed& file = packed(GetParam());
  const LasFile whole = opened(file.folder / "in.laz");
  EXPECT_TRUE(whole.intact().complete());
  EXPECT_FALSE(whole.isTruncated());
  EXPECT_EQ(whole.intact().chunks, 5U);
  EXPECT_EQ(whole.intact().chunk_count, 5U);
  EXPECT_EQ(whole.intact().record_count, kPoints);
  EXPECT_THROW(LasFile(file.folder / "in.laz").intact(), UsageError);
}

TEST_P(LasIntactFormats, ATruncatedFileKeepsItsWholeChunks) {
  const Packed& file = packed(GetParam());
  const fs::path path = file.folder / "cut.laz";
  test::writeBytes(path, file.bytes.substr(0, file.bytes.size() * 7 / 10));
  EXPECT_THROW(LasFile{path}, InputError);
  const LasFile cut = opened(path);
  const LasIntact& intact = cut.intact();
  EXPECT_EQ(intact.chunk_count, 0U);  // the table was at the end
  EXPECT_EQ(intact.chunks, 3U);
  EXPECT_EQ(intact.record_count, 150000U);
  EXPECT_EQ(intact.lost_evlrs, 1U);
  EXPECT_EQ(intact.describe(),
            "without a chunk table, 3 chunks can be decoded, with 150 000 of 230 000 points; 1 "
            "extended VLR lost");
  expectRecords(cut, file.las);
}

TEST_P(LasIntactFormats, DamagedChunksAreExcluded) {
  const Packed& file = packed(GetParam());
  const fs::path path = file.folder / "holes.laz";
  std::string bytes = file.bytes;
  // In the second chunk; the third and the fifth are as they were.
  const std::size_t points = bytes.size() - 3000 - 300;
  for (std::size_t i = 0; i < 400; ++i) bytes[points * 3 / 10 + i] = static_cast<char>(0xFF);
  test::writeBytes(path, bytes);
  const LasFile holes = opened(path);
  const LasIntact& intact = holes.intact();
  EXPECT_EQ(intact.chunk_count, 5U);
  EXPECT_EQ(intact.chunks, 4U);
  EXPECT_EQ(intact.record_count, kPoints - 50000U);
  EXPECT_EQ(intact.records.at(1).first, 100000U);
  EXPECT_EQ(intact.lost_evlrs, 0U);
  expectRecords(holes, file.las);
}

TEST_P(LasIntactFormats, ASelectionOfThemIsAValidFile) {
  const Packed& file = packed(GetParam());
  test::writeBytes(file.folder / "cut.laz", file.bytes.substr(0, file.bytes.size() / 2));
  const LasFile cut = opened(file.folder / "cut.laz");
  LasSelectionWriter writer(file.folder / "saved.las", cut);
  for (const LasRecordRange& range : cut.intact().records) {
    std::vector<std::byte> records(range.count * cut.header().record_length);
    cut.readRanges({range}, records.data());
    writer.append(records.data(), range.count);
  }
  writer.finish();
  const LasFile saved(file.folder / "saved.las");
  EXPECT_EQ(saved.header().point_count, 100000U);
  EXPECT_EQ(saved.header().evlr_count, 0U);
  EXPECT_EQ(saved.header().evlr_start, 0U);
  EXPECT_EQ(saved.header().maximum.x(), LasBytes::X(99999) * 0.001 + file.las.offset_x);
  EXPECT_EQ(saved.fileSize(), saved.header().offset_to_points +
                                  saved.header().point_count * saved.header().record_length);
}

INSTANTIATE_TEST_SUITE_P(Coders, LasIntactFormats, testing::Values(1, 6));

TEST(LasIntact, ATruncatedPlainFileKeepsItsWholeRecords) {
  const auto folder = test::scratch("las_intact_plain");
  LasBytes las;
  las.count = 1000;
  las.evlrs = {LasBytes::evlr("someone", 2, "payload")};
  test::writeBytes(folder / "cut.las",
                   las.str().substr(0, las.offsetToPoints() + 400 * las.record(0).size() + 7));
  EXPECT_THROW(LasFile(folder / "cut.las"), InputError);
  const LasFile cut = opened(folder / "cut.las");
  EXPECT_EQ(cut.intact().record_count, 400U);
  EXPECT_EQ(cut.intact().describe(), "400 of 1 000 points; 1 extended VLR lost");
  expectRecords(cut, las);
  LasSelectionWriter writer(folder / "saved.las", cut);
  writer.finish();
  const LasFile saved(folder / "saved.las");
  EXPECT_EQ(saved.fileSize(), saved.header().offset_to_points);  // no part of a record
}

TEST(LasIntact, NothingMayBeLeft) {
  const Packed& file = packed(6);
  const fs::path path = file.folder / "none.laz";
  test::writeBytes(path, file.bytes.substr(0, 2000));
  EXPECT_EQ(opened(path).intact().record_count, 0U);
  // The header itself is needed.
  test::writeBytes(path, file.bytes.substr(0, 200));
  EXPECT_THROW(opened(path), InputError);
}

}  // namespace
}  // namespace pcl_als
