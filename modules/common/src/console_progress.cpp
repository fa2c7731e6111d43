// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>
#include <iostream>
#include <memory>

#include <unistd.h>

#include <pcl_als/common/console_progress.h>

namespace pcl_als {

ConsoleStep::ConsoleStep(std::string what, bool quiet)
    : what_(std::move(what)),
      quiet_(quiet),
      terminal_(!quiet && isatty(STDERR_FILENO) != 0),
      start_(std::chrono::steady_clock::now()) {}

ConsoleStep::~ConsoleStep() {
  if (terminal_ && last_percent_ >= 0 && !finished_) std::fputs("\r\033[K", stderr);
}

void ConsoleStep::progress(double fraction) {
  if (!terminal_) return;
  const int percent = static_cast<int>(100.0 * fraction);
  if (percent == last_percent_) return;
  last_percent_ = percent;
  const int filled = percent * 30 / 100;
  std::fprintf(stderr, "\r%s [%.*s%*s] %3d %%", what_.c_str(), filled,
               "##############################", 30 - filled, "", percent);
}

void ConsoleStep::done(const std::string& counts) {
  finished_ = true;
  if (quiet_) return;
  if (terminal_ && last_percent_ >= 0) std::fputs("\r\033[K", stderr);
  const auto elapsed = std::chrono::steady_clock::now() - start_;
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
