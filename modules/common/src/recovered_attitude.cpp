// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/recovered_attitude.h>

namespace pcl_als {
namespace {

using Knot = RecoveredAttitude::Knot;
using Pass = RecoveredAttitude::Pass;

PitchAndCrab interpolated(const Pass& pass, double time) {
  const auto after =
      std::lower_bound(pass.begin(), pass.end(), time,
                       [](const Knot& knot, double value) { return knot.time < value; });
  if (after == pass.begin()) return after->angles;
  const Knot& a = *(after - 1);
  if (after == pass.end()) return a.angles;
  const double share = (time - a.time) / (after->time - a.time);
  return {a.angles.pitch + share * (after->angles.pitch - a.angles.pitch),
          a.angles.crab + share * (after->angles.crab - a.angles.crab)};
}

/// Seconds from a time to the nearest knot's side of the pass; 0 within it.
double distanceTo(const Pass& pass, double time) {
  return std::max({0.0, pass.front().time - time, time - pass.back().time});
}

}  // namespace

void RecoveredAttitude::addPass(Pass pass) {
  if (pass.empty()) throw InputError("recovered attitude: a pass has no knots");
  for (std::size_t i = 0; i < pass.size(); ++i) {
    const Knot& knot = pass[i];
    if (!std::isfinite(knot.time) || !std::isfinite(knot.angles.pitch) ||
        !std::isfinite(knot.angles.crab)) {
      throw InputError("recovered attitude: a time or an angle is not finite");
    }
    if (i > 0 && knot.time <= pass[i - 1].time) {
      throw InputError("recovered attitude: times of a pass do not increase");
    }
  }
  passes_.push_back(std::move(pass));
}

void RecoveredAttitude::addPasses(const RecoveredAttitude& other) {
  std::vector<Pass> parts;
  for (const Pass& pass : other.passes_) {
    bool open = false;
    for (const Knot& knot : pass) {
      const bool known = covers(knot.time);
      if (!known && !open) parts.emplace_back();
      if (!known) parts.back().push_back(knot);
      open = !known;
    }
  }
  passes_.insert(passes_.end(), std::make_move_iterator(parts.begin()),
                 std::make_move_iterator(parts.end()));
}

const RecoveredAttitude::Pass* RecoveredAttitude::passAt(double time) const {
  const auto found = std::find_if(passes_.begin(), passes_.end(), [time](const Pass& pass) {
    return distanceTo(pass, time) <= kMaximumExtrapolation;
  });
  return found == passes_.end() ? nullptr : &*found;
}

PitchAndCrab RecoveredAttitude::at(double time) const {
  const Pass* nearest = nullptr;
  double smallest = std::numeric_limits<double>::infinity();
  for (const Pass& pass : passes_) {
    const double distance = distanceTo(pass, time);
    if (distance <= kMaximumExtrapolation) return interpolated(pass, time);
    if (distance < smallest) smallest = distance, nearest = &pass;
  }
  return nearest == nullptr ? PitchAndCrab() : interpolated(*nearest, time);
}

}  // namespace pcl_als
