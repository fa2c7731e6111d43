// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "virtual_lines.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "strip_geometry.h"

namespace pcl_als {
namespace {

constexpr std::size_t kMostBaseLines = 3;  // lines from which virtual lines are derived
constexpr std::size_t kControlField = 9;
constexpr double kSameGround =
    0.2;  // of the half swath: lines closer than this cover the same ground
constexpr double kLowest = 100.0;  // metres above ground

using Strips = std::vector<StripGeometry>;

/// The longest line of each flying height, lowest first.
Strips basesOf(const Strips& strips) {
  Strips bases;
  for (const StripGeometry& strip : strips) {
    if (!(strip.length() > 0.0)) continue;
    const auto same = std::find_if(bases.begin(), bases.end(), [&](const StripGeometry& base) {
      return sameHeight(base, strip);
    });
    if (same == bases.end()) {
      bases.push_back(strip);
    } else if (strip.length() > same->length()) {
      *same = strip;
    }
  }
  std::sort(bases.begin(), bases.end(),
            [](const StripGeometry& a, const StripGeometry& b) { return a.height < b.height; });
  if (bases.size() > kMostBaseLines) bases.resize(kMostBaseLines);
  return bases;
}

std::string heightText(double height) {
  return std::to_string(std::lround(height)) + " m";
}

class Additions {
 public:
  Additions(const Strips& strips, bool several_heights)
      : strips_(strips), height_(several_heights ? "another height, " : "a second height, ") {}

  void addFor(const StripGeometry& base) {
    const double aside = base.halfSwath();
    StripGeometry back = base;
    std::swap(back.start, back.end);
    add(back, "an opposite line at " + heightText(base.height) + " over line " + base.id);
    for (const double factor : {0.5, 1.75}) {
      StripGeometry other = back;
      other.height = factor * base.height;
      other.density = base.density / factor;  // the same pulse rate
      if (other.height < kLowest) continue;
      add(other,
          "an opposite line at " + height_ + heightText(other.height) + ", over line " + base.id);
    }
    StripGeometry cross = base;
    const Eigen::Vector2d middle = 0.5 * (base.start + base.end);
    const Eigen::Vector2d along = base.direction(), right(along.y(), -along.x());
    cross.start = middle - 0.5 * base.length() * right;
    cross.end = middle + 0.5 * base.length() * right;
    add(cross, "a cross line at " + heightText(base.height) + " over line " + base.id);
    StripGeometry parallel = base;
    parallel.start += aside * right;
    parallel.end += aside * right;
    add(parallel, "a parallel line in the same direction at " + heightText(base.height) +
                      " with 50 % overlap with line " + base.id);
  }
  std::vector<Advice> take() { return std::move(additions_); }

 private:
  void add(StripGeometry line, const std::string& what) {
    const bool there = std::any_of(strips_.begin(), strips_.end(), [&](const StripGeometry& flown) {
      return sameHeight(flown, line) && sameWay(flown, line) &&
             lateralSeparation(flown, line) < kSameGround * line.halfSwath() &&
             lateralSeparation(line, flown) < kSameGround * line.halfSwath();
    });
    if (there) return;
    Advice advice;
    line.id = "added";
    advice.what = what + " (" + std::to_string(std::lround(line.length())) + " m, " +
                  std::to_string(std::lround(line.duration())) + " s)";
    advice.line = std::move(line);
    additions_.push_back(std::move(advice));
  }

  const Strips& strips_;
  std::string height_;
  std::vector<Advice> additions_;
};

}  // namespace

std::vector<Advice> virtualAdditions(const ObservedBlock& block) {
  const Strips bases = basesOf(block.strips);
  Additions lines(block.strips, bases.size() > 1);
  for (const StripGeometry& base : bases) lines.addFor(base);
  std::vector<Advice> additions = lines.take();
  if (bases.empty()) return additions;
  Advice control;
  control.is_line = false;
  if (block.control_points == 0) {
    control.what = "one vertical control point under line " + bases.front().id;
    control.control = {0.5 * (bases.front().start + bases.front().end)};
    additions.push_back(control);
  }
  if (block.control_points < kControlField) {
    control.what = "a field of nine vertical control points over the block";
    control.control = SyntheticPairs::spread(kControlField, block.strips);
    additions.push_back(control);
  }
  return additions;
}

}  // namespace pcl_als
