// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/scanner_detection.h>

#include "plane_pair.h"

namespace pcl_als {
namespace {

constexpr double kFewestPulses = 1000.0;
/// Radians, RMS of unit vectors about their plane: errors of attitude and boresight.
constexpr double kOffCone = 0.3 * kRadiansPerDegree;
/// Distance of that plane from the origin below which the cone is a plane: 3 degrees.
constexpr double kThroughOrigin = 0.052;
/// Cosine of the largest angle between the vertical and the axis of a conical scanner.
constexpr double kUpright = 0.87;
/// Between planes of channels that differ by their mounting.
constexpr double kTurned = 2.0 * kRadiansPerDegree;
/// Share of steps in the less frequent direction: of a mirror that oscillates almost a half.
constexpr double kBothWays = 0.25;
/// Rosette: narrower over wider extent of the disc, and least share of the pulses within
/// kCentre of its radius (of an even disc 2.3 %, of a rosette 9.6 %, of cones and planes that look
/// ahead none).
constexpr double kRound = 0.6, kCentre = 0.15, kCentral = 0.04;
constexpr double kHalfDegree = 0.5 * kRadiansPerDegree;

Eigen::Vector3d forwardOf(const Eigen::Vector3d& normal) {
  return normal.y() < 0.0 ? Eigen::Vector3d(-normal) : normal;
}

/// The plane m . e = d of unit vectors e, d >= 0.
struct ConeFit {
  Eigen::Vector3d axis;
  double distance = 0.0, off = 0.0;
  double round = 0.0;  ///< narrower over wider extent in plan

  /// The axis of a plane through the origin has no sign: that which is forward.
  Eigen::Vector3d forward() const { return forwardOf(axis); }
};

ConeFit fitCone(const ScannerDetection::Channel& channel) {
  const Eigen::Vector3d mean = channel.sum / channel.pulses;
  const Eigen::Matrix3d covariance = channel.products / channel.pulses - mean * mean.transpose();
  const SymmetricEigen<Eigen::Dynamic> eigen = symmetricEigen(covariance);
  ConeFit fit;
  fit.axis = eigen.vectors.col(0);
  if (fit.axis.dot(mean) < 0.0) fit.axis = -fit.axis;
  fit.distance = fit.axis.dot(mean);
  fit.off = std::sqrt(std::max(0.0, eigen.values[0]));
  const Eigen::Vector2d plan = symmetricEigenvalues2(covariance.topLeftCorner<2, 2>());
  fit.round = std::sqrt(std::max(0.0, plan[0]) / std::max(1e-12, plan[1]));
  return fit;
}

/// Angle from the vertical that a share of the pulses does not exceed, radians.
double angleOf(const ScannerDetection::Channel& channel, double share) {
  double count = 0.0;
  std::size_t bin = 0;
  while (bin + 1 < channel.from_axis.size() &&
         (count += channel.from_axis[bin]) < share * channel.pulses)
    ++bin;
  return kHalfDegree * static_cast<double>(bin + 1);
}

bool isRosette(const ScannerDetection::Channel& channel, const ConeFit& fit) {
  if (fit.round < kRound) return false;
  const auto centre = static_cast<std::size_t>(kCentre * angleOf(channel, 0.99) / kHalfDegree);
  double within = 0.0;
  for (std::size_t bin = 0; bin < centre; ++bin) within += channel.from_axis[bin];
  return within > kCentral * channel.pulses;
}

ScannerPattern lineOf(const ScannerDetection::Channel& channel) {
  if (channel.steps < kFewestPulses / 2) return ScannerPattern::linear;
  const double right = channel.steps_to_right / channel.steps;
  return std::min(right, 1.0 - right) > kBothWays ? ScannerPattern::oscillating
                                                  : ScannerPattern::polygon;
}

/// How far values spread, radians.
double spread(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low;
}

/// How far the normals of planes spread: ahead of the vertical plane across the flight, and turned
/// about the vertical; radians.
struct PlaneSpread {
  double ahead, turned;

