// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <pcl_als/common/console_progress.h>

namespace pcl_als {
namespace {

using namespace std::chrono_literals;

/// stderr is a terminal, with lines of so many characters, as long as it exists.
class Terminal {
 public:
  explicit Terminal(unsigned short columns) : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    const int slave = open(ptsname(master_), O_RDWR | O_NOCTTY);
    winsize size{};
    size.ws_col = columns, size.ws_row = 24;
    if (slave < 0 || ioctl(slave, TIOCSWINSZ, &size) != 0) return;
    std::fflush(stderr);
    before_ = dup(STDERR_FILENO);
    dup2(slave, STDERR_FILENO);
    close(slave);
    fcntl(master_, F_SETFL, O_NONBLOCK);
  }
  ~Terminal() {
    restore();
    close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  bool works() const { return before_ >= 0; }
  /// What was written since the last call.
  std::string written() {
    std::fflush(stderr);
    std::string text;
    char part[4096];
    for (ssize_t n = 0; (n = ::read(master_, part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(n));
    return text;
  }

 private:
  void restore() {
    if (before_ < 0) return;
    std::fflush(stderr);
    dup2(before_, STDERR_FILENO);
    close(before_);
  }
  int master_, before_ = -1;
};

TEST(ConsoleStep, DrawsPercentageAndRemainingTimeOnATerminal) {
  Terminal terminal(80);
  if (!terminal.works()) GTEST_SKIP() << "no pseudo terminal can be opened";
  ConsoleStep step("Reading strip1.las", false);
  step.progress(0.1);
  EXPECT_EQ(terminal.written(),
            "\rReading strip1.las [###                           ]  10 %\033[K");
  std::this_thread::sleep_for(1100ms);
  step.progress(0.1001);
  EXPECT_TRUE(std::regex_match(
      terminal.written(),
      std::regex("\rReading strip1.las \\[###  *\\]  10 %, [0-9]+ (s|min) left\033\\[K")));
  step.progress(0.02);  // another part
  EXPECT_EQ(terminal.written().find("left"), std::string::npos);
  testing::internal::CaptureStdout();
  step.done("2 points");
  EXPECT_EQ(testing::internal::GetCapturedStdout().find("Reading strip1.las … 2 points, "), 0U);
  EXPECT_EQ(terminal.written(), "\r\033[K");
}

TEST(ConsoleStep, StaysWithinALineOfTheTerminal) {
  Terminal terminal(40);
  if (!terminal.works()) GTEST_SKIP() << "no pseudo terminal can be opened";
  ConsoleStep step("Reading " + std::string(100, 'x'), false);
  step.progress(0.25);
  const std::string text = terminal.written();
  EXPECT_EQ(text.substr(text.size() - 9), "  25 %\033[K");
  EXPECT_LT(text.size() - 4, 40U) << "without \\r and the escape sequence";
}

TEST(ConsoleStep, DrawsNothingWithoutATerminalOrIfQuiet) {
  testing::internal::CaptureStderr();
  {
    ConsoleStep step("Reading", false);
    step.progress(0.5);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  Terminal terminal(80);
  if (!terminal.works()) GTEST_SKIP() << "no pseudo terminal can be opened";
  ConsoleStep quiet("Reading", true);
  quiet.progress(0.5);
  quiet.done("2 points");
  EXPECT_EQ(terminal.written(), "");
}

TEST(RemainingTime, IsThatOfTheSameSpeed) {
  EXPECT_EQ(remainingTime(0.5, 0.5), "");
  EXPECT_EQ(remainingTime(0.0, 10.0), "");
  EXPECT_EQ(remainingTime(1.0, 10.0), "");
  EXPECT_EQ(remainingTime(0.25, 10.0), "30 s left");
  EXPECT_EQ(remainingTime(0.1, 20.0), "3 min left");
  EXPECT_EQ(remainingTime(0.001, 7.5), "2 h 5 min left");
}

}  // namespace
}  // namespace pcl_als
