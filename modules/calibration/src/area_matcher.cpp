// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "area_matcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include <pcl_als/common/statistics.h>
#include <pcl_als/tin/orientation_classes.h>
#include <pcl_als/trajectory/source_effect.h>

#include "noise_shares.h"
#include "pair_observation.h"
#include "point_geometry.h"

namespace pcl_als {

void AreaMatcher::add(int strip, const LidarReturn& point, float range_std) {
  if (!area_.covers(point.position) || !isSurfacePoint(point)) return;
  StripPart& part = surfaces_[static_cast<std::size_t>(strip)];
  part.biased.push_back(point.position);
  part.times.push_back(point.time);
  part.single.push_back(point.isSingle());
  part.intensity.push_back(point.intensity);
  part.scan_direction.push_back((point.flags & kScanDirection) != 0 ? -1 : 1);
  part.channel.push_back(point.channel);
  part.user_data.push_back(point.user_data);
  part.range_std.push_back(range_std);
}

void AreaMatcher::put(int strip, ByteWriter& out) const {
  const StripPart& part = surfaces_[static_cast<std::size_t>(strip)];
  out.putPlain(part.biased).put(part.times);
  out.put(std::vector<char>(part.single.begin(), part.single.end()));
  out.put(part.intensity).put(part.scan_direction).put(part.channel).put(part.user_data);
  out.put(part.range_std);
}

void AreaMatcher::get(int strip, ByteReader& in) {
  StripPart& part = surfaces_[static_cast<std::size_t>(strip)];
  in.getPlain(part.biased).get(part.times);
  const auto single = in.take<std::vector<char>>();
  part.single.assign(single.begin(), single.end());
  in.get(part.intensity).get(part.scan_direction).get(part.channel).get(part.user_data);
  in.get(part.range_std);
}

void AreaMatcher::clear() {
  surfaces_.assign(corrected_for_.size(), StripPart());
  for (std::size_t i = 0; i < surfaces_.size(); ++i) surfaces_[i].strip = static_cast<int>(i);
}

std::size_t AreaMatcher::pointCount() const {
  std::size_t count = 0;
  for (const StripPart& part : surfaces_) count += part.biased.size();
  return count;
}

std::size_t AreaMatcher::stripCount() const {
  return static_cast<std::size_t>(std::count_if(
      surfaces_.begin(), surfaces_.end(),
      [](const StripPart& part) { return !part.biased.empty() && part.half != ScanHalf::aft; }));
}

std::vector<TimeSpan> AreaMatcher::timesOf(int strip) const {
  std::vector<TimeSpan> spans;
  for (const StripPart& part : surfaces_) {
    if (part.strip != strip) continue;
    const std::vector<TimeSpan> of_part = continuousSpans(part.times);
    spans.insert(spans.end(), of_part.begin(), of_part.end());
  }
  return spans;
}

void AreaMatcher::buildSurface(StripPart& part, double resolution) const {
  part.surface = PatchSurface(Tin(part.biased, resolution));
  part.median_edge = typicalPlanEdge(part.surface.tin(), kEnoughForEdge);
}

void AreaMatcher::prepare(const SurfaceCriterion& criterion, std::size_t candidates,
                          double resolution, const Trajectory& trajectory) {
  criterion_ = criterion;
  for (StripPart& part : surfaces_) {
    // A polygon turns one way, and many files do not say which: a constant sign says nothing.
    const auto constant = [&](std::int8_t sign) { return sign == part.scan_direction.front(); };
    if (std::all_of(part.scan_direction.begin(), part.scan_direction.end(), constant))
      std::fill(part.scan_direction.begin(), part.scan_direction.end(), std::int8_t{0});
  }
  buildSurfaces(candidates, resolution, trajectory);
}

void AreaMatcher::buildSurfaces(std::size_t candidates, double resolution,
                                const Trajectory& trajectory) {
  for (std::size_t strip = 0; strip < corrected_for_.size(); ++strip) {
    StripPart& part = surfaces_[strip];
    if (part.biased.size() < kTooFew) {
      part = StripPart();
      part.strip = static_cast<int>(strip);
      continue;
    }
    buildSurface(part, resolution);
    if (!divideByScanHalf(strip, resolution, trajectory)) {
      chooseCandidates(part, candidates);
      continue;
    }
    chooseCandidates(surfaces_[strip], candidates / 2);
    chooseCandidates(surfaces_.back(), candidates / 2);
  }
}

SurfaceCriterion AreaMatcher::criterionOf(const StripPart& part) const {
  constexpr double kNoise = 3.0;  // standard deviations of the points of a plane
  SurfaceCriterion criterion = criterion_;
  criterion.roughness = std::max(criterion.roughness, kNoise * part.held_std);
  return criterion;
}

AreaMatcher::Direction AreaMatcher::measuringDirection(const StripPart& part, std::int32_t triangle,
                                                       const PatchQuality& quality) const {
  const GroundPlanes::Plane* ground =
      part.ground.under(part.surface.tin().triangles()[triangle].vertex);
  const Eigen::Vector3d& normal = ground != nullptr ? ground->normal : quality.plane_normal;
  const double tilt = ground != nullptr ? ground->tilt_std : criterion_.tiltStd(quality);
  if (std::hypot(normal.x(), normal.y()) < kSignificantTilt * tilt)
    return {Eigen::Vector3d::UnitZ(), 0.0};
  return {normal, tilt * tilt};
}

void AreaMatcher::chooseCandidates(StripPart& part, std::size_t count) const {
  constexpr double kGroundCell = 10.0;  // typical edges
  part.ground = GroundPlanes(part.biased, kGroundCell * part.median_edge, criterion_.roughness);
  // The normals of single triangles are noisy and only select triangles that are examined; slope
  // and aspect are those of the neighbourhood's plane. Neither depends on the point itself:
  // otherwise the noise of points selected by their aspect would not have a mean of zero.
  constexpr std::size_t kExaminedPerCandidate = 4;
  const auto rough = trianglesByOrientation(part.surface, 1, [&](std::int32_t point) {
    return part.single[point] && area_.contains(part.biased[point]);
  });
  // Nor are points selected by the edges and the slope of their triangles, in which nothing is
  // interpolated here: at the edge of a rosette, points chosen by them were 1 to 2 mm too high.
  SurfaceCriterion criterion = criterionOf(part);
  const double least_z = std::cos(criterion.slope);
  criterion.edge_factor = criterion.slope = std::numeric_limits<double>::infinity();
  std::vector<std::vector<std::int32_t>> classes(OrientationClasses::kCount);
  for (const std::int32_t triangle : chosenEvenly(rough, kExaminedPerCandidate * count)) {
    const auto quality = part.surface.suitable(triangle, criterion, part.median_edge);
    if (!quality || quality->plane_normal.z() < least_z) continue;
    classes[OrientationClasses::of(quality->plane_normal)].push_back(
        part.surface.tin().triangles()[triangle].vertex[0]);
    if (quality->slope < kGentleSlope && !part.held()) part.roughness.push_back(quality->roughness);
  }
  part.candidates = chosenEvenly(classes, count);
  std::sort(part.candidates.begin(), part.candidates.end());
}

void AreaMatcher::collectSourceScale(const Trajectory& trajectory, double& largest_angle,
                                     std::vector<double>& intensities) const {
  constexpr std::size_t kEvery = 16;  // points
  std::size_t cursor = 0;
  SensorPose pose;
  for (const StripPart& part : surfaces_) {
    for (std::size_t i = 0; i < part.biased.size() && !part.held(); i += kEvery) {
      intensities.push_back(part.intensity[i]);
      if (trajectory.poseAt(part.times[i], pose, cursor))
        largest_angle = std::max(largest_angle, std::abs(scanGeometry(pose, part.biased[i]).beta));
    }
  }
}

void AreaMatcher::collectRoughness(std::vector<double>& values) const {
  for (const StripPart& part : surfaces_) {
    values.insert(values.end(), part.roughness.begin(), part.roughness.end());
  }
}

void AreaMatcher::keep(const AreaObservations& observations,
                       const std::vector<ChosenPair>& chosen) {
  kept_.clear();
  for (const ChosenPair& pair : chosen) {
    const PairObservation& o = observations[pair.index];
    if (o.a != PairObservation::kControl)
      kept_[{o.surfaceA(), o.surfaceB()}].push_back(
          {o.point, static_cast<float>(o.variance_inflation / pair.represented),
           static_cast<float>(pair.offset)});
  }
}

std::vector<Eigen::Vector3d> AreaMatcher::reconstructed(const StripPart& part,
                                                        const StripCorrection& correction) {
  const std::size_t count = part.biased.size();
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
  std::vector<Eigen::Vector3d> points(count);
  for (std::size_t i = 0; i < count; ++i)
    points[i] = part.biased[i] - correction.offset -
                Eigen::Vector3d(effects[0][i], effects[1][i], effects[2][i]);
  return points;
}

void AreaMatcher::removeSourceEffects(const StripPart& part, const Trajectory& trajectory,
                                      std::vector<Eigen::Vector3d>& points) const {
  if (corrected_sources_.isZero(0.0)) return;
  const ErrorSourceScale scale = source_scale_.value_or(ErrorSourceScale());
  SourceEffect effect(trajectory);
  SensorPose pose;
  std::size_t cursor = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!trajectory.poseAt(part.times[i], pose, cursor)) continue;
    points[i] -= effect.displacement(
        {part.times[i], part.intensity[i], static_cast<float>(part.scan_direction[i])}, pose,
        points[i], scale, corrected_sources_);
  }
}

