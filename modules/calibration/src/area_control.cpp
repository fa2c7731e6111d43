// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The observations of control points by AreaMatcher.
#include <cmath>

#include "area_matcher.h"
#include "point_geometry.h"

namespace pcl_als {
namespace {

/// The effect of the error of a control point on a distance: the product of two of them and the
/// variance of the error is their covariance.
Eigen::Vector3d errorEffect(const PairObservation& o) {
  if (o.control_error == PairObservation::ControlError::height)
    return {0.0, 0.0, o.effectOfControl()};
  return o.normal;
}

/// Sets the factor by which the pairs of one control point share the error of the point, in all
/// strips that cover it. The pairs are those of \a found from the index \a first on.
void shareControlError(const ControlPoint& point, std::size_t first, AreaObservations& found) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();  // of heights and of the pairs of a patch
  for (std::size_t i = first; i < found.size(); ++i)
    if (!found[i].isInPlan()) sum += errorEffect(found[i]);
  for (std::size_t i = first; i < found.size(); ++i) {
    PairObservation& o = found[i];
    const Eigen::Vector3d own = errorEffect(o);
    if (!o.isInPlan()) {
      o.variance_inflation =
          static_cast<float>(1.0 + own.dot(sum - own) * point.sigma * point.sigma / o.variance);
      continue;
    }
    double others = 0.0;  // the axes of strips differ
    for (std::size_t k = first; k < found.size(); ++k)
      if (k != i && found[k].isInPlan()) others += std::abs(own.dot(errorEffect(found[k])));
    o.variance_inflation =
        static_cast<float>(1.0 + others * std::pow(point.sigmaInPlan(), 2) / o.variance);
  }
}

}  // namespace

AreaObservations AreaMatcher::matchControl(const std::vector<ControlPoint>& control,
                                           double threshold, const Trajectory& trajectory,
                                           const NoiseModel& noise, double default_sigma) const {
  AreaObservations found;
  const ErrorSourceScale* scale = source_scale_ ? &*source_scale_ : nullptr;
  PointGeometry foot(trajectory, noise, scale), vertex(trajectory, noise, scale);
  for (ControlPoint point : control) {
    if (!area_.contains(point.position)) continue;
    if (!(point.sigma > 0.0)) point.sigma = default_sigma;
    const std::size_t first = found.size();
    for (const StripPart& part : surfaces_) {
      if (part.biased.empty() || part.held()) continue;
      if (point.kind == ControlPoint::Kind::patch)
        matchPatch(point, part, threshold, foot, found);
      else if (point.kind == ControlPoint::Kind::target)
        matchTarget(point, part, threshold, noise, foot, vertex, found);
      else
        matchHeight(point, part, threshold, foot, vertex, found);
    }
    shareControlError(point, first, found);
  }
  return found;
}

void AreaMatcher::matchHeight(const ControlPoint& point, const StripPart& part, double threshold,
                              PointGeometry& foot, PointGeometry& vertex,
                              AreaObservations& found) const {
  const auto match = part.surface.vertical(point.position);
  if (!match || std::abs(match->signed_normal_distance) > threshold) return;
  const PatchQuality quality = part.surface.quality(match->triangle);
  if (!criterion_.isSatisfiedBy(quality, part.median_edge) ||
      !foot.atFoot(part, *match, quality, vertex))
    return;
  found.push_back(
      controlObservation(point, part, measuringDirection(part, match->triangle, quality), foot));
}

void AreaMatcher::matchPatch(const ControlPoint& point, const StripPart& part, double threshold,
                             PointGeometry& measured, AreaObservations& found) const {
  PatchQuality plane;  // the surveyed plane, on which pulses are taken to end
  plane.plane_normal = point.normal;
  plane.plane_centre = point.position;
  for (std::size_t i = 0; i < part.biased.size(); ++i) {
    const Eigen::Vector3d from = part.surface.tin().points()[i] - point.position;
    const double distance = from.dot(point.normal);
    if (!part.single[i] || std::abs(distance) > threshold ||
        (from - distance * point.normal).norm() > 0.5 * point.extent ||
        !measured.atPoint(part, static_cast<std::int32_t>(i), plane))
      continue;
    found.push_back(controlObservation(point, part, {point.normal, 0.0}, measured));
  }
}

PairObservation AreaMatcher::controlObservation(const ControlPoint& point, const StripPart& part,
                                                const Direction& direction,
                                                const PointGeometry& foot) const {
  PairObservation o;
  o.b = part.strip;
  o.half_b = part.half;
  if (point.kind == ControlPoint::Kind::patch)
    o.control_error = PairObservation::ControlError::along_normal;
  o.time_a = o.time_b = foot.time;
  o.lateral = static_cast<float>(foot.lateral);
  o.height = static_cast<float>(foot.height);
  o.normal = direction.normal;
  o.tilt = PairObservation::effectOfTilt(foot.design, o.normal, direction.variance);
  o.row_b = (o.normal.transpose() * foot.design).cast<float>();
  keepSpecial(nullptr, foot, o);
  o.misclosure = o.normal.dot(point.position - foot.position) -
                 o.effectAtPatch(corrected_for_[static_cast<std::size_t>(part.strip)]);
  o.sources = -foot.sourcesAlong(o.normal).cast<float>();
  o.misclosure += o.effectOfSources(corrected_sources_);
  const double sigma = point.sigma * o.effectOfControl();
  o.variance = static_cast<float>(normalVariance(foot.covariance, o.normal) + sigma * sigma);
  o.pointing = static_cast<float>(normalVariance(foot.pointing, o.normal));
  return o;
}

}  // namespace pcl_als