  explicit PlaneSpread(const std::vector<Eigen::Vector3d>& normals) {
    std::vector<double> elevations, azimuths;
    for (const Eigen::Vector3d& normal : normals) {
      elevations.push_back(std::asin(normal.z()));
      azimuths.push_back(std::atan2(normal.x(), normal.y()));
    }
    ahead = spread(elevations);
    turned = spread(azimuths);
  }
  double largest() const { return std::max(ahead, turned); }
  ScannerPattern pattern() const {
    return ahead > turned ? ScannerPattern::dual_look : ScannerPattern::crossed;
  }
};

}  // namespace

std::string_view nameOf(ScannerPattern pattern) {
  constexpr std::array<std::string_view, 10> kNames = {
      "undetermined", "oscillating", "polygon", "linear",        "conical",
      "rosette",      "dual_look",   "crossed", "multi_channel", "irregular"};
  return kNames[static_cast<std::size_t>(pattern)];
}

std::string DetectedScanner::text() const {
  const double degrees = angle / kRadiansPerDegree;
  char figures[100] = "";
  if (pattern == ScannerPattern::conical)
    std::snprintf(figures, sizeof figures, ", %.1f degrees from the vertical", degrees);
  if (pattern == ScannerPattern::rosette)
    std::snprintf(figures, sizeof figures, ", to %.1f degrees from the vertical", degrees);
  if (pattern == ScannerPattern::dual_look || pattern == ScannerPattern::crossed)
    std::snprintf(figures, sizeof figures, ", planes %.1f degrees apart", 2.0 * degrees);
  if (pattern == ScannerPattern::multi_channel)
    std::snprintf(figures, sizeof figures, ", %.1f degrees between the outermost beams", degrees);
  std::string name(nameOf(pattern));
  std::replace(name.begin(), name.end(), '_', ' ');
  return name + (channels > 1 ? ", " + std::to_string(channels) + " channels" : "") + figures;
}

ScannerDetection::ScannerDetection(std::shared_ptr<const Trajectory> flight)
    : flight_(std::move(flight)) {
  if (!flight_) throw UsageError("detection of the scanner: no trajectory is set");
  if (!flight_->hasAttitude()) recovery_.emplace(flight_);
}

void ScannerDetection::add(const LidarReturn& point) {
  if (point.return_number > 1) return;
  SensorPose pose;
  if (!flight_->poseAt(point.time, pose, cursor_)) return;
  const Eigen::Vector3d d = pose.rotation.transpose() * (point.position - pose.position);
  if (!d.allFinite() || !(d.z() < 0.0)) return;
  constexpr std::uint64_t kEvery = 10;  // suffices for the attitude
  if (recovery_ && added_++ % kEvery == 0) recovery_->add(point.time, point.position);
  const Eigen::Vector3d pulse = d.normalized();
  Channel& channel = channels_[point.channel];
  const double across = std::atan2(pulse.x(), -pulse.z());
  // A later pulse of the same stretch; flybacks are single steps.
  if (channel.pulses > 0.0 && point.time > channel.last_time &&
      point.time < channel.last_time + 0.1) {
    channel.steps += 1.0;
    if (across > channel.last_across) channel.steps_to_right += 1.0;
  }
  channel.last_time = point.time;
  channel.last_across = across;
  channel.pulses += 1.0;
  channel.sum += pulse;
  channel.products += pulse * pulse.transpose();
  if (!recovery_) {
    const Eigen::Matrix<double, 6, 1> monomials = quadraticMonomials(pulse);
    channel.quadratics.noalias() += monomials * monomials.transpose();
  }
  const double angle = std::atan2(std::hypot(pulse.x(), pulse.y()), -pulse.z());
  channel.from_axis[std::min(channel.from_axis.size() - 1,
                             static_cast<std::size_t>(angle / kHalfDegree))] += 1.0;
}

ScannerPattern ScannerDetection::patternOfOne(const Channel& channel, double& angle) const {
  const ConeFit fit = fitCone(channel);
  angle = std::acos(std::min(1.0, fit.distance));
  if (!recovery_ && fit.off < kOffCone) {
    if (fit.distance < kThroughOrigin) return lineOf(channel);
    if (std::abs(fit.axis.z()) > kUpright) return ScannerPattern::conical;
  }
  if (isRosette(channel, fit)) {
    angle = angleOf(channel, 0.999);
    return ScannerPattern::rosette;
  }
  if (!recovery_) {
    const auto pair = planePairOf(channel, kTurned, kOffCone);
    if (!pair) return ScannerPattern::irregular;
    const PlaneSpread planes({forwardOf(pair->front()), forwardOf(pair->back())});
    angle = 0.5 * planes.largest();
    return planes.pattern();
  }
  std::map<AttitudeRecovery::Verdict, double> points;
  double cone = 0.0;
  for (const AttitudeRecovery::Pass& pass : recovery_->assess().passes) {
    points[pass.verdict] += pass.points;
    if (pass.verdict == AttitudeRecovery::Verdict::conical) cone = pass.cone_angle;
  }
  if (points[AttitudeRecovery::Verdict::conical] > 0.5 * channel.pulses / 10.0) {
    angle = cone;
    return ScannerPattern::conical;
  }
  return points[AttitudeRecovery::Verdict::linear] > 0.0 ? lineOf(channel)
                                                         : ScannerPattern::irregular;
}

DetectedScanner ScannerDetection::assess() const {
  DetectedScanner found;
  std::vector<const Channel*> known;
  for (const auto& [number, channel] : channels_) {
    if (channel.pulses >= kFewestPulses) known.push_back(&channel);
  }
  if (known.empty()) return found;
  found.channels = static_cast<int>(known.size());
  found.pattern = patternOfOne(*known[0], found.angle);
  if (known.size() == 1) return found;
  std::vector<Eigen::Vector3d> normals;
  std::vector<double> cones;
  bool on_cones = true;
  for (const Channel* channel : known) {
    const ConeFit fit = fitCone(*channel);
    on_cones = on_cones && fit.off < kOffCone;
    normals.push_back(fit.forward());
    cones.push_back(std::asin(fit.axis.y() < 0.0 ? -fit.distance : fit.distance));
  }
  const PlaneSpread planes(normals);
  if (!on_cones) {
    found.pattern = known.size() > 2 ? ScannerPattern::multi_channel : ScannerPattern::irregular;
  } else if (spread(cones) > kTurned) {
    found.pattern = ScannerPattern::multi_channel;
    found.angle = spread(cones);
  } else if (planes.largest() > kTurned) {
    found.pattern = planes.pattern();
    found.angle = 0.5 * planes.largest();
  }
  return found;
}

void ScannerDetection::put(ByteWriter& out) const {
  out.putMap(channels_, [](ByteWriter& to, const Channel& channel) {
    to.put(channel.pulses).put(channel.sum).put(channel.products).put(channel.quadratics);
    to.put(channel.from_axis);
  });
}

void ScannerDetection::get(ByteReader& in) {
  channels_.clear();
  for (auto left = in.take<std::size_t>(); left > 0; --left) {
    Channel& channel = channels_[in.take<std::uint8_t>()];
    in.get(channel.pulses).get(channel.sum).get(channel.products).get(channel.quadratics);
    in.get(channel.from_axis);
  }
}

namespace {

/// The normals of the planes that contain the pulses of a channel, pointing forward.
std::vector<Eigen::Vector3d> planesOf(const ScannerDetection::Channel& channel) {
  const ConeFit fit = fitCone(channel);
  if (fit.off < kOffCone && fit.distance < kThroughOrigin) return {fit.forward()};
  // The pulses of a cone satisfy a quadratic form as well, but no pair of planes.
  if (const auto pair = planePairOf(channel, kTurned, kOffCone))
    return {forwardOf(pair->front()), forwardOf(pair->back())};
  return {};
}

/// Adds the normal of so many pulses to that of the same plane.
void addPlane(const Eigen::Vector3d& normal, double pulses, std::vector<Eigen::Vector3d>& sums) {
  const auto same = std::find_if(sums.begin(), sums.end(), [&](const Eigen::Vector3d& sum) {
    return sum.normalized().cross(normal).norm() < kTurned;
  });
  if (same == sums.end())
    sums.emplace_back(pulses * normal);
  else
    *same += pulses * normal;
}

}  // namespace

ScanPlanes scanPlanes(const std::vector<const ScannerDetection*>& strips) {
  constexpr double kFewestInPlane = 100.0, kOther = 0.1;  // pulses; share that is in no plane
  std::vector<Eigen::Vector3d> sums;
  double in_planes = 0.0, others = 0.0;
  for (const ScannerDetection* strip : strips) {
    for (const auto& [number, channel] : strip->channels()) {
      if (channel.pulses < kFewestInPlane) continue;
      const std::vector<Eigen::Vector3d> planes = planesOf(channel);
      (planes.empty() ? others : in_planes) += channel.pulses;
      for (const Eigen::Vector3d& normal : planes) addPlane(normal, channel.pulses, sums);
    }
  }
  if (sums.size() < 2 || others > kOther * in_planes) return {};
  for (Eigen::Vector3d& sum : sums) sum.normalize();
  return sums;
}

}  // namespace pcl_als