void AreaMatcher::correct(const std::vector<StripCorrection>& corrections,
                          const ErrorSourceVector& sources, const Trajectory& trajectory) {
  corrected_sources_ = sources;
  corrected_sources_[indexOf(ErrorSource::slope_ranging)] = 0.0;
  for (StripPart& part : surfaces_) {
    if (part.held()) continue;
    const auto strip = static_cast<std::size_t>(part.strip);
    corrected_for_[strip] << corrections[strip].biases->biases(), corrections[strip].offset;
    if (part.biased.empty()) continue;
    std::vector<Eigen::Vector3d> points = reconstructed(part, corrections[strip]);
    removeSourceEffects(part, trajectory, points);
    part.ground.fit(points);
    part.surface.movePoints(std::move(points));
  }
}

void AreaMatcher::keepSpecial(const PointGeometry* point, const PointGeometry& foot,
                              PairObservation& observation) {
  const bool turned = point != nullptr && (point->held || foot.held);
  observation.special.reset();
  if (!foot.mixed && !turned) return;
  const auto along = [&](const Eigen::Matrix3d& turn) {
    return BoresightPartials((observation.normal.transpose() * turn).cast<float>());
  };
  PairObservation::Special special;
  if (turned) {
    special.boresight_a = along(point->turn);
    special.boresight_b = along(foot.turn);
  }
  special.mixed_times = foot.mixed;
  for (std::size_t i = 0; i < foot.vertices.size() && foot.mixed; ++i) {
    const PointGeometry::AtVertex& vertex = foot.vertices[i];
    special.vertices[i] = {vertex.time, static_cast<float>(vertex.weight), along(vertex.turn)};
  }
  observation.special = std::make_shared<const PairObservation::Special>(special);
}

