// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <csignal>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <pcl_als/common/atomic_file.h>

#include "file_bytes.h"
#include "interruption.h"
#include "test_files.h"

// A program of its own: handlers are installed in children only, as the tools do.
namespace pcl_als {
namespace {

namespace fs = std::filesystem;

enum class Handlers { none, of_tools };

/// Runs in a child process: waits, with an open file, for the signal to come.
void writeAndWait(const fs::path& path, Handlers handlers) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
  if (handlers == Handlers::of_tools) app::removeUnfinishedFilesOnSignals();
  alarm(60);
  AtomicFile file(path);
  AtomicFile another(path.string() + "2");
  file.write("half");
  test::writeBytes(path.string() + ".ready", "");
  while (true) pause();
}

/// Starts such a child and ends it by \a number; returns its exit status.
int endBy(int number, const fs::path& path, Handlers handlers = Handlers::of_tools) {
  const pid_t child = fork();
  if (child == 0) writeAndWait(path, handlers);
  while (!fs::exists(path.string() + ".ready")) usleep(1000);
  kill(child, number);
  int status = 0;
  waitpid(child, &status, 0);
  fs::remove(path.string() + ".ready");
  return status;
}

TEST(AtomicFileSignals, RemoveTheTemporariesAndEndTheProcess) {
  const fs::path folder = test::scratch("atomic_signal");
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const int status = endBy(number, folder / "out.txt");
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), number);
    EXPECT_TRUE(fs::is_empty(folder)) << "signal " << number;
  }
}

TEST(AtomicFileSignals, TheLibraryInstallsNoHandlers) {
  const fs::path folder = test::scratch("atomic_library");
  const int status = endBy(SIGTERM, folder / "out.txt", Handlers::none);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(fs::is_empty(folder));  // nobody removed the temporaries
  EXPECT_FALSE(fs::exists(folder / "out.txt"));
}

TEST(AtomicFileSignals, RemoveUnfinishedFilesKeepsWhatIsComplete) {
  const fs::path folder = test::scratch("atomic_unfinished");
  AtomicFile whole(folder / "whole.txt"), half(folder / "half.txt");
  whole.commit();
  removeUnfinishedFiles();
  EXPECT_TRUE(fs::exists(folder / "whole.txt"));
  EXPECT_FALSE(fs::exists(half.temporaryPath()));
}

TEST(AtomicFileSignals, KillLeavesTheOldFileWhole) {
  const fs::path folder = test::scratch("atomic_kill");
  test::writeBytes(folder / "out.txt", "old");
  endBy(SIGKILL, folder / "out.txt");
  EXPECT_EQ(test::readBytes(folder / "out.txt"), "old");
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_TRUE(entry.path().filename() == "out.txt" || entry.path().extension() == ".partial");
}

TEST(AtomicFileSignals, AnIgnoredSignalStaysIgnored) {
  const fs::path folder = test::scratch("atomic_nohup");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGHUP, SIG_IGN);
    app::removeUnfinishedFilesOnSignals();
    AtomicFile file(folder / "out.txt");
    std::raise(SIGHUP);
    file.commit();
    _exit(0);
  }
  int status = 1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(folder / "out.txt"));
}

}  // namespace
}  // namespace pcl_als
