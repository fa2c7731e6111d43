// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/input_file.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// Changes the time of modification as a later write does.
void touch(const fs::path& path) {
  fs::last_write_time(path, fs::last_write_time(path) + std::chrono::seconds(2));
}

std::string refusalOfFile(const fs::path& path, const ContentLimits& limits = kTableLimits) {
  return test::messageOf<InputError>([&] { readWholeFile(path, limits); });
}

void expectPart(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

TEST(WholeFile, IsReadAsItIs) {
  const fs::path path = test::scratch("whole_file") / "a.csv";
  std::string text;
  for (int i = 0; i < 300000; ++i) text += "line " + std::to_string(i) + '\n';
  for (const std::string& content : {text, std::string(), std::string("no end of line")}) {
    put(path, content);
    EXPECT_EQ(readWholeFile(path, kTableLimits), content);
  }
}

TEST(WholeFile, OtherKindsAreRefusedBeforeTheyAreRead) {
  const fs::path folder = test::scratch("whole_file_kinds");
  expectPart(refusalOfFile(folder / "none.csv"),
             "none.csv: cannot be opened: there is no such file");
  expectPart(refusalOfFile(folder), ": is a folder, not a file");
  expectPart(refusalOfFile("/dev/zero"), "/dev/zero: is a device, not a file");
  expectPart(refusalOfFile("/dev/zero", kBinaryLimits), "/dev/zero: is a device, not a file");
}

TEST(WholeFile, ASparseFileOfAnySizeIsRefusedAtOnce) {
  const fs::path path = test::scratch("whole_file_sparse") / "a.json";
  put(path, "{");
  fs::resize_file(path, std::uintmax_t{68} << 30U);
  for (const ContentLimits& limits : {kTableLimits, kGridLimits, kJsonLimits, kBinaryLimits}) {
    expectPart(refusalOfFile(path, limits), "has 73015 MB, more than the ");
  }
  // One within the limit of its size has zeros instead of text.
  fs::resize_file(path, std::uintmax_t{2} << 30U);
  expectPart(refusalOfFile(path), "is no text, because it has a zero byte");
}

TEST(WholeFile, ALineHasALimit) {
  const fs::path path = test::scratch("whole_file_lines") / "a.csv";
  const std::string longest(kTableLimits.line_bytes, 'x');
  put(path, "a\n" + longest + "\nb\n" + longest);
  EXPECT_EQ(readWholeFile(path, kTableLimits).size(), 2 * longest.size() + 5);
  put(path, "a\n" + longest + "x\nb");
  expectPart(refusalOfFile(path), "a line of more than 1048576 characters");
  put(path, "a\n" + longest + longest + longest);
  expectPart(refusalOfFile(path), "a line of more than 1048576 characters");
  EXPECT_EQ(readWholeFile(path, kJsonLimits).size(), 3 * longest.size() + 2);
}

/// Reads what a thread writes into a pipe, as the shell gives it to a program: by a name of its
/// descriptor.
std::string readPiped(const std::string& text, const ContentLimits& limits) {
  int ends[2];
  if (pipe(ends) != 0) return "no pipe";
  std::thread writer([&] {
    std::size_t done = 0;
    for (ssize_t part = 1; part > 0 && done<text.size(); done += part> 0 ? part : 0)
      part = write(ends[1], text.data() + done, text.size() - done);
    close(ends[1]);
  });
  std::string read;
  try {
    read = readWholeFile("/dev/fd/" + std::to_string(ends[0]), limits);
  } catch (const InputError& error) {
    read = error.what();
  }
  close(ends[0]);
  writer.join();
  return read;
}

TEST(WholeFile, APipeIsReadUpToTheLimit) {
  const fs::path path = test::scratch("whole_file_pipe") / "pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expectPart(refusalOfFile(path), "is a pipe into which no program writes");
  const auto before = std::signal(SIGPIPE, SIG_IGN);  // the reader stops at the limit
  const std::string text(300000, 'x');
  EXPECT_EQ(readPiped(text, kTableLimits), text);
  expectPart(readPiped(text, {100000, 0, true}),
             "more than the 1 MB that a file of this kind may have");
  std::signal(SIGPIPE, before);
}

TEST(InputFile, RefusesWhatCannotBeReadAtPositions) {
  const fs::path path = test::scratch("input_file_kinds") / "pipe";
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  expectPart(test::messageOf<InputError>([&] { InputFile file(path); }),
             "is a pipe, which can be read only once, not a file");
}

TEST(InputFile, NoticesThatItWasChangedSinceItWasOpened) {
  const fs::path path = test::scratch("input_file_changed") / "a.las";
  const auto changes = {
      std::function<void()>([&] { put(path, "hallo world"); }),  // longer
      std::function<void()>([&] { fs::resize_file(path, 3); }),
      std::function<void()>([&] { touch(path); }),  // the same size
  };
  for (const std::function<void()>& change : changes) {
    put(path, "hello");
    const InputFile file(path);
    char buffer[5];
    file.read(0, 5, buffer);
    change();
    expectPart(test::messageOf<InputError>([&] { file.read(0, 5, buffer); }),
               "a.las: was changed while it was read");
  }
}

TEST(InputFile, AReplacementLeavesAnOpenFileAsItWas) {
  const fs::path path = test::scratch("input_file_replaced") / "a.las";
  put(path, "hello");
  const InputFile file(path);
  writeFile(path, "other");
  char buffer[6] = {};
  file.read(0, 5, buffer);
  EXPECT_STREQ(buffer, "hello");
}

TEST(UnchangedInputs, CompareTheReadingsOfAJob) {
  const fs::path path = test::scratch("unchanged_inputs") / "a.csv";
  put(path, "hello");
  auto job = std::make_optional<UnchangedInputs>();
  readWholeFile(path, kTableLimits);
  readWholeFile(path, kTableLimits);
  {
    const UnchangedInputs nested;
    touch(path);
  }
  expectPart(refusalOfFile(path), "a.csv: was changed while it was read");
  // Written by the program itself.
  writeFile(path, "other");
  EXPECT_EQ(readWholeFile(path, kTableLimits), "other");
  // Another job may find another version.
  job.reset();
  touch(path);
  EXPECT_EQ(readWholeFile(path, kTableLimits), "other");
  job.emplace();
  EXPECT_EQ(readWholeFile(path, kTableLimits), "other");
}

}  // namespace
}  // namespace pcl_als
