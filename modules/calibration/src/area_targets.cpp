// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The observations of targets by AreaMatcher.
#include <algorithm>
#include <cmath>

#include <pcl_als/common/linear_solvers.h>

#include "area_matcher.h"
#include "point_geometry.h"

namespace pcl_als {
namespace {

constexpr double kLevel = 0.05;  // a priori standard deviation of the slopes of a target

/// The height of the centre of a target from returns on it, with the variance of one as unit.
struct TargetHeight {
  double height = 0.0, variance = 0.0;
};

TargetHeight heightAt(const Eigen::Vector2d& centre, const std::vector<Eigen::Vector3d>& points,
                      double point_variance) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  const double origin = points.front().z();
  for (const Eigen::Vector3d& p : points) {
    const Eigen::Vector3d row(1.0, p.x() - centre.x(), p.y() - centre.y());
    normal += row * row.transpose();
    right += (p.z() - origin) * row;
  }
  normal.diagonal().tail<2>().array() += point_variance / (kLevel * kLevel);
  const Eigen::Matrix3d inverse = inverseOfSymmetric(normal);
  return {origin + inverse.row(0).dot(right), inverse(0, 0)};
}

}  // namespace

TargetLocation AreaMatcher::targetIn(const ControlPoint& point, const StripPart& part,
                                     double window, const NoiseModel& noise,
                                     PointGeometry& measured) const {
  const TargetSearch search{point.position.head<2>(), 0.5 * point.diameter, window, 0.0, 0.0};
  const double reach = window + 2.0 * search.radius;
  std::vector<TargetPoint> near;
  std::vector<int> indices;
  for (std::size_t i = 0; i < part.biased.size(); ++i) {
    const Eigen::Vector3d& at = part.surface.tin().points()[i];
    if (!part.single[i] || (at - point.position).head<2>().cwiseAbs().maxCoeff() > reach) continue;
    near.push_back({at.head<2>(), part.intensity[i]});
    indices.push_back(static_cast<int>(i));
  }
  PatchQuality level;
  level.plane_normal = Eigen::Vector3d::UnitZ();
  level.plane_centre = point.position;
  if (indices.empty() || !measured.atPoint(part, indices.front(), level)) return {};
  TargetSearch with_blur = search;
  with_blur.blur = std::max(noise.footprint() * measured.range, noise.position);
  with_blur.noise = std::hypot(noise.angle * measured.range, noise.position);
  TargetLocation location = locateTarget(near, with_blur);
  for (int& i : location.certain) i = indices[static_cast<std::size_t>(i)];
  return location;
}

void AreaMatcher::matchTarget(const ControlPoint& point, const StripPart& part, double window,
                              const NoiseModel& noise, PointGeometry& foot, PointGeometry& vertex,
                              AreaObservations& found) const {
  const TargetLocation target = targetIn(point, part, window, noise, vertex);
  if (!target.located()) return;
  Eigen::Vector3d centre(target.centre.x(), target.centre.y(), point.position.z());
  const auto match = part.surface.vertical(centre);
  if (!match) return;
  centre.z() = match->foot.z();
  PatchQuality level;
  level.plane_normal = Eigen::Vector3d::UnitZ();
  level.plane_centre = centre;
  if (!foot.atFoot(part, *match, level, vertex)) return;
  foot.position = centre;
  if (!target.certain.empty()) addHeight(point, part, target, vertex, foot, found);
  addPlan(point, part, target, foot, found);
}

void AreaMatcher::addHeight(const ControlPoint& point, const StripPart& part,
                            const TargetLocation& target, const PointGeometry& vertex,
                            PointGeometry& foot, AreaObservations& found) const {
  std::vector<Eigen::Vector3d> on_target;
  for (const int i : target.certain)
    on_target.push_back(part.surface.tin().points()[static_cast<std::size_t>(i)]);
  const double of_one = vertex.covariance(2, 2);
  const TargetHeight measured = heightAt(target.centre, on_target, of_one);
  foot.position.z() = measured.height;
  PairObservation o = controlObservation(point, part, {Eigen::Vector3d::UnitZ(), 0.0}, foot);
  o.variance = static_cast<float>(measured.variance * of_one + point.sigma * point.sigma);
  o.pointing = static_cast<float>(measured.variance * vertex.pointing(2, 2));
  found.push_back(o);
}

void AreaMatcher::addPlan(const ControlPoint& point, const StripPart& part,
                          const TargetLocation& target, const PointGeometry& foot,
                          AreaObservations& found) const {
  const SymmetricEigen<2> axes = symmetricEigen2(target.covariance);
  // Ranging on slopes lengthens the range as it does where the height is measured.
  const int slope = indexOf(ErrorSource::slope_ranging);
  const double lengthened = foot.sourcesAlong(Eigen::Vector3d::UnitZ())[slope] / foot.beam.z();
  for (int i = 0; i < 2; ++i) {
    const Eigen::Vector3d axis(axes.vectors(0, i), axes.vectors(1, i), 0.0);
    PairObservation o = controlObservation(point, part, {axis, 0.0}, foot);
    o.control_error = PairObservation::ControlError::plan;
    o.variance = static_cast<float>(axes.values[i] + std::pow(point.sigmaInPlan(), 2));
    o.pointing = 0.0F;  // a part of the posterior of the centre, which the scatter shows
    o.sources[slope] = static_cast<float>(-lengthened * axis.dot(foot.beam));
    found.push_back(o);
  }
}

std::vector<TargetInStrip> AreaMatcher::targetsIn(const ControlPoint& point, double window,
                                                  const Trajectory& trajectory,
                                                  const NoiseModel& noise) const {
  std::vector<TargetInStrip> found;
  PointGeometry measured(trajectory, noise, nullptr);
  for (const StripPart& part : surfaces_) {
    if (part.biased.empty() || part.held() || !part.surface.vertical(point.position)) continue;
    const TargetStatus status = targetIn(point, part, window, noise, measured).status;
    const auto known = std::find_if(found.begin(), found.end(), [&](const TargetInStrip& other) {
      return other.strip == part.strip;
    });
    if (known == found.end())
      found.push_back({part.strip, status});
    else if (status == TargetStatus::located)
      known->status = status;  // one of two half-scans suffices
  }
  return found;
}

}  // namespace pcl_als
