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
  virtual ~IntensityPage() = default;
  /// Writes into the folder of option -report.
  virtual void write(const CommandLine& line, const IntensityReport& report,
                     bool reliable) const = 0;
};

/** \brief A page that sees where the points are that go into \a outcome; null without VTK.
 *
 * The page is a library of its own, loaded here: those of its pictures take longer to load than a
 * million points take to correct, and few runs write a report.
 * \throw InputError when it is not where it was installed
 */
std::unique_ptr<IntensityPage> loadIntensityPage(const IntensityRun& run,
                                                 IntensityOutcome& outcome);

}  // namespace pcl_als::app
