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
  std::vector<std::vector<std::int32_t>> classes(OrientationClasses::kCount);
  for (const std::int32_t triangle : chosenEvenly(rough, kExaminedPerCandidate * count)) {
    const PatchQuality quality = part.surface.quality(triangle);
    if (!criterion_.isSatisfiedBy(quality, part.median_edge)) continue;
    classes[OrientationClasses::of(quality.plane_normal)].push_back(
        part.surface.tin().triangles()[triangle].vertex[0]);
    if (quality.slope < kGentleSlope) part.roughness.push_back(quality.roughness);
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
    for (std::size_t i = 0; i < part.biased.size(); i += kEvery) {
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

/// Design block and covariance of one point of a strip, or of the interpolated foot in a patch.
class AreaMatcher::PointGeometry {
 public:
  /// \param scale null: sources are not considered
  PointGeometry(const Trajectory& trajectory, const NoiseModel& noise,
                const ErrorSourceScale* scale)
      : trajectory_(trajectory), noise_(noise), effects_(trajectory), scale_(scale) {}

  bool atPoint(const StripPart& part, std::int32_t index, const PatchQuality& surface) {
    time = part.times[index];
    position = part.surface.tin().points()[index];
    if (!trajectory_.poseAt(time, pose_, cursor_)) return false;
    const ScanGeometry geometry = scanGeometry(pose_, alongBeam(position, surface));
    design = designBlock(geometry);
    covariance = noise_.pointCovariance(geometry);
    pointing = noise_.pointingCovariance(geometry);
    beam = geometry.beam();
    range = geometry.range();
    lateral = std::abs(geometry.x);
    height = std::abs(geometry.z);
    sources.setZero();
    sources.col(indexOf(ErrorSource::range_scale)) = range * beam;
    if (scale_ != nullptr)
      effects_.add({time, part.intensity[index], part.turning[index]}, pose_, geometry, *scale_,
                   sources);
    return true;
  }

  bool atFoot(const StripPart& part, const PatchMatch& match, const PatchQuality& surface,
              PointGeometry& vertex) {
    time = 0.0;
    position.setZero();
    design.setZero();
    sources.setZero();
    covariance.setZero();
    pointing.setZero();
    for (int i = 0; i < 3; ++i) {
      if (!vertex.atPoint(part, part.surface.tin().triangles()[match.triangle].vertex[i], surface))
        return false;
      const double weight = match.weights[i];
      time += weight * vertex.time;
      position += weight * vertex.position;
      design += weight * vertex.design;
      sources += weight * vertex.sources;
      covariance += weight * weight * vertex.covariance;
      pointing += weight * weight * vertex.pointing;
    }
    beam = vertex.beam;
    range = vertex.range;
    lateral = vertex.lateral;
    height = vertex.height;
    return true;
  }

  double time = 0.0;
  Eigen::Vector3d position;  ///< corrected
  DesignBlock design;
  SourceEffects sources;                            ///< except slope_ranging
  Eigen::Matrix3d covariance, pointing;             ///< pointing: its part of the covariance
  Eigen::Vector3d beam;                             ///< unit, downward
  double range = 0.0, lateral = 0.0, height = 0.0;  ///< metres

  /// Effects of the error sources along the normal of a surface, metres.
  ErrorSourceRow sourcesAlong(const Eigen::Vector3d& normal) const {
    ErrorSourceRow row = normal.transpose() * sources;
    row[indexOf(ErrorSource::slope_ranging)] =
        stretchEffect(range, beam, normal, noise_.beam_divergence);
    return row;
  }

 private:
  /// Intersection of the pulse with the plane of the patch's neighbourhood (smoothed geometry). A
  /// measured range in the design matrix would be correlated with the noise of the distance: with a
  /// million pairs, errors in variables biased the range scale by 6 ppm.
  Eigen::Vector3d alongBeam(const Eigen::Vector3d& measured, const PatchQuality& surface) const {
    constexpr double kGrazing = 0.2;
    const Eigen::Vector3d towards = (measured - pose_.position).normalized();
    const double cosine = towards.dot(surface.plane_normal);
    if (std::abs(cosine) < kGrazing) return measured;
    return measured +
           (surface.plane_centre - measured).dot(surface.plane_normal) / cosine * towards;
  }

  const Trajectory& trajectory_;
  const NoiseModel& noise_;
  SourceEffect effects_;
  const ErrorSourceScale* scale_;
  SensorPose pose_;
  std::size_t cursor_ = 0;
};

void AreaMatcher::measure(const PointGeometry& point, const PointGeometry& foot,
                          const PatchQuality& quality, PairObservation& observation) const {
  observation.time_a = point.time;
  observation.time_b = foot.time;
  observation.lateral = foot.lateral;
  observation.height = foot.height;
  const Direction direction = measuringDirection(quality);
  const Eigen::Vector3d& normal = direction.normal;
  observation.normal = normal;
  observation.tilt_variance = direction.variance;
  observation.design = (point.design - foot.design).cast<float>();
  observation.row_a = normal.transpose() * point.design;
  observation.row_b = normal.transpose() * foot.design;
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
    const std::size_t count = all ? a.candidates.size() : kept->second.size();
    for (std::size_t c = 0; c < count; c += all ? every : 1) {
      const std::int32_t i = all ? a.candidates[c] : kept->second[c].point;
      const auto match = b.surface.closest(a.surface.tin().points()[i], threshold);
      if (!match) continue;
      const PatchQuality quality = b.surface.quality(match->triangle);
      if (!criterion_.isSatisfiedBy(quality, b.median_edge) || !point.atPoint(a, i, quality) ||
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
  return found;
}

namespace {

/// Sets the factor by which the pairs of one control point share the error of the point, in all
/// strips that cover it. The pairs are those of \a found from the index \a first on.
void shareControlError(double sigma, std::size_t first, AreaObservations& found) {
  double up = 0.0;
  for (std::size_t i = first; i < found.size(); ++i) up += found[i].normal.z();
  for (std::size_t i = first; i < found.size(); ++i) {
    PairObservation& o = found[i];
    const double others = o.normal.z() * (up - o.normal.z()) * sigma * sigma;
    o.sharing = 1.0 + others / o.variance;
  }
}

}  // namespace

AreaObservations AreaMatcher::matchControl(const std::vector<ControlPoint>& control,
                                           double threshold, const Trajectory& trajectory,
                                           const NoiseModel& noise, double default_sigma) const {
  AreaObservations found;
  const ErrorSourceScale* scale = source_scale_ ? &*source_scale_ : nullptr;
  PointGeometry foot(trajectory, noise, scale), vertex(trajectory, noise, scale);
  for (const ControlPoint& point : control) {
    if (!area_.contains(point.position)) continue;
    const double sigma = point.sigma > 0.0 ? point.sigma : default_sigma;
    const std::size_t first = found.size();
    for (std::size_t b = 0; b < strips_.size(); ++b) {
      if (strips_[b].biased.empty()) continue;
      const auto match = strips_[b].surface.vertical(point.position);
      if (!match || std::abs(match->signed_normal_distance) > threshold) continue;
      const PatchQuality quality = strips_[b].surface.quality(match->triangle);
      if (!criterion_.isSatisfiedBy(quality, strips_[b].median_edge) ||
          !foot.atFoot(strips_[b], *match, quality, vertex))
        continue;
      PairObservation observation;
      observation.b = static_cast<int>(b);
      observation.time_a = observation.time_b = foot.time;
      observation.lateral = foot.lateral;
      observation.height = foot.height;
      const Direction direction = measuringDirection(quality);
      observation.normal = direction.normal;
      observation.tilt_variance = direction.variance;
      observation.design = (-foot.design).cast<float>();
      observation.row_b = observation.normal.transpose() * foot.design;
      observation.misclosure = observation.normal.dot(point.position - foot.position) -
                               observation.effectAtPatch(corrected_for_[b]);
      observation.sources = -foot.sourcesAlong(observation.normal);
      const double up = observation.normal.z();
      observation.variance =
          normalVariance(foot.covariance, observation.normal) + up * up * sigma * sigma;
      observation.pointing = normalVariance(foot.pointing, observation.normal);
      found.push_back(observation);
    }
    shareControlError(sigma, first, found);
  }
  return found;
}

}  // namespace pcl_als