void AreaMatcher::measure(const PointGeometry& point, const PointGeometry& foot,
                          const Direction& direction, PairObservation& observation) const {
  observation.time_a = point.time;
  observation.time_b = foot.time;
  observation.lateral = static_cast<float>(foot.held ? point.lateral : foot.lateral);
  observation.height = static_cast<float>(foot.held ? point.height : foot.height);
  const Eigen::Vector3d& normal = direction.normal;
  observation.normal = normal;
  observation.tilt =
      PairObservation::effectOfTilt(point.design - foot.design, normal, direction.variance);
  observation.row_a = (normal.transpose() * point.design).cast<float>();
  observation.row_b = (normal.transpose() * foot.design).cast<float>();
  keepSpecial(&point, foot, observation);
  observation.variance =
      static_cast<float>(normalVariance(point.covariance + foot.covariance, normal));
  observation.pointing = static_cast<float>(normalVariance(point.pointing + foot.pointing, normal));
  observation.echo = static_cast<float>(point.echoAlong(normal) + foot.echoAlong(normal));
  observation.sources = (point.sourcesAlong(normal) - foot.sourcesAlong(normal)).cast<float>();
  observation.misclosure =
      normal.dot(point.position - foot.position) +
      observation.effectAtPoint(corrected_for_[static_cast<std::size_t>(observation.a)]) -
      observation.effectAtPatch(corrected_for_[static_cast<std::size_t>(observation.b)]) +
      observation.effectOfSources(corrected_sources_);
}

