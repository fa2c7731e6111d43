// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_rewriter.h>

#include "las_bytes.h"
#include "las_edits.h"
#include "real_data.h"
#include "test_files.h"
#include "wrong_boxes.h"

namespace pcl_als {
namespace {

using test::LasBytes;

using test::kNothing;

void addToX(const LasRecordBlock& block, int units) {
  for (std::size_t i = 0; i < block.count; ++i) {
    std::byte* x = block.records + i * block.record_length;
    storeLas(x, loadLas<std::int32_t>(x) + units);
  }
}

class LasRewriterMatrix : public testing::TestWithParam<std::tuple<int, int>> {};

TEST_P(LasRewriterMatrix, CopiesEveryByte) {
  const auto folder = test::scratch("las_rewriter_matrix");
  const std::string bytes =
      test::fullFile(std::get<0>(GetParam()), std::get<1>(GetParam()), 1000).str();
  test::writeBytes(folder / "in.las", bytes);
  const LasRewriteResult result = rewriteLas(folder / "in.las", folder / "out.las", kNothing, 2);
  EXPECT_EQ(result.points, 1000U);
  EXPECT_FALSE(result.box_changed);
  EXPECT_EQ(test::readBytes(folder / "out.las"), bytes);
}

TEST_P(LasRewriterMatrix, ChangesOnlyWhatTheEditChanges) {
  const auto folder = test::scratch("las_rewriter_edit");
  LasBytes las = test::fullFile(std::get<0>(GetParam()), std::get<1>(GetParam()), 1000);
  test::writeBytes(folder / "in.las", las.str());
  const LasRewriteResult result = rewriteLas(
      folder / "in.las", folder / "out.las",
      [](const LasRecordBlock& block) { addToX(block, 500); }, 2);
  EXPECT_TRUE(result.box_changed);
  const LasFile out(folder / "out.las");
  // 1e-9 m: rounding of a double at 1e5.
  EXPECT_NEAR(out.header().minimum.x(), LasBytes::X(0) * 0.001 + las.offset_x + 0.5, 1e-9);
  EXPECT_EQ(out.header().minimum.y(), LasBytes::Y(999) * 0.001 + las.offset_y);
  rewriteLas(
      folder / "out.las", folder / "back.las",
      [](const LasRecordBlock& block) { addToX(block, -500); }, 2);
  EXPECT_EQ(test::readBytes(folder / "back.las"), las.str());
}

INSTANTIATE_TEST_SUITE_P(VersionsAndFormats, LasRewriterMatrix,
                         testing::Combine(testing::Values(2, 3, 4, 5), testing::Range(0, 11)));

TEST(LasRewriter, CallsTheEditOnceForEveryRecord) {
  const auto folder = test::scratch("las_rewriter_blocks");
  LasBytes las;
  las.count = 120000;  // several blocks of 1 MiB
  test::writeBytes(folder / "in.las", las.str());
  std::vector<std::atomic<int>> seen(las.count);
  rewriteLas(
      folder / "in.las", folder / "out.las",
      [&](const LasRecordBlock& block) {
        for (std::size_t i = 0; i < block.count; ++i) {
          const std::uint64_t index = block.first + i;
          const auto x = loadLas<std::int32_t>(block.records + i * block.record_length);
          EXPECT_EQ(x, LasBytes::X(static_cast<unsigned>(index)));
          ++seen[index];
        }
      },
      3);
  for (const auto& count : seen) ASSERT_EQ(count, 1);
}

TEST(LasRewriter, AnAbandonedFileDoesNotAppear) {
  const auto folder = test::scratch("las_rewriter_abandoned");
  LasBytes las;
  las.count = 120000;
  test::writeBytes(folder / "in.las", las.str());
  for (const char* name : {"out.las", "out.laz"}) {
    std::atomic<int> blocks{0};
    LasExtension extension;
    extension.block_records = 1000;
    extension.abandon = [&blocks] { return blocks > 1; };
    const LasEdit edit = [&blocks](const LasRecordBlock&) { ++blocks; };
    EXPECT_FALSE(extendLas(LasFile(folder / "in.las"), folder / name, extension, edit, 2).complete);
    EXPECT_LT(blocks, 120);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1) << name;
    extension.abandon = [] { return false; };
    EXPECT_TRUE(extendLas(LasFile(folder / "in.las"), folder / name, extension, edit, 2).complete);
    std::filesystem::remove(folder / name);
  }
}

TEST(LasRewriter, OneThreadEqualsEight) {
  const auto folder = test::scratch("las_rewriter_threads");
  LasBytes las;
  las.count = 120000;
  test::writeBytes(folder / "in.las", las.str());
  const LasEdit edit = [](const LasRecordBlock& block) {
    addToX(block, static_cast<int>(block.first % 1000));
  };
  rewriteLas(folder / "in.las", folder / "one.las", edit, 1);
  rewriteLas(folder / "in.las", folder / "eight.las", edit, 8);
  EXPECT_NE(test::readBytes(folder / "one.las"), las.str());
  EXPECT_EQ(test::readBytes(folder / "one.las"), test::readBytes(folder / "eight.las"));
}

/// Compressed files are coded in their order, but blocks between are edited on several threads.
TEST(LasRewriter, BlocksOfCompressedFilesAreEditedAtOnce) {
  const auto folder = test::scratch("las_rewriter_laz");
  LasBytes las;
  las.count = 200000;
  test::writeBytes(folder / "in.las", las.str());
  std::vector<std::atomic<int>> seen(las.count);
  std::atomic<int> running{0}, together{0};
  rewriteLas(
      folder / "in.las", folder / "in.laz",
      [&](const LasRecordBlock& block) {
        ++running;
        // Seconds for a machine under load: a second thread comes, or never will.
        for (int i = 0; i < 5000 && running < 2 && together == 0; ++i)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (running > 1) together = 1;
        for (std::size_t i = 0; i < block.count; ++i) ++seen[block.first + i];
        --running;
      },
      2);
  EXPECT_EQ(together, 1);
  for (const auto& count : seen) ASSERT_EQ(count, 1);
}

TEST(LasRewriter, CompressedAndPlainFilesAreEditedAlike) {
  const auto folder = test::scratch("las_rewriter_both");
  LasBytes las;
  las.count = 200000;
  test::writeBytes(folder / "in.las", las.str());
  const LasEdit edit = [](const LasRecordBlock& block) {
    addToX(block, static_cast<int>(block.first % 1000));
  };
  rewriteLas(folder / "in.las", folder / "in.laz", kNothing);
  rewriteLas(folder / "in.laz", folder / "four.laz", edit, 4);
  rewriteLas(folder / "in.laz", folder / "one.laz", edit, 1);
  EXPECT_EQ(test::readBytes(folder / "one.laz"), test::readBytes(folder / "four.laz"));
  rewriteLas(folder / "in.las", folder / "plain.las", edit, 1);
  rewriteLas(folder / "four.laz", folder / "unpacked.las", kNothing, 2);
  EXPECT_EQ(test::readBytes(folder / "plain.las"), test::readBytes(folder / "unpacked.las"));
}

TEST(LasRewriter, AWrongBoxIsReplacedByThatOfThePoints) {
  LasBytes las;
  las.count = 300;
  LasExtension keeping;
  keeping.keeps_coordinates = true;
  for (const test::WrongBox& wrong : test::wrongBoxes(las)) {
    const auto folder = test::scratch("las_rewriter_box");
    test::writeBytes(folder / "in.las", wrong.bytes);
    const LasRewriteResult result = rewriteLas(folder / "in.las", folder / "out.las", kNothing);
    EXPECT_FALSE(result.box_changed);
    ASSERT_EQ(result.remarks.size(), 1U) << wrong.name;
    EXPECT_EQ(result.remarks[0].find("the header's bounding box is wrong: it says "), 0U);
    EXPECT_EQ(test::readBytes(folder / "out.las"), las.str()) << wrong.name;
    EXPECT_EQ(extendLas(LasFile(folder / "in.las"), folder / "kept.las", keeping, kNothing).remarks,
              result.remarks);
    EXPECT_EQ(test::readBytes(folder / "kept.las"), las.str()) << wrong.name;
  }
}

TEST(LasRewriter, ABoxThatIsRoundedOtherwiseIsKept) {
  const auto folder = test::scratch("las_rewriter_rounded_box");
  std::string bytes = LasBytes().str();
  double x = 0.0;
  std::memcpy(&x, &bytes[kLasBoxPosition], sizeof x);
  x += 0.0004;  // less than a step
  std::memcpy(&bytes[kLasBoxPosition], &x, sizeof x);
  test::writeBytes(folder / "in.las", bytes);
  EXPECT_TRUE(rewriteLas(folder / "in.las", folder / "out.las", kNothing).remarks.empty());
  EXPECT_EQ(test::readBytes(folder / "out.las"), bytes);
}

TEST(LasRewriter, AnExceptionInTheEditLeavesNoFile) {
  const auto folder = test::scratch("las_rewriter_throw");
  test::writeBytes(folder / "in.las", LasBytes().str());
  const LasEdit edit = [](const LasRecordBlock&) { throw InputError("no trajectory"); };
  EXPECT_THROW(rewriteLas(folder / "in.las", folder / "out.las", edit), InputError);
  const auto files = std::filesystem::directory_iterator(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);  // only in.las
}

TEST(LasRewriter, RefusesItsOwnInputAsOutput) {
  const auto folder = test::scratch("las_rewriter_same");
  test::writeBytes(folder / "in.las", LasBytes().str());
  std::filesystem::create_symlink(folder / "in.las", folder / "link.las");
  EXPECT_THROW(rewriteLas(folder / "in.las", folder / "in.las", kNothing), UsageError);
  EXPECT_THROW(rewriteLas(folder / "in.las", folder / "link.las", kNothing), UsageError);
  EXPECT_EQ(test::readBytes(folder / "in.las"), LasBytes().str());
}

TEST(LasRewriter, CopiesARealTile) {
  const auto tile = test::unpacked("delft_ahn3/ahn3_cropped_2.las.xz");
  PCL_ALS_REQUIRE_DATA(tile);
  const auto folder = test::scratch("las_rewriter_real");
  rewriteLas(*tile, folder / "out.las", kNothing, 2);
  EXPECT_EQ(test::readBytes(folder / "out.las"), test::readBytes(*tile));
}

}  // namespace
}  // namespace pcl_als
