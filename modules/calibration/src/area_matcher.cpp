// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "area_matcher.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/calibration/pairing_rules.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/tin/orientation_classes.h>
#include <pcl_als/trajectory/source_effect.h>

#include "noise_shares.h"
#include "point_geometry.h"

namespace pcl_als {
namespace {

/// A strip with fewer points in an area and its margin has no TIN there.
constexpr std::size_t kTooFew = 30;

}  // namespace

void AreaMatcher::add(int strip, const LidarReturn& point) {
  if (!area_.covers(point.position) || !isSurfacePoint(point)) return;
  StripPart& part = strips_[static_cast<std::size_t>(strip)];
  part.biased.push_back(point.position);
  part.times.push_back(point.time);
  part.single.push_back(point.isSingle());
  part.intensity.push_back(point.intensity);
  part.turning.push_back((point.flags & kScanDirection) != 0 ? -1 : 1);
}

void AreaMatcher::put(int strip, ByteWriter& out) const {
  const StripPart& part = strips_[static_cast<std::size_t>(strip)];
  out.putPlain(part.biased).put(part.times);
  out.put(std::vector<char>(part.single.begin(), part.single.end()));
  out.put(part.intensity).put(part.turning);
}

void AreaMatcher::get(int strip, ByteReader& in) {
  StripPart& part = strips_[static_cast<std::size_t>(strip)];
  in.getPlain(part.biased).get(part.times);
  const auto single = in.take<std::vector<char>>();
  part.single.assign(single.begin(), single.end());
  in.get(part.intensity).get(part.turning);
}

std::size_t AreaMatcher::pointCount() const {
  std::size_t count = 0;
  for (const StripPart& part : strips_) count += part.biased.size();
  return count;
}

std::size_t AreaMatcher::stripCount() const {
  return static_cast<std::size_t>(std::count_if(
      strips_.begin(), strips_.end(), [](const StripPart& part) { return !part.biased.empty(); }));
}

std::optional<TimeSpan> AreaMatcher::timesOf(int strip) const {
  const std::vector<double>& times = strips_[static_cast<std::size_t>(strip)].times;
  if (times.empty()) return std::nullopt;
  const auto [first, last] = std::minmax_element(times.begin(), times.end());
  return TimeSpan(*first, *last);
}

void AreaMatcher::prepare(const SurfaceCriterion& criterion, std::size_t candidates,
                          double resolution) {
  criterion_ = criterion;
  for (StripPart& part : strips_) {
    if (part.biased.size() < kTooFew) {
      part = StripPart();
      continue;
    }
    // A polygon turns one way, and many files do not say which: a constant sign says nothing.
    const auto constant = [&](std::int8_t sign) { return sign == part.turning.front(); };
    if (std::all_of(part.turning.begin(), part.turning.end(), constant))
      std::fill(part.turning.begin(), part.turning.end(), std::int8_t{0});
    part.surface = PatchSurface(Tin(part.biased, resolution));
    part.median_edge = typicalPlanEdge(part.surface.tin());
    chooseCandidates(part, candidates);
  }
}

SurfaceCriterion AreaMatcher::criterionOf(const StripPart& part) const {
  constexpr double kNoise = 3.0;  // standard deviations of the points of a plane
  SurfaceCriterion criterion = criterion_;
  criterion.roughness = std::max(criterion.roughness, kNoise * part.held_std);
  return criterion;
}

AreaMatcher::Direction AreaMatcher::measuringDirection(const PatchQuality& quality) const {
  const Eigen::Vector3d& normal = quality.plane_normal;
  const double tilt = criterion_.tiltStd(quality);
  if (std::hypot(normal.x(), normal.y()) < kSignificantTilt * tilt)
    return {Eigen::Vector3d::UnitZ(), 0.0};
  return {normal, tilt * tilt};
}

void AreaMatcher::chooseCandidates(StripPart& part, std::size_t count) const {
  // The normals of single triangles are noisy and only select triangles that are examined; slope
  // and aspect are those of the neighbourhood's plane. Neither depends on the point itself:
  // otherwise the noise of points selected by their aspect would not have a mean of zero.
  constexpr std::size_t kExaminedPerCandidate = 4;
  const auto rough = trianglesByOrientation(part.surface, 1, [&](std::int32_t point) {
    return part.single[point] && area_.contains(part.biased[point]);
  });
  const SurfaceCriterion criterion = criterionOf(part);
  std::vector<std::vector<std::int32_t>> classes(OrientationClasses::kCount);
  for (const std::int32_t triangle : chosenEvenly(rough, kExaminedPerCandidate * count)) {
    const PatchQuality quality = part.surface.quality(triangle);
    if (!criterion.isSatisfiedBy(quality, part.median_edge)) continue;
    classes[OrientationClasses::of(quality.plane_normal)].push_back(
        part.surface.tin().triangles()[triangle].vertex[0]);
    if (quality.slope < kGentleSlope && !part.held()) part.roughness.push_back(quality.roughness);
  }
  part.candidates = chosenEvenly(classes, count);
  std::sort(part.candidates.begin(), part.candidates.end());
}

void AreaMatcher::collectSourceScale(const Trajectory& trajectory, double& largest_angle,
                                     std::vector<double>& intensities) const {
  constexpr std::size_t kEvery = 16;  // points
  std::size_t cursor = 0;
  SensorPose pose;
  for (const StripPart& part : strips_) {
    for (std::size_t i = 0; i < part.biased.size() && !part.held(); i += kEvery) {
      intensities.push_back(part.intensity[i]);
      if (trajectory.poseAt(part.times[i], pose, cursor))
        largest_angle = std::max(largest_angle, std::abs(scanGeometry(pose, part.biased[i]).beta));
    }
  }
}

void AreaMatcher::collectRoughness(std::vector<double>& values) const {
  for (const StripPart& part : strips_) {
    values.insert(values.end(), part.roughness.begin(), part.roughness.end());
  }
}

void AreaMatcher::keep(const AreaObservations& observations,
                       const std::vector<ChosenPair>& chosen) {
  kept_.clear();
  for (const ChosenPair& pair : chosen) {
    const PairObservation& o = observations[pair.index];
    if (o.a != PairObservation::kControl)
      kept_[{o.a, o.b}].push_back({o.point, o.sharing / pair.represented, pair.offset});
  }
}

void AreaMatcher::correct(const std::vector<StripCorrection>& corrections) {
  for (std::size_t strip = 0; strip < strips_.size(); ++strip) {
    StripPart& part = strips_[strip];
    if (part.held()) continue;
    const StripCorrection& correction = corrections[strip];
    corrected_for_[strip] << correction.biases->biases(), correction.offset;
    const std::size_t count = part.biased.size();
    if (count == 0) continue;
    std::vector<double> columns[3], effects[3];
    for (int axis = 0; axis < 3; ++axis) {
      columns[axis].reserve(count);
      for (const Eigen::Vector3d& point : part.biased) columns[axis].push_back(point[axis]);
      effects[axis].resize(count);
    }
    CoverageCount ignored;  // the calibration checked that the trajectory covers every strip
    correction.biases->effect(
        {part.times.data(), columns[0].data(), columns[1].data(), columns[2].data()}, count,
        {effects[0].data(), effects[1].data(), effects[2].data()}, ignored);
    std::vector<Eigen::Vector3d> moved(count);
    for (std::size_t i = 0; i < count; ++i) {
      moved[i] = part.biased[i] - correction.offset -
                 Eigen::Vector3d(effects[0][i], effects[1][i], effects[2][i]);
    }
    part.surface.movePoints(std::move(moved));
  }
}

void AreaMatcher::measure(const PointGeometry& point, const PointGeometry& foot,
                          const PatchQuality& quality, PairObservation& observation) const {
  observation.time_a = point.time;
  observation.time_b = foot.time;
  observation.lateral = foot.held ? point.lateral : foot.lateral;
  observation.height = foot.held ? point.height : foot.height;
  const Direction direction = measuringDirection(quality);
  const Eigen::Vector3d& normal = direction.normal;
  observation.normal = normal;
  observation.tilt_variance = direction.variance;
  observation.design = (point.design - foot.design).cast<float>();
  observation.row_a = normal.transpose() * point.design;
  observation.row_b = normal.transpose() * foot.design;
  observation.turn_a = (normal.transpose() * point.turn).cast<float>();
  observation.turn_b = (normal.transpose() * foot.turn).cast<float>();
  observation.misclosure =
      normal.dot(point.position - foot.position) +
      observation.effectAtPoint(corrected_for_[static_cast<std::size_t>(observation.a)]) -
      observation.effectAtPatch(corrected_for_[static_cast<std::size_t>(observation.b)]);
  observation.variance = normalVariance(point.covariance + foot.covariance, normal);
  observation.pointing = normalVariance(point.pointing + foot.pointing, normal);
  observation.sources = point.sourcesAlong(normal) - foot.sourcesAlong(normal);
}

AreaObservations AreaMatcher::match(const std::vector<StripPair>& pairs, double threshold,
                                    const Trajectory& trajectory, const NoiseModel& noise,
                                    Points chosen, std::size_t every) const {
  AreaObservations found;
  std::vector<std::size_t> points;
  for (const StripPart& part : strips_) points.push_back(part.biased.size());
  NoiseShares shares(points);
  const ErrorSourceScale* scale = source_scale_ ? &*source_scale_ : nullptr;
  PointGeometry point(trajectory, noise, scale), foot(trajectory, noise, scale),
      vertex(trajectory, noise, scale);
  const bool all = chosen == Points::candidates;
  for (std::size_t k = 0; k < 2 * pairs.size(); ++k) {
    const StripPair& pair = pairs[k / 2];
    PairObservation observation;
    observation.a = k % 2 == 0 ? pair.first : pair.second;
    observation.b = k % 2 == 0 ? pair.second : pair.first;
    const StripPart& a = strips_[observation.a];
    const StripPart& b = strips_[observation.b];
    if (b.biased.empty()) continue;
    const auto kept = kept_.find({observation.a, observation.b});
    if (!all && kept == kept_.end()) continue;
    const SurfaceCriterion criterion = criterionOf(b);
    const std::size_t count = all ? a.candidates.size() : kept->second.size();
    for (std::size_t c = 0; c < count; c += all ? every : 1) {
      const std::int32_t i = all ? a.candidates[c] : kept->second[c].point;
      const auto match = b.surface.closest(a.surface.tin().points()[i], threshold);
      if (!match) continue;
      const PatchQuality quality = b.surface.quality(match->triangle);
      if (!criterion.isSatisfiedBy(quality, b.median_edge) || !point.atPoint(a, i, quality) ||
          !foot.atFoot(b, *match, quality, vertex))
        continue;
      observation.point = i;
      measure(point, foot, quality, observation);
      shares.add(observation, b.surface.tin().triangles()[match->triangle], match->weights,
                 normalVariance(point.covariance, observation.normal),
                 normalVariance(vertex.covariance, observation.normal));
      if (!all) {
        observation.sharing = kept->second[c].sharing;
        observation.offset = kept->second[c].offset;
        observation.misclosure += observation.offset;
      }
      found.push_back(observation);
    }
  }
  if (all) shares.setSharing(found);
  found.shrink_to_fit();
  return found;
}

}  // namespace pcl_als
