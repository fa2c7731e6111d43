// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "synthetic_pairs.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/tin/orientation_classes.h>

#include "noise_model.h"

namespace pcl_als {
namespace {

constexpr int kGroundSamples = 16, kSteepSamples = 8;  // of an area
// radians: uniform aspects for any number of samples
constexpr double kGoldenAngle = 2.399963229728653;
constexpr double kAccepted = 0.9;  // share of candidates with a patch suitable for measurement
constexpr double kSpread = 1.8;  // extent of a neighbourhood of some nine points, in point spacings
constexpr double kFootShare = 0.5;  // mean sum of squares of the weights of a triangle's vertices

Eigen::Vector3d normalOf(double slope, double aspect) {
  return {std::sin(slope) * std::cos(aspect), std::sin(slope) * std::sin(aspect), std::cos(slope)};
}

/// A pseudo-random number in [0, 1) determined by a place.
double scatterOf(const Eigen::Vector2d& place) {
  const double value = std::sin(place.x() * 0.0129898 + place.y() * 0.078233) * 43758.5453;
  return value - std::floor(value);
}

double fraction(double value) {
  return value - std::floor(value);
}

}  // namespace

/// A surface element in an area, with its share of the usable surface.
struct SyntheticPairs::Sample {
  Eigen::Vector3d position;
  Eigen::Vector3d normal;
  double share = 0.0;
};

/// Expected number of pairs of the points of an area, and the noise that they share: the
/// expectation of NoiseShares.
class SyntheticPairs::Uses {
 public:
  /// \a candidates of a strip by sample, of \a points in the area.
  void add(std::vector<double> candidates, const std::vector<Sample>& samples, double points) {
    auto& all = points_.emplace_back();
    for (const Sample& sample : samples) all.push_back(points * sample.share);
    if (points > 0.0) {
      ++strips_;
      candidate_sum_.resize(samples.size(), 0.0);
      for (std::size_t k = 0; k < samples.size(); ++k) candidate_sum_[k] += candidates[k];
    }
    candidates_.push_back(std::move(candidates));
  }

  /// Equivalent number of independent pairs of points of strip \a a with patches of \a b in a
  /// sample.
  double worth(std::size_t a, std::size_t b, std::size_t sample) const {
    const double others = std::max(1.0, strips_ - 1.0);
    const double seeks =
        points_[b][sample] > 0.0 ? candidates_[b][sample] / points_[b][sample] : 0.0;
    const double point = others + asVertex(a, sample);
    const double patch = std::max(kFootShare, asVertex(b, sample) + others * seeks);
    return candidates_[a][sample] * (1.0 + kFootShare) / (point + patch);
  }

 private:
  /// Expected number of patches of other strips' pairs of which a point of a strip is a vertex.
  double asVertex(std::size_t strip, std::size_t sample) const {
    const double points = points_[strip][sample];
    return points > 0.0 ? (candidate_sum_[sample] - candidates_[strip][sample]) / points : 0.0;
  }

