// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_facts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include <pcl_als/common/number_text.h>

#include "strip_geometry.h"

namespace pcl_als {
namespace {

using P = SystemParameter;

constexpr double kSteep = 5.0 * kRadiansPerDegree;
// share of pairs on slopes: horizontal shifts are hardly determined
constexpr double kFewSlopes = 0.05;
constexpr double kLeastAside = 0.25;     // of the swath's half width
constexpr std::size_t kEnoughLines = 4;  // lines of a height whose trajectory errors average out
// of the largest angle: with all pairs beyond, only the edges of the swaths overlap
constexpr double kEdge = 0.3;
constexpr double kNarrow = 12.0 * kRadiansPerDegree;

bool has(const std::vector<P>& parameters, P p) {
  return std::find(parameters.begin(), parameters.end(), p) != parameters.end();
}

std::string metres(const std::vector<double>& values) {
  std::ostringstream text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    text << (i == 0 ? "" : i + 1 < values.size() ? ", " : " and ") << std::lround(values[i]);
  }
  text << " m";
  return text.str();
}

void addTo(std::string& text, const std::string& more) {
  if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
}

/// Weighted moments of the tilts of the pairs.
struct Tilts {
  double all = 0.0, steep = 0.0, squares = 0.0;

  void add(const PairObservation& o, double weight) {
    const double tilt = std::atan2(std::hypot(o.normal.x(), o.normal.y()), o.normal.z());
    all += weight;
    squares += weight * tilt * tilt;
    if (tilt > kSteep) steep += weight;
  }
};

}  // namespace

BlockFacts::BlockFacts(const ObservedBlock& block) {
  std::set<std::pair<int, int>> pairs;
  std::set<int> seen;
  Tilts tilts;
  for (std::size_t area = 0; area < block.observations.size(); ++area) {
    for (std::size_t i = 0; i < block.observations[area].size(); ++i) {
      const PairObservation& o = block.observations[area][i];
      const double weight = block.weights[area][i];
      if (weight == 0.0) continue;
      seen.insert(o.b);
      const double angle = std::atan2(o.lateral, o.height);
      half_angle = std::max(half_angle, angle);
      least_angle = std::min(least_angle, angle);
      if (o.a == PairObservation::kControl) continue;
      pairs.insert(std::minmax(o.a, o.b));
      tilts.add(o, weight);
    }
  }
  control = block.control_points;
  control_text =
      block.control_text.empty() ? counted(control, "control point") : block.control_text;
  if (tilts.all > 0.0) {
    slope = std::sqrt(tilts.squares / tilts.all);
    sloped = tilts.steep / tilts.all;
  }
  for (const auto& [a, b] : pairs) {
    const StripGeometry& one = block.strips[static_cast<std::size_t>(a)];
    const StripGeometry& other = block.strips[static_cast<std::size_t>(b)];
    seen.insert(a);
    if (!sameHeight(one, other)) heights_meet = true;
    if (opposite(one, other)) opposite_lines = true;
    if (!opposite(one, other) && !sameWay(one, other)) crossing_lines = true;
    if (!sameWay(one, other) || !sameHeight(one, other)) continue;
    separation = std::max(separation, lateralSeparation(one, other) / one.halfSwath());
  }
  parallel_lines = separation > kLeastAside;
  countHeights(block, seen);
}

void BlockFacts::countHeights(const ObservedBlock& block, const std::set<int>& strips) {
  std::vector<double> all;
  all.reserve(strips.size());
  for (const int strip : strips)
    all.push_back(block.strips[static_cast<std::size_t>(strip)].height);
  std::sort(all.begin(), all.end());
  for (const double height : all) {
    if (heights.empty() || height >= 1.1 * heights.back()) {
      heights.push_back(height);
      lines_at.push_back(0);
    }
    ++lines_at.back();
  }
}

std::string BlockFacts::fewLines() const {
  const auto fewest = std::min_element(lines_at.begin(), lines_at.end());
  if (fewest == lines_at.end() || *fewest >= kEnoughLines) return {};
  const double height = heights[static_cast<std::size_t>(fewest - lines_at.begin())];
  return "the trajectory errors of " + std::to_string(*fewest) + " line" +
         (*fewest == 1 ? "" : "s") + " at " + metres({height}) +
         " mask the effect of the different heights";
}

std::string BlockFacts::causeOf(const std::vector<P>& parameters) const {
  const bool along = has(parameters, P::boresight_pitch) || has(parameters, P::lever_arm_y);
  const bool across = has(parameters, P::lever_arm_x) || has(parameters, P::boresight_roll);
  const bool lever_arm = has(parameters, P::lever_arm_x) || has(parameters, P::lever_arm_y);
  const bool angle = has(parameters, P::boresight_pitch) || has(parameters, P::boresight_roll);
  const bool heading = has(parameters, P::boresight_heading);
  const bool vertical = has(parameters, P::range_bias) || has(parameters, P::lever_arm_z);
  const bool scale = has(parameters, P::scan_angle_scale);
  std::string cause;
  if (vertical && control == 0) addTo(cause, "no control");
  if (lever_arm && angle && heights.size() == 1) {
    addTo(cause, "single flying height (" + metres(heights) + ")");
  } else if (lever_arm && angle && !heights_meet) {
    addTo(cause, "no overlap of lines at different heights");
  } else if (lever_arm && angle) {
    addTo(cause, fewLines());
  }
  if ((along || across) && !opposite_lines && !crossing_lines && !heading) {
    addTo(cause, "one flight direction: the effect is the same in all strips");
  }
  if (heading && !parallel_lines) {
    addTo(cause, "no parallel lines in the same direction, aside of each other");
  }
  if ((along || heading || has(parameters, P::lever_arm_x)) && sloped < kFewSlopes) {
    addTo(cause, "hardly any slopes, and horizontal shifts show on slopes only");
  }
  if ((scale || (vertical && control > 0)) && half_angle < kNarrow) {
    addTo(cause, "pairs in the middle of the swath only");
  }
  if (scale && least_angle > kEdge * half_angle) addTo(cause, "overlap at the swath's edge only");
  if (has(parameters, P::range_bias) && has(parameters, P::lever_arm_z)) {
    addTo(cause, "both shift heights");
  }
  if (scale && vertical && control > 0 && control < 5) addTo(cause, "few control points");
  return cause;
}

std::string BlockFacts::text() const {
  std::ostringstream out;
  out << "flying height" << (heights.size() == 1 ? " " : "s ")
      << (heights.empty() ? "unknown" : metres(heights)) << ", "
      << (opposite_lines ? "opposite" : "no opposite") << " lines, "
      << (crossing_lines ? "crossing" : "no crossing") << " lines, "
      << (parallel_lines ? "parallel" : "no parallel") << " lines in the same direction, "
      << control_text << ", ";
  out.precision(0);
  out << std::fixed << 100.0 * sloped << " % of pairs on slopes over 5 degrees";
  return out.str();
}

SurfaceModel surfaceOf(const BlockFacts& facts) {
  SurfaceModel surface;
  surface.balanced = false;
  surface.usable = 1.0;
  surface.steep_share = 0.0;
  surface.ground_slope = std::min(facts.slope, 44.0 * kRadiansPerDegree);
  return surface;
}

}  // namespace pcl_als
