// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <chrono>
#include <string>

#include <pcl_als/common/progress.h>

namespace pcl_als {

/** \brief Prints one line per step with counts and milliseconds to stdout, unless quiet.
 *
 * `ConsoleStep step("Reading strip1.las", quiet); …; step.done("1843200 points");` gives
 * `Reading strip1.las … 1843200 points, 112 ms`. On a terminal, progress() draws a bar on stderr
 * meanwhile.
 */
class ConsoleStep {
 public:
  ConsoleStep(std::string what, bool quiet);
  ~ConsoleStep();
  ConsoleStep(const ConsoleStep&) = delete;
  ConsoleStep& operator=(const ConsoleStep&) = delete;
  void progress(double fraction);
  void done(const std::string& counts);

 private:
  std::string what_;
  bool quiet_, terminal_, finished_ = false;
  int last_percent_ = -1;
  std::chrono::steady_clock::time_point start_;
};

/// Shows each phase of a job as a ConsoleStep, and its remarks as indented lines; prints nothing if
/// \a quiet.
ProgressCallback consoleProgress(bool quiet);

}  // namespace pcl_als
