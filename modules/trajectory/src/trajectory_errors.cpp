// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/trajectory/trajectory_errors.h>

namespace pcl_als {
namespace {

constexpr double kBeyond = 2.0;  // seconds: points of the turn-in that the calibration did not use

bool usable(const std::vector<TrajectoryErrorKnot>& knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const TrajectoryErrorKnot& knot = knots[i];
    if (!std::isfinite(knot.time) || !knot.position.allFinite() || !knot.angles.allFinite()) {
      return false;
    }
    if (i > 0 && !(knots[i - 1].time < knot.time)) return false;
  }
  return true;
}

}  // namespace

TrajectoryErrors::TrajectoryErrors(const std::vector<StripErrors>& strips) {
  std::vector<const StripErrors*> in_order;
  for (const StripErrors& strip : strips) {
    if (!usable(strip.knots)) {
      throw InputError("strip corrections of strip " + strip.id +
                       ": times must increase and all values be finite");
    }
    if (!strip.knots.empty()) in_order.push_back(&strip);
  }
  std::sort(in_order.begin(), in_order.end(), [](const StripErrors* a, const StripErrors* b) {
    return a->knots.front().time < b->knots.front().time;
  });
  std::string pass;
  for (const StripErrors* strip : in_order) {
    // Channels of a scanner have the errors of their pass.
    if (!strips_.empty() && passOfStrip(strip->id) == pass && strip->id != pass &&
        strip->knots.front().time == strips_.back().front().time)
      continue;
    pass = passOfStrip(strip->id);
    if (!strips_.empty() && strip->knots.front().time < strips_.back().back().time) {
      throw InputError(
          "strip corrections: strip " + strip->id +
          " was measured at the same time as another; they cannot be separated by time");
    }
    strips_.push_back(strip->knots);
  }
}

bool TrajectoryErrors::at(double time, TrajectoryErrorKnot& errors) const {
  errors = TrajectoryErrorKnot();
  errors.time = time;
  // Where two strips are less than four seconds apart, the nearer one counts.
  const std::vector<TrajectoryErrorKnot>* nearest = nullptr;
  double distance = kBeyond;
  auto after =
      std::upper_bound(strips_.begin(), strips_.end(), time,
                       [](double value, const auto& knots) { return value < knots.front().time; });
  for (auto strip = after == strips_.begin() ? after : after - 1;
       strip != strips_.end() && strip <= after; ++strip) {
    const double away = std::max({0.0, strip->front().time - time, time - strip->back().time});
    if (!(away <= distance)) continue;
    distance = away;
    nearest = &*strip;
  }
  if (nearest == nullptr) return false;
  const auto next = std::lower_bound(
      nearest->begin(), nearest->end(), time,
      [](const TrajectoryErrorKnot& knot, double value) { return knot.time < value; });
  const TrajectoryErrorKnot& b = next == nearest->end() ? nearest->back() : *next;
  const TrajectoryErrorKnot& a = next == nearest->begin() ? b : *(next - 1);
  const double share =
      b.time > a.time ? std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0) : 0.0;
  errors.position = a.position + share * (b.position - a.position);
  errors.angles = a.angles + share * (b.angles - a.angles);
  return true;
}

}  // namespace pcl_als
