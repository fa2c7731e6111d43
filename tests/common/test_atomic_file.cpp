// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <csignal>
#include <functional>
#include <thread>

#include <gtest/gtest.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>

#include "file_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, AppearsOnCommit) {
  const fs::path folder = test::scratch("atomic_commit");
  AtomicFile file(folder / "out.txt");
  file.write("first ");
  file.write("second");
  EXPECT_FALSE(fs::exists(folder / "out.txt"));
  EXPECT_EQ(file.temporaryPath().extension(), ".partial");
  file.commit();
  EXPECT_EQ(test::readBytes(folder / "out.txt"), "first second");
  EXPECT_FALSE(fs::exists(file.temporaryPath()));
}

TEST(AtomicFile, LeavesTheOldFileWithoutCommit) {
  const fs::path folder = test::scratch("atomic_dropped");
  test::writeBytes(folder / "out.txt", "old");
  { AtomicFile(folder / "out.txt").write("new"); }
  EXPECT_EQ(test::readBytes(folder / "out.txt"), "old");
  const auto files = fs::directory_iterator(folder);
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

TEST(AtomicFile, ThreadsWriteAtPositions) {
  const fs::path folder = test::scratch("atomic_threads");
  AtomicFile file(folder / "out.txt");
  std::thread second([&] { file.writeAt(5, "world", 5); });
  file.writeAt(0, "hello", 5);
  second.join();
  file.commit();
  EXPECT_EQ(test::readBytes(folder / "out.txt"), "helloworld");
}

TEST(AtomicFile, KeepsPermissionsAndLinks) {
  const fs::path folder = test::scratch("atomic_link");
  test::writeBytes(folder / "real.txt", "old");
  fs::permissions(folder / "real.txt", fs::perms(0640));
  fs::create_symlink("real.txt", folder / "link.txt");
  AtomicFile file(folder / "link.txt");
  file.write("new");
  file.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(test::readBytes(folder / "real.txt"), "new");
  EXPECT_EQ(fs::status(folder / "real.txt").permissions(), fs::perms(0640));
}

TEST(AtomicFile, LongNamesFit) {
  const fs::path folder = test::scratch("atomic_long");
  const std::string name(255, 'n');
  AtomicFile file(folder / name);
  file.commit();
  EXPECT_TRUE(fs::exists(folder / name));
}

TEST(AtomicFile, RefusesWhatIsNoPlaceForAFile) {
  const fs::path folder = test::scratch("atomic_refused");
  EXPECT_NE(test::messageOf<InputError>([&] {
              AtomicFile(folder / "none" / "a.txt");
            }).find("folder does not exist"),
            std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([&] { AtomicFile file(folder); }).find("is a folder"),
            std::string::npos);
  EXPECT_NE(
      test::messageOf<InputError>([&] { AtomicFile("/dev/null"); }).find("not a regular file"),
      std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([&] { AtomicFile(""); }).find("is not a file name"),
            std::string::npos);
}

/// Runs in a child process: file size limit instead of a full disk, no privileges needed.
void writeOverTheLimit(const fs::path& path) {
  const rlimit limit{1000, 1000};
  setrlimit(RLIMIT_FSIZE, &limit);
  std::signal(SIGXFSZ, SIG_IGN);
  const std::string message =
      test::messageOf<InputError>([&] { AtomicFile(path).write(std::string(5000, 'x')); });
  _exit(message.find("out.txt: cannot be written: ") != std::string::npos ? 0 : 1);
}

TEST(AtomicFile, AWriteThatFailsIsAnErrorAndLeavesNothing) {
  const fs::path folder = test::scratch("atomic_limit");
  const pid_t child = fork();
  if (child == 0) writeOverTheLimit(folder / "out.txt");
  int status = 1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::is_empty(folder));
}

TEST(AtomicFile, AFullDiskIsAnErrorThatSaysSo) {
  const fs::path folder = test::scratch("atomic_full");
  if (mount("none", folder.c_str(), "tmpfs", 0, "size=64k") != 0)
    GTEST_SKIP() << "needs the right to mount a small disk";
  const std::string message = test::messageOf<InputError>(
      [&] { AtomicFile(folder / "out.txt").write(std::string(1 << 20, 'x')); });
  const bool nothing_left = fs::is_empty(folder);
  umount(folder.c_str());
  EXPECT_NE(message.find("out.txt: cannot be written: the disk is full"), std::string::npos)
      << message;
  EXPECT_TRUE(nothing_left);
}

}  // namespace
}  // namespace pcl_als
