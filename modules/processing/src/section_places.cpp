// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/number_text.h>
#include <pcl_als/processing/picture/section_places.h>

namespace pcl_als {

double StripDensity::cellFor(double points_in_it) const {
  const double count = std::max(1.0, static_cast<double>(points));
  return std::clamp(std::sqrt(points_in_it * area / count), 0.5, 20.0);
}

std::vector<StripDensity> stripDensities(const std::vector<SurveyedFile>& files,
                                         const StripAssignment& arrangement) {
  std::vector<StripDensity> strips(arrangement.names().size());
  for (std::size_t i = 0; i < strips.size(); ++i)
    strips[i].points = arrangement.expectedPoints()[i];
  for (std::size_t file = 0; file < files.size(); ++file) {
    for (const PointSource& source : files[file].sources.sources) {
      const Eigen::Vector3d size = source.maximum - source.minimum;
      for (const int strip : arrangement.stripsOf(file, source.id))
        strips[static_cast<std::size_t>(strip)].area += size.x() * size.y();
    }
  }
  return strips;
}

double sectionCell(const std::vector<StripDensity>& strips, const std::vector<bool>& chosen) {
  double cell = 1.0;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    // A few stray points of a strip do not represent its density.
    if (chosen[i] && strips[i].points > 1000) cell = std::max(cell, strips[i].cellFor(10.0));
  }
  return std::min(cell, 4.0);
}

std::string describe(const SectionSearch::Place& place) {
  const Eigen::Vector2d middle = 0.5 * (place.line.from + place.line.to);
  using Kind = SectionSearch::Place::Kind;
  const std::string what = place.kind == Kind::gable             ? "gable"
                           : place.kind == Kind::opposite_slopes ? "opposite slopes"
                                                                 : "slope";
  return what + " at " + numberText(middle.x(), 1) + ", " + numberText(middle.y(), 1) + ", " +
         std::to_string(place.strips) + " strips, heights differ by " +
         numberText(place.difference, 3) + " m";
}

}  // namespace pcl_als
