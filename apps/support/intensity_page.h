// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include "command_line.h"
#include "intensity_report.h"

namespace pcl_als::app {

/** \brief The report of a radiometric correction for people: report.html with pictures, and
 * report.md.
 *
 * Without module visualization (PCL_ALS_WITH_VTK=OFF) there is no page; writeIntensityReport()
 * writes report.md and tables all the same.
 */
class IntensityPage {
 public:
  /// \a outcome: has to live as long as files are written; tells where their points are.
  IntensityPage(const IntensityRun& run, bool wanted, IntensityOutcome& outcome);
  ~IntensityPage();
  IntensityPage(const IntensityPage&) = delete;
  IntensityPage& operator=(const IntensityPage&) = delete;

  static bool draws();
  /// Writes into the folder of option -report.
  void write(const CommandLine& line, const IntensityReport& report, bool reliable) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als::app
