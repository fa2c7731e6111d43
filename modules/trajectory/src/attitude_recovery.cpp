// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/trajectory/attitude_recovery.h>

namespace pcl_als {
namespace {

constexpr double kBin = 0.1;        // seconds
constexpr double kFewest = 20.0;    // points that a bin (with its neighbours') needs
constexpr double kSmoothing = 0.5;  // share of the neighbours' points in a bin's plane
constexpr double kOffPlane = 0.01;  // radians; beyond it the scanner is not a linear one
// What holds an angle that a sliver of a swath leaves open: it is about zero, give or take 0.1 rad,
// at 0.1 m per point. A hundred points over 10 m outweigh it ten thousand times.
constexpr double kPrior = 1.0;

struct Attitude {
  double time = 0.0;
  Trajectory::PitchAndCrab angles;
};

Trajectory::PitchAndCrab interpolated(const std::vector<Attitude>& known, double time) {
  const auto after =
      std::lower_bound(known.begin(), known.end(), time,
                       [](const Attitude& a, double value) { return a.time < value; });
  if (after == known.begin()) return after->angles;
  const Attitude& a = *(after - 1);
  if (after == known.end()) return a.angles;
  const double share = (time - a.time) / (after->time - a.time);
  return {a.angles.pitch + share * (after->angles.pitch - a.angles.pitch),
          a.angles.crab + share * (after->angles.crab - a.angles.crab)};
}

std::string found(const std::vector<Attitude>& known, double off_plane) {
  double low = known.front().angles.crab, high = low, nose_down = known.front().angles.pitch;
  double nose_up = nose_down;
  for (const Attitude& a : known) {
    low = std::min(low, a.angles.crab), high = std::max(high, a.angles.crab);
    nose_down = std::min(nose_down, a.angles.pitch), nose_up = std::max(nose_up, a.angles.pitch);
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "from the points: pitch %.2f ... %.2f, crab %.2f ... %.2f degrees (pulses in a "
                "plane to %.4f degrees)",
                nose_down / kRadiansPerDegree, nose_up / kRadiansPerDegree, low / kRadiansPerDegree,
                high / kRadiansPerDegree, off_plane / kRadiansPerDegree);
  return text;
}

}  // namespace

void AttitudeRecovery::Sums::add(const Sums& other, double weight) {
  n += weight * other.n, t += weight * other.t;
  xx += weight * other.xx, xz += weight * other.xz, zz += weight * other.zz;
  xy += weight * other.xy, zy += weight * other.zy, yy += weight * other.yy;
}

/// y = across x + below z, and the RMS of what is left over the distance.
struct AttitudeRecovery::Plane {
  double across = 0.0, below = 0.0, off_plane = 0.0;
};

AttitudeRecovery::AttitudeRecovery(std::shared_ptr<const Trajectory> flight)
    : flight_(std::move(flight)) {
  if (!flight_ || flight_->hasAttitude()) {
    throw UsageError("attitude recovery: needs a trajectory without attitude");
  }
}

void AttitudeRecovery::add(double time, const Eigen::Vector3d& point) {
  SensorPose pose;
  if (!flight_->poseAt(time, pose, cursor_)) return;
  const Eigen::Vector3d d = pose.rotation.transpose() * (point - pose.position);
  if (!d.allFinite()) return;
  const double from_start = time - flight_->startTime();
  const double bin = std::floor(from_start / kBin);
  bins_[static_cast<std::int64_t>(bin)].add(
      {1.0, from_start - bin * kBin, d.x() * d.x(), d.x() * d.z(), d.z() * d.z(), d.x() * d.y(),
       d.z() * d.y(), d.y() * d.y()},
      1.0);
}

void AttitudeRecovery::add(const PointColumns& points, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    add(points.time[i], {points.x[i], points.y[i], points.z[i]});
  }
}

void AttitudeRecovery::merge(const AttitudeRecovery& other) {
  for (const auto& [bin, sums] : other.bins_) bins_[bin].add(sums, 1.0);
}

AttitudeRecovery::Plane AttitudeRecovery::planeOf(const Sums& s) {
  const double xx = s.xx + kPrior, zz = s.zz + kPrior;
  const double determinant = xx * zz - s.xz * s.xz;
  Plane plane;
  plane.across = (zz * s.xy - s.xz * s.zy) / determinant;
  plane.below = (xx * s.zy - s.xz * s.xy) / determinant;
  const double left = s.yy - plane.across * s.xy - plane.below * s.zy;
  plane.off_plane = std::sqrt(std::max(0.0, left) / (s.xx + s.yy + s.zz));
  return plane;
}

AttitudeRecovery::Outcome AttitudeRecovery::recover() const {
  const std::map<std::int64_t, Sums> in_order(bins_.begin(), bins_.end());
  std::vector<Attitude> known;
  std::vector<double> off_plane;
  for (const auto& [bin, own] : in_order) {
    Sums sums = own;
    for (const std::int64_t neighbour : {bin - 1, bin + 1}) {
      const auto other = in_order.find(neighbour);
      if (other != in_order.end()) sums.add(other->second, kSmoothing);
    }
    if (sums.n < kFewest || !(sums.xx + sums.zz > 0.0)) continue;
    const Plane plane = planeOf(sums);
    const double crab = std::atan(plane.across);
    known.push_back({flight_->startTime() + static_cast<double>(bin) * kBin + own.t / own.n,
                     {std::atan(-plane.below * std::cos(crab)), crab}});
    off_plane.push_back(planeOf(own).off_plane);
  }
  Outcome outcome;
  outcome.flight = flight_;
  if (known.empty()) {
    outcome.remark = "attitude not recovered from the points: too few of them";
    return outcome;
  }
  outcome.off_plane = medianInPlace(off_plane);
  if (outcome.off_plane > kOffPlane) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "attitude not recovered: the pulses lie in no plane (%.2f degrees off it), so "
                  "this is no linear scanner, or the trajectory is another flight's",
                  outcome.off_plane / kRadiansPerDegree);
    outcome.remark = text;
    return outcome;
  }
  outcome.found = true;
  for (const auto& [time, angles] : known) {
    outcome.size += angles.pitch * angles.pitch + angles.crab * angles.crab;
  }
  outcome.size = std::sqrt(outcome.size / static_cast<double>(known.size()));
  outcome.remark = found(known, outcome.off_plane);
  outcome.flight = std::make_shared<const Trajectory>(
      flight_->withAttitude([&](double time) { return interpolated(known, time); }));
  return outcome;
}

}  // namespace pcl_als
