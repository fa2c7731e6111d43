// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/trajectory/source_effect.h>

#include "area_matcher.h"
#include "pair_observation.h"

namespace pcl_als {

/// Design block and covariance of one point of a strip, or of the interpolated foot in a patch.
class AreaMatcher::PointGeometry {
 public:
  /// \param scale null: sources are not considered
  PointGeometry(const Trajectory& trajectory, const NoiseModel& noise,
                const ErrorSourceScale* scale)
      : trajectory_(trajectory), noise_(noise), effects_(trajectory), scale_(scale) {}

  bool atPoint(const StripPart& part, std::int32_t index, const PatchQuality& surface) {
    const auto i = static_cast<std::size_t>(index);
    return at(part, {part.times[i], part.intensity[i], static_cast<float>(part.scan_direction[i])},
              part.surface.tin().points()[i], part.echoVariance(i), surface);
  }

  /// The foot of a point in a patch. \param vertex gets the covariances of one point of the strip
  /// there.
  bool atFoot(const StripPart& part, const PatchMatch& match, const PatchQuality& surface,
              PointGeometry& vertex) {
    const auto& triangle = part.surface.tin().triangles()[match.triangle].vertex;
    if (part.flown && isMixed(part.times, triangle))
      return atVertices(part, match, surface, vertex);
    // All quantities are linear in position and time within a patch.
    SourceReading mean{0.0, 0.0F, 0.0F};
    Eigen::Vector3d foot = Eigen::Vector3d::Zero();
    double echoes = 0.0;         // variance of the interpolated range, m^2
    double log_intensity = 0.0;  // to which the effect of the intensity is proportional
    for (int i = 0; i < 3; ++i) {
      const auto v = static_cast<std::size_t>(triangle[i]);
      const double weight = match.weights[i];
      mean.time += weight * part.times[v];
      mean.scan_direction +=
          static_cast<float>(weight) * static_cast<float>(part.scan_direction[v]);
      if (scale_ != nullptr)
        log_intensity += weight * SourceEffect::logIntensity(part.intensity[v], *scale_);
      foot += weight * part.surface.tin().points()[v];
      echoes += weight * weight * part.echoVariance(v);
    }
    if (scale_ != nullptr)
      mean.intensity = static_cast<float>(scale_->median_intensity * std::exp(log_intensity));
    const double squares = match.weights.squaredNorm();
    if (!at(part, mean, foot, echoes / squares, surface)) return false;
    vertex.covariance = covariance;
    vertex.pointing = pointing;
    covariance *= squares;
    pointing *= squares;
    echo = echoes;
    return true;
  }

  bool held = false;  ///< of a strip that is held fixed: no parameter has an effect on the point
  double time = 0.0;
  Eigen::Vector3d position;  ///< corrected
  DesignBlock design;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();  ///< of the boresight angles, where held
  SourceEffects sources;                           ///< except slope_ranging
  Eigen::Matrix3d covariance, pointing;            ///< pointing: its part of the covariance
  double echo = 0.0;  ///< variance of the range that echoes state: its part of the covariance, m^2
  Eigen::Vector3d beam;                             ///< unit, downward
  double range = 0.0, lateral = 0.0, height = 0.0;  ///< metres

  /// A vertex of the patch of a foot.
  struct AtVertex {
    double time = 0.0, weight = 0.0;
    Eigen::Matrix3d turn;  ///< turnOfAttitude()
  };
  bool mixed = false;                ///< whether a foot's vertices are of different times
  std::array<AtVertex, 3> vertices;  ///< where they are

  /// Effect of errors of pitch, roll and heading.
  Eigen::Matrix3d turnOfAttitude() const {
    return design.middleCols<3>(indexOf(SystemParameter::boresight_pitch)) + turn;
  }

  /// Part of the variance along the normal of a surface that echoes state, m^2.
  double echoAlong(const Eigen::Vector3d& normal) const {
    const double cosine = normal.dot(beam);
    return echo * cosine * cosine;
  }

  /// Effects of the error sources along the normal of a surface, metres.
  ErrorSourceRow sourcesAlong(const Eigen::Vector3d& normal) const {
    ErrorSourceRow row = normal.transpose() * sources;
    row[indexOf(ErrorSource::slope_ranging)] =
        stretchEffect(range, beam, normal, noise_.beam_divergence);
    return row;
  }

 private:
  bool at(const StripPart& part, const SourceReading& reading, const Eigen::Vector3d& place,
          double echo_variance, const PatchQuality& surface) {
    time = reading.time;
    position = place;
    held = part.held();
    mixed = false;
    turn.setZero();
    if (held) return atHeldPoint(part, surface);
    if (!trajectory_.poseAt(time, pose_, cursor_)) return false;
    const ScanGeometry geometry = scanGeometry(pose_, alongBeam(position, surface));
    design = designBlock(geometry);
    covariance = noise_.pointCovariance(geometry);
    covariance.diagonal() += part.rounding;
    pointing = noise_.pointingCovariance(geometry);
    beam = geometry.beam();
    echo = echo_variance;
    if (echo > 0.0) covariance += echo * beam * beam.transpose();
    range = geometry.range();
    lateral = std::abs(geometry.x);
    height = std::abs(geometry.z);
    sources.setZero();
    sources.col(indexOf(ErrorSource::range_scale)) = range * beam;
    SourceEffect::addOffsets(sources);
    if (scale_ != nullptr) effects_.add(reading, pose_, geometry, *scale_, sources);
    return true;
  }

  bool atVertices(const StripPart& part, const PatchMatch& match, const PatchQuality& surface,
                  PointGeometry& vertex) {
    time = 0.0;
    position.setZero();
    design.setZero();
    turn.setZero();
    sources.setZero();
    covariance.setZero();
    pointing.setZero();
    echo = 0.0;
    for (int i = 0; i < 3; ++i) {
      if (!vertex.atPoint(part, part.surface.tin().triangles()[match.triangle].vertex[i], surface))
        return false;
      const double weight = match.weights[i];
      vertices[static_cast<std::size_t>(i)] = {vertex.time, weight, vertex.turnOfAttitude()};
      time += weight * vertex.time;
      position += weight * vertex.position;
      design += weight * vertex.design;
      turn += weight * vertex.turn;
      sources += weight * vertex.sources;
      covariance += weight * weight * vertex.covariance;
      pointing += weight * weight * vertex.pointing;
      echo += weight * weight * vertex.echo;
    }
    mixed = true;
    held = vertex.held;
    beam = vertex.beam;
    range = vertex.range;
    lateral = vertex.lateral;
    height = vertex.height;
    return true;
  }

  bool atHeldPoint(const StripPart& part, const PatchQuality& surface) {
    design.setZero();
    sources.setZero();
    covariance = part.held_std * part.held_std * Eigen::Matrix3d::Identity();
    if (part.flown && trajectory_.poseAt(time, pose_, cursor_)) {
      const ScanGeometry geometry = scanGeometry(pose_, alongBeam(position, surface));
      turn = designBlock(geometry).middleCols<3>(indexOf(SystemParameter::boresight_pitch));
    }
    pointing.setZero();
    echo = 0.0;
    beam = -Eigen::Vector3d::UnitZ();
    range = lateral = height = 0.0;
    return true;
  }

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

}  // namespace pcl_als
