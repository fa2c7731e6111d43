// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include <sys/ioctl.h>
#include <unistd.h>

#include <pcl_als/common/console_progress.h>

namespace pcl_als {
namespace {

/// Characters in a line of the terminal; \a otherwise where it does not tell.
int terminalWidth(int otherwise) {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : otherwise;
}

}  // namespace

std::string remainingTime(double fraction, double seconds) {
  if (!(fraction > 0.0 && fraction < 1.0) || seconds < 1.0) return {};
  const double left = seconds * (1.0 - fraction) / fraction;
  if (left < 89.5) return std::to_string(std::lround(left)) + " s left";
  const long minutes = std::lround(left / 60.0);
  if (minutes < 90) return std::to_string(minutes) + " min left";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min left";
}

ConsoleStep::ConsoleStep(std::string what, bool quiet)
    : what_(std::move(what)),
      quiet_(quiet),
      terminal_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      part_start_(start_),
      drawn_(start_) {}

ConsoleStep::~ConsoleStep() {
  if (drawn_percent_ >= 0 && !finished_) std::fputs("\r\033[K", stderr);
}

void ConsoleStep::progress(double fraction) {
  if (!terminal_) return;
  constexpr std::chrono::milliseconds kRedraw(500);
  const Clock::time_point now = Clock::now();
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (fraction < fraction_) part_start_ = now;
  fraction_ = fraction;
  if (static_cast<int>(100.0 * fraction) != drawn_percent_ || now - drawn_ >= kRedraw)
    draw(fraction, now);
}

/// The bar gives way to a long text, and the text is cut where a line is too short for it.
void ConsoleStep::draw(double fraction, Clock::time_point now) {
  constexpr int kBar = 30, kUsualWidth = 100;
  drawn_percent_ = static_cast<int>(100.0 * fraction), drawn_ = now;
  const std::string left =
      remainingTime(fraction, std::chrono::duration<double>(now - part_start_).count());
  char numbers[64];
  std::snprintf(numbers, sizeof numbers, " %3d %%%s%s", drawn_percent_, left.empty() ? "" : ", ",
                left.c_str());
  const int room = terminalWidth(kUsualWidth) - 1 - static_cast<int>(std::string(numbers).size());
  const int text = std::clamp(room, 0, static_cast<int>(what_.size()));
  const int bar = std::clamp(room - text - 3, 0, kBar), filled = drawn_percent_ * bar / 100;
  std::fprintf(stderr, "\r%.*s", text, what_.c_str());
  if (bar > 0)
    std::fprintf(stderr, " [%s%s]", std::string(static_cast<std::size_t>(filled), '#').c_str(),
                 std::string(static_cast<std::size_t>(bar - filled), ' ').c_str());
  std::fprintf(stderr, "%s\033[K", numbers);
}

void ConsoleStep::done(const std::string& counts) {
  finished_ = true;
  if (quiet_) return;
  if (drawn_percent_ >= 0) std::fputs("\r\033[K", stderr);
  const auto elapsed = Clock::now() - start_;
  const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(elapsed).count();
  std::cout << what_ << " … " << counts << ", " << ms << " ms" << std::endl;
}

ProgressCallback consoleProgress(bool quiet) {
  const auto step = std::make_shared<std::unique_ptr<ConsoleStep>>();
  return [step, quiet](const JobProgress& progress) {
    switch (progress.event) {
      case JobProgress::Event::begin:
        *step = std::make_unique<ConsoleStep>(progress.phase, quiet);
        break;
      case JobProgress::Event::advance:
        (*step)->progress(progress.fraction);
        break;
      case JobProgress::Event::remark:
        if (!quiet && !progress.text.empty()) std::cout << "  " << progress.text << std::endl;
        break;
      case JobProgress::Event::end:
        (*step)->done(progress.text);
        break;
    }
    return true;
  };
}

}  // namespace pcl_als
