// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/drawing/section_search.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {

/// Density of the points of a strip, from the boxes of its files. An oblique strip fills its box in
/// part and has a smaller density here.
struct StripDensity {
  double area = 0.0;  ///< m^2
  std::uint64_t points = 0;

  /// Side of a cell with a given number of points on average, 0.5 to 20 m.
  double cellFor(double points_in_it) const;
};
/// In the order of StripAssignment::names().
std::vector<StripDensity> stripDensities(const std::vector<SurveyedFile>& files,
                                         const StripAssignment& arrangement);

/// Cells for a SectionSearch among the chosen strips, metres.
double sectionCell(const std::vector<StripDensity>& strips, const std::vector<bool>& chosen);

/// "gable at 1234.5, 6789.0, 3 strips, heights differ by 0.123 m"; gable, opposite slopes or slope.
std::string describe(const SectionSearch::Place& place);

}  // namespace pcl_als
