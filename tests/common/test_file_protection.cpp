// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_protection.h>

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

class FileProtectionTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  static void put(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }
  static std::string textOf(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  }
  const fs::path folder_ = fs::path(PCL_ALS_TEST_SCRATCH) / "file_protection";
};

TEST_F(FileProtectionTest, AnInputIsNotReplacedByAnyPath) {
  put(folder_ / "input.csv", "mine");
  fs::create_symlink(folder_ / "input.csv", folder_ / "link.csv");
  fs::create_hard_link(folder_ / "input.csv", folder_ / "twin.csv");
  {
    const FileProtection protection(std::vector<fs::path>{folder_ / "input.csv"});
    for (const char* name : {"input.csv", "link.csv", "twin.csv", "../file_protection/input.csv"}) {
      EXPECT_THROW(writeFile(folder_ / name, "new"), UsageError) << name;
      EXPECT_THROW(protection.check(folder_ / name), UsageError) << name;
    }
    writeFile(folder_ / "other.csv", "new");
  }
  EXPECT_EQ(textOf(folder_ / "input.csv"), "mine");
  writeFile(folder_ / "input.csv", "new");  // the job is over
  EXPECT_EQ(textOf(folder_ / "input.csv"), "new");
}

TEST_F(FileProtectionTest, AGuardedFolderKeepsWhatTheUserPutThere) {
  const fs::path report = folder_ / "report";
  fs::create_directories(report);
  put(report / "control.csv", "mine");
  fs::create_symlink("nowhere", report / "link.csv");
  FileProtection protection;
  protection.guard(folder_ / "." / "report");
  for (const char* name : {"control.csv", "link.csv"}) {
    EXPECT_THROW(writeFile(report / name, "new"), UsageError) << name;
    EXPECT_THROW(refuseForeign({report / "new.csv", report / name}), UsageError) << name;
  }
  EXPECT_EQ(textOf(report / "control.csv"), "mine");
  writeFile(folder_ / "control.csv", "beside it");
  protection.allow(report / "control.csv");
  writeFile(report / "control.csv", "named");
  EXPECT_EQ(textOf(report / "control.csv"), "named");
}

TEST_F(FileProtectionTest, AGuardedFolderReplacesWhatItWroteUntilItChanges) {
  const fs::path report = folder_ / "made" / "report";  // made by the first file
  FileProtection protection;
  protection.guard(report);
  for (const char* text : {"one", "two", "three"}) writeFile(report / "pairs.csv", text);
  EXPECT_EQ(textOf(report / "pairs.csv"), "three");
  EXPECT_TRUE(isReplaceable(report / "pairs.csv"));
  // A copy of the folder is as good.
  fs::copy(report, folder_ / "copy");
  EXPECT_TRUE(isReplaceable(folder_ / "copy" / "pairs.csv"));
  put(report / "pairs.csv", "3hree");
  EXPECT_FALSE(isReplaceable(report / "pairs.csv"));
  EXPECT_THROW(writeFile(report / "pairs.csv", "four"), UsageError);
  EXPECT_EQ(textOf(report / "pairs.csv"), "3hree");
}

TEST_F(FileProtectionTest, AChangeOfALargeFileIsSeen) {
  FileProtection protection;
  protection.guard(folder_);
  const std::string text(20 << 20, 'x');
  writeFile(folder_ / "points.las", text);
  EXPECT_TRUE(isReplaceable(folder_ / "points.las"));
  for (const std::size_t at : {std::size_t{0}, text.size() - 1}) {
    std::string changed = text;
    changed[at] = 'y';
    put(folder_ / "points.las", changed);
    EXPECT_FALSE(isReplaceable(folder_ / "points.las")) << at;
  }
  put(folder_ / "points.las", text + "x");
  EXPECT_FALSE(isReplaceable(folder_ / "points.las"));
}

TEST_F(FileProtectionTest, AFileThatFailsLeavesNothing) {
  FileProtection protection;
  protection.guard(folder_);
  { AtomicFile file(folder_ / "pairs.csv"); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace pcl_als
