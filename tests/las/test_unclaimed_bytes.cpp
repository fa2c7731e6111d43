// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/unclaimed_bytes.h>

#include "las_bytes.h"
#include "las_edits.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::kNothing;
using test::LasBytes;

constexpr std::size_t kLegacyCountAt = 107, kCountAt = 247;

UnclaimedBytes of(const std::string& name, const std::string& bytes) {
  const fs::path path = test::scratch("unclaimed_bytes") / name;
  test::writeBytes(path, bytes);
  return unclaimedBytes(LasFile(path));
}

/// A file whose header counts fewer points than it holds.
std::string withCount(const LasBytes& las, std::uint32_t count) {
  std::string bytes = las.str();
  const bool legacy = las.minor < 4 || las.format < 6;
  if (legacy) std::memcpy(&bytes[kLegacyCountAt], &count, sizeof count);
  if (las.minor >= 4) std::memcpy(&bytes[kCountAt], &count, sizeof count);
  return bytes;
}

TEST(UnclaimedBytes, AreNoneInAnOrdinaryFile) {
  LasBytes las;
  las.evlrs = {LasBytes::evlr("a", 1, "payload"), LasBytes::evlr("b", 2, "")};
  EXPECT_FALSE(of("in.las", las.str()).any());
  EXPECT_EQ(of("in.las", las.str()).describe(), "");
}

TEST(UnclaimedBytes, OfPointsThatAreNotCountedAreRecords) {
  for (const int minor : {2, 3, 4}) {
    LasBytes las;
    las.minor = minor, las.format = 1;
    const UnclaimedBytes found = of("in.las", withCount(las, 3));
    EXPECT_EQ(found.bytes, 56U);
    EXPECT_EQ(found.records, 2U);
    EXPECT_EQ(found.describe(),
              "56 bytes behind the points belong to no record; they have the size of 2 further "
              "points of 28 bytes, which the header does not count");
  }
}

TEST(UnclaimedBytes, BetweenAndBehindExtendedRecordsCount) {
  LasBytes las;
  las.evlrs = {LasBytes::evlr("a", 1, "payload")};
  las.after = "seven b";
  // One point more than the header counts lies before the extended records.
  const UnclaimedBytes found = of("in.las", withCount(las, 4));
  EXPECT_EQ(found.bytes, 30U + 7U);
  EXPECT_EQ(found.records, 1U);
}

TEST(UnclaimedBytes, OfNoWholeRecordsAreSaidToBeBytes) {
  LasBytes las;
  las.after = "seven b";
  EXPECT_EQ(of("in.las", las.str()).records, 0U);
  EXPECT_EQ(of("in.las", las.str()).describe(), "7 bytes behind the points belong to no record");
}

TEST(UnclaimedBytes, AreNotTheWaveformsOfTheHeader) {
  LasBytes las;
  las.minor = 3, las.format = 4;
  std::string bytes = las.str();
  const std::uint64_t start = bytes.size();
  std::memcpy(&bytes[227], &start, sizeof start);
  bytes += LasBytes::evlr("LASF_Spec", 65535, std::string(100, 'p'));
  EXPECT_FALSE(of("in.las", bytes).any());
  EXPECT_EQ(of("in.las", bytes + "abc").bytes, 3U);
}

// Behind compressed points they were lost where the header refers to nothing behind the points.
TEST(UnclaimedBytes, SurviveCompression) {
  for (const int minor : {2, 4}) {
    const fs::path folder = test::scratch("unclaimed_compression");
    LasBytes las;
    las.minor = minor, las.format = minor == 2 ? 1 : 6, las.count = 120000;
    las.after = "bytes behind the end";
    test::writeBytes(folder / "in.las", las.str());
    const LasRewriteResult there = rewriteLas(folder / "in.las", folder / "in.laz", kNothing);
    ASSERT_EQ(there.remarks.size(), 1U);
    EXPECT_EQ(there.remarks[0],
              "20 bytes behind the points belong to no record; they are "
              "copied as they are");
    EXPECT_EQ(unclaimedBytes(LasFile(folder / "in.laz")).bytes, 20U);
    rewriteLas(folder / "in.laz", folder / "out.las", kNothing);
    EXPECT_EQ(test::readBytes(folder / "out.las"), las.str());
  }
}

TEST(UnclaimedBytes, CompressedPointsThatAreNotCountedAreNamed) {
  const fs::path folder = test::scratch("unclaimed_points");
  LasBytes las;
  las.count = 120000;
  test::writeBytes(folder / "in.las", las.str());
  rewriteLas(folder / "in.las", folder / "all.laz", kNothing);
  std::string bytes = test::readBytes(folder / "all.laz");
  const std::uint64_t count = 50000;
  std::memcpy(&bytes[kCountAt], &count, sizeof count);
  test::writeBytes(folder / "few.laz", bytes);
  EXPECT_GT(unclaimedBytes(LasFile(folder / "few.laz")).surplus_points, 0U);
  EXPECT_FALSE(unclaimedBytes(LasFile(folder / "all.laz")).any());
  const LasRewriteResult result = rewriteLas(folder / "few.laz", folder / "out.las", kNothing);
  EXPECT_EQ(result.points, count);
  ASSERT_EQ(result.remarks.size(), 2U);  // the box in the header is that of all points
  EXPECT_NE(result.remarks[1].find("they are not copied"), std::string::npos) << result.remarks[1];
}

TEST(UnclaimedBytes, OfAFileWithoutPointsAreKept) {
  const fs::path folder = test::scratch("unclaimed_no_points");
  LasBytes las;
  las.count = 0, las.minor = 2, las.format = 1;
  las.after = "seven b";
  test::writeBytes(folder / "in.las", las.str());
  rewriteLas(folder / "in.las", folder / "in.laz", kNothing);
  EXPECT_EQ(unclaimedBytes(LasFile(folder / "in.laz")).bytes, 7U);
  rewriteLas(folder / "in.laz", folder / "out.las", kNothing);
  EXPECT_EQ(test::readBytes(folder / "out.las"), las.str());
}

// Files that LASzip wrote end with their chunk tables.
TEST(UnclaimedBytes, AreNoneInFilesOfLaszip) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(PCL_ALS_LAZ_FILES)) {
    if (entry.path().extension() != ".laz") continue;
    const UnclaimedBytes found = unclaimedBytes(LasFile(entry.path()));
    EXPECT_EQ(found.describe(), "") << entry.path();
    ++files;
  }
  EXPECT_GT(files, 10);
}

}  // namespace
}  // namespace pcl_als
