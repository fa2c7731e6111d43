// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/external_waveforms.h>
#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/las/las_selection.h>

#include "las_bytes.h"
#include "las_edits.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::kNothing;
using test::LasBytes;

const std::string kPackets(3 << 20, 'w');  // more than a block of the copy

/// A file of waveforms, whose packets are in another file.
LasBytes waveformFile() {
  LasBytes las;
  las.format = 4;
  las.minor = 3;
  las.encoding = 1 | 4;
  las.vlrs = {LasBytes::vlr("LASF_Spec", 100, std::string(26, 'd'))};
  return las;
}

/// A folder with in.las and its packets.
fs::path folderOf(const std::string& name) {
  fs::path folder = test::scratch(name);
  test::writeBytes(folder / "in.las", waveformFile().str());
  test::writeBytes(folder / "in.wdp", kPackets);
  return folder;
}

/// Names of the files in a folder.
std::string filesIn(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  std::string text;
  for (const std::string& name : names) text += name + ' ';
  return text;
}

class WaveformCopies : public testing::TestWithParam<const char*> {};

TEST_P(WaveformCopies, AreBesideTheOutput) {
  const fs::path folder = folderOf("waveforms_copied");
  const LasRewriteResult result =
      rewriteLas(folder / "in.las", folder / (std::string("out") + GetParam()), kNothing);
  EXPECT_EQ(test::readBytes(folder / "out.wdp"), kPackets);
  ASSERT_EQ(result.remarks.size(), 1U);
  EXPECT_EQ(result.remarks[0],
            "waveforms in in.wdp, 3 145 728 bytes, are copied to " + (folder / "out.wdp").string());
}

INSTANTIATE_TEST_SUITE_P(PlainAndCompressed, WaveformCopies, testing::Values(".las", ".laz"));

TEST(Waveforms, OfAPartAreWhole) {
  const fs::path folder = folderOf("waveforms_part");
  const LasFile in(folder / "in.las");
  std::vector<std::byte> record(in.header().record_length);
  in.readRecords(3, 1, record.data());
  LasSelectionWriter writer(folder / "out.laz", in);
  writer.append(record.data(), 1);
  writer.finish();
  EXPECT_EQ(test::readBytes(folder / "out.wdp"), kPackets);
  EXPECT_EQ(writer.remarks().size(), 1U);
  // The record refers to the same place as before.
  std::vector<std::byte> part(record.size());
  LasFile(folder / "out.laz").readRecords(0, 1, part.data());
  EXPECT_EQ(part, record);
}

TEST(Waveforms, OfTheSameStemStayWhereTheyAre) {
  const fs::path folder = folderOf("waveforms_stem");
  const LasRewriteResult result = rewriteLas(folder / "in.las", folder / "in.laz", kNothing);
  EXPECT_EQ(test::readBytes(folder / "in.wdp"), kPackets);
  ASSERT_EQ(result.remarks.size(), 1U);
  EXPECT_NE(result.remarks[0].find("serve the output as well"), std::string::npos);
}

TEST(Waveforms, ThatAreMissingAreNamed) {
  const fs::path folder = folderOf("waveforms_missing");
  fs::remove(folder / "in.wdp");
  const LasRewriteResult result = rewriteLas(folder / "in.las", folder / "out.las", kNothing);
  ASSERT_EQ(result.remarks.size(), 1U);
  EXPECT_EQ(result.remarks[0], "its records refer to waveforms in a .wdp file, which is missing");
  EXPECT_EQ(filesIn(folder), "in.las out.las ");
}

// Files whose header omits the bit.
TEST(Waveforms, AreExpectedOfDescriptorsWithoutPackets) {
  const fs::path folder = folderOf("waveforms_bit");
  LasBytes las = waveformFile();
  las.encoding = 1;
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_EQ(ExternalWaveforms::of(LasFile(folder / "in.las")).file, folder / "in.wdp");
  las.minor = 4;
  las.evlrs = {LasBytes::evlr("LASF_Spec", 65535, "packets")};
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_FALSE(ExternalWaveforms::of(LasFile(folder / "in.las")).expected);
  las = LasBytes();
  test::writeBytes(folder / "in.las", las.str());
  EXPECT_FALSE(ExternalWaveforms::of(LasFile(folder / "in.las")).expected);
}

