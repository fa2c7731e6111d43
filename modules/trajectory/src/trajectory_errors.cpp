// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
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

/// Whether two strips have the same errors: channels of a scanner, or scanners of one pass with ids
/// of their own.
bool haveSameErrors(const std::vector<TrajectoryErrorKnot>& a,
                    const std::vector<TrajectoryErrorKnot>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& one, const auto& other) {
    return one.time == other.time && one.position == other.position && one.angles == other.angles;
  });
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
  for (const StripErrors* strip : in_order) {
    if (!strips_.empty() && haveSameErrors(strips_.back().knots, strip->knots)) continue;
    if (!strips_.empty() && strip->knots.front().time < strips_.back().knots.back().time) {
      throw InputError(
          "strip corrections: strip " + strip->id +
          " was measured at the same time as another; they cannot be separated by time");
    }
    strips_.push_back(*strip);
  }
}

const StripErrors* TrajectoryErrors::stripAt(double time) const {
  // Where two strips are less than four seconds apart, the nearer one counts.
  const StripErrors* nearest = nullptr;
  double distance = kBeyond;
  auto after = std::upper_bound(
      strips_.begin(), strips_.end(), time,
      [](double value, const StripErrors& strip) { return value < strip.knots.front().time; });
  for (auto strip = after == strips_.begin() ? after : after - 1;
       strip != strips_.end() && strip <= after; ++strip) {
    const double away =
        std::max({0.0, strip->knots.front().time - time, time - strip->knots.back().time});
    if (!(away <= distance)) continue;
    distance = away;
    nearest = &*strip;
  }
  return nearest;
}

namespace {

/// The values before and after a time, and the share of the later one.
template <typename Value>
struct Between {
  const Value &a, &b;
  double share;

  Between(const std::vector<Value>& values, double time) : Between(values, next(values, time)) {
    if (a.time < b.time) share = std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0);
  }
  template <typename Part>
  Part mean(Part Value::*part) const {
    return a.*part + share * (b.*part - a.*part);
  }

 private:
  using Place = typename std::vector<Value>::const_iterator;
  static Place next(const std::vector<Value>& values, double time) {
    return std::lower_bound(values.begin(), values.end(), time,
                            [](const Value& value, double at) { return value.time < at; });
  }
  Between(const std::vector<Value>& values, Place next)
      : a(next == values.begin() ? values.front() : *(next - 1)),
        b(next == values.end() ? values.back() : *next),
        share(0.0) {}
};

}  // namespace

bool TrajectoryErrors::at(double time, TrajectoryErrorKnot& errors) const {
  errors = TrajectoryErrorKnot();
  errors.time = time;
  const StripErrors* strip = stripAt(time);
  if (strip == nullptr) return false;
  const Between<TrajectoryErrorKnot> knots(strip->knots, time);
  errors.position = knots.mean(&TrajectoryErrorKnot::position);
  errors.angles = knots.mean(&TrajectoryErrorKnot::angles);
  errors.position_std = knots.mean(&TrajectoryErrorKnot::position_std);
  errors.angles_std = knots.mean(&TrajectoryErrorKnot::angles_std);
  return true;
}

bool TrajectoryErrors::correlationAt(double time, StripErrorCorrelation& correlation) const {
  const StripErrors* strip = stripAt(time);
  if (strip == nullptr || strip->correlations.empty()) return false;
  const Between<StripErrorCorrelation> known(strip->correlations, time);
  correlation.time = time;
  correlation.errors = known.mean(&StripErrorCorrelation::errors);
  correlation.parameters = known.mean(&StripErrorCorrelation::parameters);
  return true;
}

}  // namespace pcl_als
