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
 * `Reading strip1.las … 1843200 points, 112 ms`. Where stderr is a terminal, progress() draws a bar
 * there meanwhile, with the percentage and, after a second, the remaining time.
 */
class ConsoleStep {
 public:
  ConsoleStep(std::string what, bool quiet);
  ~ConsoleStep();
  ConsoleStep(const ConsoleStep&) = delete;
  ConsoleStep& operator=(const ConsoleStep&) = delete;
  /// \a fraction of the work that is done, 0 to 1. Where it is smaller than before, the work has
  /// another part, whose time is estimated anew.
  void progress(double fraction);
  void done(const std::string& counts);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(double fraction, Clock::time_point now);

  std::string what_;
  bool quiet_, terminal_, finished_ = false;
  double fraction_ = -1.0;  ///< that was told last; negative: none
  int drawn_percent_ = -1;  ///< negative: nothing is drawn
  Clock::time_point start_, part_start_, drawn_;
};

/// "12 s left", "3 min left", "2 h 5 min left": of work of which a fraction took so many seconds,
/// at the same speed. Empty in the first second and where the fraction is not between 0 and 1.
std::string remainingTime(double fraction, double seconds);

/// Shows each phase of a job as a ConsoleStep, and its remarks as indented lines; prints nothing if
/// \a quiet.
ProgressCallback consoleProgress(bool quiet);

}  // namespace pcl_als