std::vector<std::pair<std::size_t, std::size_t>> AreaMatcher::surfacePairs(
    const std::vector<StripPair>& pairs) const {
  const std::size_t strips = corrected_for_.size();
  std::vector<std::size_t> back(strips, 0);  // 0: not divided
  for (std::size_t i = strips; i < surfaces_.size(); ++i)
    back[static_cast<std::size_t>(surfaces_[i].strip)] = i;
  std::vector<std::pair<std::size_t, std::size_t>> found;
  const auto add = [&](std::size_t a, std::size_t b) {
    if (!surfaces_[a].biased.empty() && !surfaces_[b].biased.empty())
      found.insert(found.end(), {{a, b}, {b, a}});
  };
  for (const auto& [first, second] : pairs) {
    const auto a = static_cast<std::size_t>(first), b = static_cast<std::size_t>(second);
    add(a, b);
    if (back[a] != 0) add(back[a], b);
    if (back[b] != 0) add(a, back[b]);
    if (back[a] != 0 && back[b] != 0) add(back[a], back[b]);
  }
  std::set<int> paired;
  for (const auto& [first, second] : pairs) paired.insert({first, second});
  for (const int strip : paired) {
    const auto index = static_cast<std::size_t>(strip);
    if (back[index] != 0 && !surfaces_[index].held()) add(index, back[index]);
  }
  return found;
}

struct AreaMatcher::Matching {
  using Geometry = std::tuple<const Trajectory&, const NoiseModel&, const ErrorSourceScale*>;
  Matching(const DistanceLimits& distances, Points which, std::size_t step,
           const std::vector<std::size_t>& points, const Geometry& geometry)
      : limits(distances),
        chosen(which),
        every(step),
        shares(points),
        point(std::make_from_tuple<PointGeometry>(geometry)),
        foot(std::make_from_tuple<PointGeometry>(geometry)),
        vertex(std::make_from_tuple<PointGeometry>(geometry)) {}

  DistanceLimits limits;
  Points chosen;
  std::size_t every;
  NoiseShares shares;
  PointGeometry point, foot, vertex;
};

void AreaMatcher::matchSurfaces(Matching& matching, std::size_t a, std::size_t b,
                                PairsByDistance& found) const {
  const StripPart &from = surfaces_[a], &to = surfaces_[b];
  PairObservation observation;
  observation.a = from.strip, observation.half_a = from.half;
  observation.b = to.strip, observation.half_b = to.half;
  const bool all = matching.chosen == Points::candidates;
  const auto kept = kept_.find({observation.surfaceA(), observation.surfaceB()});
  if (!all && kept == kept_.end()) return;
  const SurfaceCriterion criterion = criterionOf(to);
  const std::size_t count = all ? from.candidates.size() : kept->second.size();
  for (std::size_t c = 0; c < count; c += all ? matching.every : 1) {
    const std::int32_t i = all ? from.candidates[c] : kept->second[c].point;
    const auto match = to.surface.closest(from.surface.tin().points()[i], matching.limits.far);
    if (!match) continue;
    const auto quality = to.surface.suitable(match->triangle, criterion, to.median_edge);
    if (!quality || !matching.point.atPoint(from, i, *quality) ||
        !matching.foot.atFoot(to, *match, *quality, matching.vertex))
      continue;
    observation.point = i;
    measure(matching.point, matching.foot, measuringDirection(to, match->triangle, *quality),
            observation);
    if (std::abs(match->signed_normal_distance) > matching.limits.near) {
      found.far.push_back(observation);
      continue;
    }
    matching.shares.add(a, i, b, to.surface.tin().triangles()[match->triangle], match->weights,
                        normalVariance(matching.point.covariance, observation.normal),
                        normalVariance(matching.vertex.covariance, observation.normal));
    if (!all) {
      observation.variance_inflation = kept->second[c].variance_inflation;
      observation.offset = kept->second[c].offset;
      observation.misclosure += observation.offset;
    }
    found.near.push_back(observation);
  }
}

AreaMatcher::PairsByDistance AreaMatcher::matchByDistance(const std::vector<StripPair>& pairs,
                                                          const DistanceLimits& limits,
                                                          const Trajectory& trajectory,
                                                          const NoiseModel& noise, Points chosen,
                                                          std::size_t every) const {
  PairsByDistance found;
  std::vector<std::size_t> points;
  for (const StripPart& part : surfaces_) points.push_back(part.biased.size());
  Matching matching(limits, chosen, every, points,
                    {trajectory, noise, source_scale_ ? &*source_scale_ : nullptr});
  for (const auto& [a, b] : surfacePairs(pairs)) matchSurfaces(matching, a, b, found);
  if (chosen == Points::candidates) matching.shares.setSharing(found.near);
  found.near.shrink_to_fit();
  found.far.shrink_to_fit();
  return found;
}

}  // namespace pcl_als
