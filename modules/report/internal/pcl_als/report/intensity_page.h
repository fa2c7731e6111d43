// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl_als/report/intensity_report.h>
#include <pcl_als/report/report_origin.h>

namespace pcl_als {

/// The report of a radiometric correction: report.html with pictures, and report.md.
class IntensityPage {
 public:
  virtual ~IntensityPage() = default;
  /// For IntensityOptions::observe: the page receives the positions of the points that are written.
  virtual IntensityOptions::SeenPoint observe(const IntensityRun& run) = 0;
  /// Writes the page into the folder of \a origin.
  virtual void write(const ReportOrigin& origin, const IntensityReport& report) const = 0;
};

std::unique_ptr<IntensityPage> makeIntensityPage();

}  // namespace pcl_als