TEST(Waveforms, OfOtherFilesAreNotReplaced) {
  for (const std::string owner : {"out.las", "none"}) {
    const fs::path folder = folderOf("waveforms_taken");
    test::writeBytes(folder / "out.wdp", "the packets of another file");
    if (owner != "none") test::writeBytes(folder / owner, waveformFile().str());
    const std::string before = filesIn(folder);
    EXPECT_THROW(rewriteLas(folder / "in.las", folder / "out.laz", kNothing), InputError) << owner;
    EXPECT_EQ(test::readBytes(folder / "out.wdp"), "the packets of another file");
    EXPECT_EQ(filesIn(folder), before);
  }
}

TEST(Waveforms, OfAnEarlierOutputAreReplacedWithIt) {
  const fs::path folder = folderOf("waveforms_again");
  test::writeBytes(folder / "out.las", "earlier");
  test::writeBytes(folder / "out.wdp", "earlier");
  rewriteLas(folder / "in.las", folder / "out.las", kNothing);
  EXPECT_EQ(test::readBytes(folder / "out.wdp"), kPackets);
}

TEST(Waveforms, AreNotCopiedOntoThemselves) {
  const fs::path folder = folderOf("waveforms_linked");
  fs::create_hard_link(folder / "in.wdp", folder / "hard.wdp");
  fs::create_symlink("in.wdp", folder / "soft.wdp");
  rewriteLas(folder / "in.las", folder / "hard.las", kNothing);
  rewriteLas(folder / "in.las", folder / "soft.las", kNothing);
  EXPECT_EQ(test::readBytes(folder / "in.wdp"), kPackets);
  EXPECT_TRUE(fs::equivalent(folder / "in.wdp", folder / "hard.wdp"));
  EXPECT_TRUE(fs::is_symlink(folder / "soft.wdp"));
}

TEST(Waveforms, OfAnOutputThatFailsDoNotAppear) {
  const fs::path folder = folderOf("waveforms_failed");
  const LasEdit failing = [](const LasRecordBlock&) { throw InputError("failed"); };
  EXPECT_THROW(rewriteLas(folder / "in.las", folder / "out.las", failing), InputError);
  EXPECT_EQ(filesIn(folder), "in.las in.wdp ");
}

TEST(Waveforms, OfTwoFilesAreNotJoined) {
  const fs::path folder = folderOf("waveforms_joined");
  test::writeBytes(folder / "other.las", waveformFile().str());
  const LasFile in(folder / "in.las"), other(folder / "other.las");
  EXPECT_NO_THROW(stepsBetween(in, LasFile(folder / "in.las")));
  EXPECT_THROW(stepsBetween(other, in), InputError);
}

/// The packets within a file that the header of LAS 1.3 refers to.
std::string packetsOf(const fs::path& path) {
  const LasFile file(path);
  std::vector<std::byte> bytes(file.fileSize() - file.header().waveform_start);
  file.readBytes(file.header().waveform_start, bytes.size(), bytes.data());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Waveforms, WithinAFileKeepTheirPlace) {
  const fs::path folder = test::scratch("waveforms_internal");
  LasBytes las = waveformFile();
  las.encoding = 1 | 2;
  std::string bytes = las.str();
  const std::uint64_t start = bytes.size();
  std::memcpy(&bytes[227], &start, sizeof start);
  const std::string record = LasBytes::evlr("LASF_Spec", 65535, std::string(2000, 'p'));
  test::writeBytes(folder / "in.las", bytes + record);
  EXPECT_EQ(packetsOf(folder / "in.las"), record);
  rewriteLas(folder / "in.las", folder / "out.laz", kNothing);
  EXPECT_EQ(packetsOf(folder / "out.laz"), record);
  rewriteLas(folder / "out.laz", folder / "back.las", kNothing);
  EXPECT_EQ(test::readBytes(folder / "back.las"), bytes + record);
  LasExtraField field;
  field.name = "added";
  extendLas(LasFile(folder / "in.las"), folder / "longer.laz", {{field}, 0}, kNothing);
  EXPECT_EQ(packetsOf(folder / "longer.laz"), record);
  EXPECT_FALSE(ExternalWaveforms::of(LasFile(folder / "in.las")).expected);
}

}  // namespace
}  // namespace pcl_als
