// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_geometry.h"

#include <cmath>
#include <sstream>

#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

constexpr double kSameAxis = 20.0 * kRadiansPerDegree;

}  // namespace

double StripGeometry::course() const {
  const Eigen::Vector2d d = end - start;
  const double angle = std::atan2(d.x(), d.y());
  return angle < 0.0 ? angle + 2.0 * kPi : angle;
}

double StripGeometry::halfSwath() const {
  return height * std::tan(half_angle);
}

double StripGeometry::lateral(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d d = direction(), p = place - start;
  return p.x() * d.y() - p.y() * d.x();
}

double StripGeometry::along(const Eigen::Vector2d& place) const {
  return (place - start).dot(direction());
}

bool StripGeometry::covers(const Eigen::Vector2d& place) const {
  const double s = along(place);
  return s >= 0.0 && s <= length() && std::abs(lateral(place)) <= halfSwath();
}

SensorPose StripGeometry::poseAbeam(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d d = direction(), foot = start + along(place) * d;
  SensorPose pose;
  pose.position = Eigen::Vector3d(foot.x(), foot.y(), height);
  pose.rotation.col(0) = Eigen::Vector3d(d.y(), -d.x(), 0.0);
  pose.rotation.col(1) = Eigen::Vector3d(d.x(), d.y(), 0.0);
  pose.rotation.col(2) = Eigen::Vector3d::UnitZ();
  return pose;
}

void StripGeometry::validate() const {
  const auto refuse = [&](const std::string& what) {
    throw UsageError("line " + id + ": " + what);
  };
  const auto within = [&](const char* name, double value, double low, double high) {
    if (std::isfinite(value) && value >= low && value <= high) return;
    std::ostringstream text;
    text << name << ' ' << value << " is outside [" << low << ", " << high << "]";
    refuse(text.str());
  };
  if (!start.allFinite() || !end.allFinite()) refuse("an end is not finite");
  constexpr double kFarthest = 1e8;  // metres: no ground frame reaches farther
  within("an end (m)", std::max(start.cwiseAbs().maxCoeff(), end.cwiseAbs().maxCoeff()), 0.0,
         kFarthest);
  constexpr double kShortest = 10.0, kLongest = 1e6;  // metres
  within("length (m)", length(), kShortest, kLongest);
  within("height above ground (m)", height, 10.0, 20000.0);
  within("half field of view (degrees)", half_angle / kRadiansPerDegree, 0.5, 60.0);
  within("speed (m/s)", speed, 1.0, 400.0);
  within("density (per m2)", density, 1e-3, 1e4);
}

double courseDifference(const StripGeometry& a, const StripGeometry& b) {
  return std::acos(std::max(-1.0, std::min(1.0, a.direction().dot(b.direction()))));
}

bool sameWay(const StripGeometry& a, const StripGeometry& b) {
  return courseDifference(a, b) < kSameAxis;
}

bool opposite(const StripGeometry& a, const StripGeometry& b) {
  return courseDifference(a, b) > kPi - kSameAxis;
}

double lateralSeparation(const StripGeometry& a, const StripGeometry& b) {
  return std::abs(a.lateral(0.5 * (b.start + b.end)) - a.lateral(0.5 * (a.start + a.end)));
}

bool sameHeight(const StripGeometry& a, const StripGeometry& b) {
  return std::max(a.height, b.height) < 1.1 * std::min(a.height, b.height);
}

}  // namespace pcl_als