  std::vector<std::vector<double>> candidates_, points_;  ///< by strip and sample
  std::vector<double> candidate_sum_;                     ///< candidates of all strips with points
  double strips_ = 0.0;
};

Eigen::Vector2d SyntheticPairs::middleOf(const Eigen::Vector2d& corner) const {
  return corner + Eigen::Vector2d::Constant(0.5 * settings_.selection.area_size);
}

double SyntheticPairs::pointsIn(double density) const {
  const double side = settings_.selection.area_size;
  return settings_.surface.usable * side * side * density;
}

SurfacePoint SyntheticPairs::groundAt(const Eigen::Vector2d& place) const {
  if (!settings_.surface.terrain) return {};
  return settings_.surface.terrain(place).value_or(SurfacePoint());
}

std::vector<SyntheticPairs::Sample> SyntheticPairs::samplesOf(const Eigen::Vector2d& corner) const {
  const SurfaceModel& surface = settings_.surface;
  const double offset = scatterOf(corner);
  std::vector<Sample> samples;
  for (int i = 0; i < kGroundSamples + kSteepSamples; ++i) {
    const bool steep = i >= kGroundSamples;
    const int of_kind = steep ? i - kGroundSamples : i;
    const int kinds = steep ? kSteepSamples : kGroundSamples;
    const double quantile = (of_kind + 0.5) / kinds;
    // Slopes of natural ground follow a Rayleigh distribution, those of roofs a band.
    const double slope = steep ? surface.steep_slope * (0.75 + 0.5 * quantile)
                               : surface.ground_slope * std::sqrt(-std::log(1.0 - quantile));
    Sample sample;
    sample.share = (steep ? surface.steep_share : 1.0 - surface.steep_share) / kinds;
    if (sample.share <= 0.0) continue;
    const Eigen::Vector2d inside(fraction(offset + 0.7548776662466927 * i),
                                 fraction(offset + 0.5698402909980532 * i));
    const Eigen::Vector2d place = corner + settings_.selection.area_size * inside;
    const SurfacePoint ground = groundAt(place);
    sample.position = Eigen::Vector3d(place.x(), place.y(), ground.height);
    sample.normal = !steep && surface.terrain
                        ? ground.normal
                        : normalOf(slope, 2.0 * kPi * offset + kGoldenAngle * i);
    samples.push_back(sample);
  }
  return samples;
}

std::vector<double> SyntheticPairs::pairsPerSample(const std::vector<Sample>& samples,
                                                   double density, double candidates) const {
  const double points = pointsIn(density);
  std::vector<double> of_class(OrientationClasses::kCount, 0.0), pairs;
  for (const Sample& sample : samples)
    of_class[OrientationClasses::of(sample.normal)] += sample.share;
  std::vector<double> taken = of_class;
  for (double& share : taken) share *= points;
  if (settings_.surface.balanced) {
    taken = evenShares(taken, candidates);
  } else {
    for (double& count : taken) count *= std::min(1.0, candidates / points);
  }
  for (const Sample& sample : samples) {
    const std::size_t orientation = OrientationClasses::of(sample.normal);
    pairs.push_back(kAccepted * taken[orientation] * sample.share / of_class[orientation]);
  }
  return pairs;
}

bool SyntheticPairs::observe(const Sample& sample, const StripGeometry* a, const StripGeometry& b,
                             PairObservation& o) const {
  const Eigen::Vector2d place = sample.position.head<2>();
  const double tilt_noise = kSignificantTilt *
                            std::hypot(settings_.noise.range, settings_.noise.position) *
                            std::sqrt(b.density) / kSpread;
  const double tilt = std::hypot(sample.normal.x(), sample.normal.y());
  o.normal = tilt < tilt_noise ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : sample.normal;
  double variance = 0.0;
  ErrorSourceRow sources = ErrorSourceRow::Zero();
  for (const StripGeometry* strip : {a, &b}) {
    if (strip == nullptr) continue;
    const double along = strip->along(place);
    const ScanGeometry g = scanGeometry(strip->poseAbeam(place), sample.position);
    if (!(along >= 0.0 && along <= strip->length() && std::abs(g.beta) <= strip->half_angle)) {
      return false;
    }
    const bool patch = strip == &b;
    (patch ? o.row_b : o.row_a) = (o.normal.transpose() * designBlock(g)).cast<float>();
    (patch ? o.time_b : o.time_a) = strip->timeAbeam(place);
    variance +=
        (patch ? kFootShare : 1.0) * normalVariance(settings_.noise.pointCovariance(g), o.normal);
    const double sign = patch ? -1.0 : 1.0;
    sources[indexOf(ErrorSource::slope_ranging)] +=
        sign * stretchEffect(g.range(), g.beam(), o.normal, settings_.noise.beam_divergence);
    sources[indexOf(ErrorSource::range_scale)] += sign * g.range() * o.normal.dot(g.beam());
    o.lateral = static_cast<float>(std::abs(g.x));
    o.height = static_cast<float>(std::abs(g.z));
  }
  o.variance = static_cast<float>(variance);
  o.sources = sources.cast<float>();
  return true;
}

void SyntheticPairs::addArea(const Eigen::Vector2d& corner, int first, double candidates,
                             ObservedBlock& block) const {
  const std::vector<Sample> samples = samplesOf(corner);
  Uses uses;
  for (const StripGeometry& strip : block.strips) {
    uses.add(pairsPerSample(samples, strip.density, candidates), samples,
             strip.covers(middleOf(corner)) ? pointsIn(strip.density) : 0.0);
  }
  AreaObservations observations;
  std::vector<double> weights;
  for (int b = first; b < static_cast<int>(block.strips.size()); ++b) {
    for (int a = 0; a < b; ++a) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        PairObservation o;
        o.a = a;
        o.b = b;
        if (!observe(samples[k], &block.strips[i], block.strips[j], o)) continue;
        observations.push_back(o);
        // Points of each are paired with patches of the other.
        weights.push_back(uses.worth(i, j, k) + uses.worth(j, i, k));
      }
    }
  }
  block.observations.push_back(std::move(observations));
  block.weights.push_back(std::move(weights));
}

void SyntheticPairs::addPairs(int first, ObservedBlock& block) const {
  const Places corners = chooseAreas(first, block);
  double strips_in_areas = 1.0, pairs_in_areas = 0.0;
  for (const Eigen::Vector2d& corner : corners) {
    const auto count = static_cast<double>(
        std::count_if(block.strips.begin(), block.strips.end(),
                      [&](const StripGeometry& strip) { return strip.covers(middleOf(corner)); }));
    strips_in_areas += count;
    pairs_in_areas += count * std::max(0.0, count - 1.0);
  }
  const double candidates = candidatesPerStrip(static_cast<double>(settings_.candidates),
                                               strips_in_areas, pairs_in_areas);
  for (const Eigen::Vector2d& corner : corners) addArea(corner, first, candidates, block);
}

bool SyntheticPairs::addControl(const Eigen::Vector2d& place, ObservedBlock& block) const {
  const SurfacePoint ground = groundAt(place);
  const Sample sample{{place.x(), place.y(), ground.height}, Eigen::Vector3d::UnitZ(), 1.0};
  AreaObservations observations;
  for (std::size_t b = 0; b < block.strips.size(); ++b) {
    PairObservation o;
    o.b = static_cast<int>(b);
    if (!observe(sample, nullptr, block.strips[b], o)) continue;
    o.variance += static_cast<float>(settings_.control_sigma * settings_.control_sigma);
    observations.push_back(o);
  }
  if (observations.empty()) return false;
  block.weights.emplace_back(observations.size(), 1.0);
  block.observations.push_back(std::move(observations));
  ++block.control_points;
  return true;
}

int SyntheticPairs::addStrip(StripGeometry strip, ObservedBlock& block) {
  // seconds between strips, whose errors are independent in any case
  constexpr double kPause = 1000.0;
  double last = 0.0;
  for (const auto& span : block.spans) last = std::max(last, span.second);
  strip.first_time = last + kPause;
  block.spans.emplace_back(strip.first_time, strip.first_time + strip.duration());
  block.strips.push_back(std::move(strip));
  return static_cast<int>(block.strips.size()) - 1;
}

}  // namespace pcl_als
