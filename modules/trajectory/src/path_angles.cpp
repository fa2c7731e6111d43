// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <map>

#include <pcl_als/adjustment/robust_weight.h>

#include "path_adjustment.h"
#include "path_constants.h"

namespace pcl_als::detail {
namespace {

constexpr double kFewestOfClass = 3.0;  // points of a class and of its neighbours
constexpr double kNadir = 0.36;         // tangent of angles that show the place along the course

Eigen::Vector2d rightOf(const Eigen::Vector2d& course) {
  return {course.y(), -course.x()};
}

}  // namespace

/// Classes between two others only: the outermost ones are not complete, and so their mean angle
/// is not that of their points where angles are rounded.
void PathAdjustment::takeAngles() {
  if (evidence_.counts().angles == 0) return;
  forBins([this](std::int64_t index, const PathEvidence::Bin& bin) {
    for (std::size_t i = 1; i + 1 < bin.angles.size(); ++i) {
      const ScanAngleSums &low = bin.angles[i - 1], &sums = bin.angles[i],
                          &high = bin.angles[i + 1];
      if (low.index + 1 != sums.index || high.index != sums.index + 1) continue;
      if (std::min({low.n, sums.n, high.n}) < kFewestOfClass) continue;
      AdjustedAngle& angle = angles_.emplace_back();
      angle.time = static_cast<double>(index) * PathEvidence::kBin + sums.time / sums.n;
      angle.at = spline_.at(angle.time);
      angle.bin = index;
      angle.index = sums.index;
      angle.mean = sums.position / sums.n;
      angle.tangent = sums.tangent / sums.n;
      angle.tangent_z = sums.tangent_z / sums.n;
    }
    addToMiddle(index, bin);
  });
  finishMiddles();
}

/// All classes of the bins of a second, where they reach the vertical: in a shorter time, patterns
/// such as those of a rosette are not covered evenly. Of a short pass those of a quarter, because
/// its speed is that between the middles.
void PathAdjustment::addToMiddle(std::int64_t index, const PathEvidence::Bin& bin) {
  const double time = std::min(kMiddleTime, 0.25 * (span_.last - span_.first));
  const auto bins =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(time / PathEvidence::kBin)));
  const auto window =
      static_cast<std::int64_t>(std::floor(static_cast<double>(index) / static_cast<double>(bins)));
  if (middles_.empty() || middles_.back().window != window) {
    middles_.emplace_back();
    middles_.back().window = window;
  }
  AdjustedMiddle& middle = middles_.back();
  for (const ScanAngleSums& sums : bin.angles) {
    middle.points += sums.n;
    middle.time += sums.time + sums.n * static_cast<double>(index) * PathEvidence::kBin;
    middle.mean += sums.position;
    middle.covariance += sums.plan_z;
    middle.tangent += sums.tangent;
    middle.nadir = middle.nadir || std::abs(sums.tangent) < kNadir * sums.n;
  }
}

/// Means from sums.
void PathAdjustment::finishMiddles() {
  middles_.erase(std::remove_if(middles_.begin(), middles_.end(),
                                [](const AdjustedMiddle& middle) {
                                  return !middle.nadir || middle.points < kFewestOfClass;
                                }),
                 middles_.end());
  for (AdjustedMiddle& middle : middles_) {
    const double n = middle.points;
    middle.at = spline_.at(middle.time / n);
    middle.mean /= n;
    middle.tangent /= n;
    middle.covariance = middle.covariance / n - middle.mean.z() * middle.mean.head<2>();
  }
}

/// Course from the movement of the points of one class; height, sign and the skew of the scan lines
/// (crab, or a scanner turned in its mount) from the positions of the classes of one time.
bool PathAdjustment::startFromAngles() {
  struct Means {
    double n = 0.0, time = 0.0, tangent = 0.0;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
  };
  const auto meansBy = [this](const auto& key) {
    std::map<std::int64_t, Means> means;
    for (const AdjustedAngle& angle : angles_) {
      Means& m = means[key(angle)];
      m.n += 1.0;
      m.time += (angle.time - m.time) / m.n;
      m.tangent += (angle.tangent - m.tangent) / m.n;
      m.place += (angle.mean.head<2>() - m.place) / m.n;
    }
    return means;
  };
  const auto ofClass = [](const AdjustedAngle& a) { return static_cast<std::int64_t>(a.index); };
  const auto ofBin = [](const AdjustedAngle& a) { return a.bin; };
  const auto classes = meansBy(ofClass), bins = meansBy(ofBin);
  Eigen::Vector2d moved = Eigen::Vector2d::Zero();
  double times = 0.0;
  for (const AdjustedAngle& angle : angles_) {
    const Means& m = classes.at(ofClass(angle));
    moved += (angle.time - m.time) * (angle.mean.head<2>() - m.place);
    times += (angle.time - m.time) * (angle.time - m.time);
  }
  if (!(times > 0.0) || !(moved.norm() > kSlowest * times)) return false;
  start_course_ = moved.normalized();
  const double speed = moved.norm() / times;
  double slope = 0.0, tangents = 0.0, skewed = 0.0, across = 0.0;
  for (const AdjustedAngle& angle : angles_) {
    const Means& m = bins.at(angle.bin);
    const Eigen::Vector2d offset = angle.mean.head<2>() - m.place;
    const double lateral = rightOf(start_course_).dot(offset);
    slope += (angle.tangent - m.tangent) * lateral;
    tangents += (angle.tangent - m.tangent) * (angle.tangent - m.tangent);
    skewed += lateral * (start_course_.dot(offset) - speed * (angle.time - m.time));
    across += lateral * lateral;
  }
  if (!(tangents > 0.0) || !(across > 0.0)) return false;
  skew_ = skewed / across;
  start_height_ = std::abs(slope) / (tangents * std::cos(std::atan(skew_)));
  sign_ = slope > 0.0 ? 1.0 : -1.0;
  return start_height_ > 1.0;
}

/// Height from recorded angles over that of the path: slope of the lateral distance over the height
/// against the tangent; negative where angles are positive to the left.
double PathAdjustment::angleSlope() const {
  double product = 0.0, square = 0.0, n = 0.0, x = 0.0, y = 0.0;
  for (const AdjustedAngle& angle : angles_) {
    const Eigen::Vector3d from = angle.mean - valueAt(angle.at);
    if (!(from.z() < 0.0)) continue;
    const double seen = rightOf(courseAt(angle.at)).dot(from.head<2>()) / -from.z();
    n += 1.0;
    x += angle.tangent;
    y += seen;
    product += angle.tangent * seen;
    square += angle.tangent * angle.tangent;
  }
  const double spread = square - x * x / std::max(n, 1.0);
  return spread > 0.0 ? (product - x * y / n) / spread : 0.0;
}

Eigen::Vector2d PathAdjustment::courseAt(const UniformCubicSpline::Weights& at) const {
  if (!solved_) return start_course_;
  const Eigen::Vector2d velocity = valueAt(at, true).head<2>();
  return velocity.norm() > kSlowest ? velocity.normalized() : start_course_;
}

double PathAdjustment::heightOver(const UniformCubicSpline::Weights& at, double ground) const {
  constexpr double kLowest = 5.0;
  if (!solved_) return start_height_;
  return std::max(kLowest, valueAt(at).z() - ground);
}

/// Recorded angles are those in the scan plane, whose tangent across the course is smaller.
void PathAdjustment::allowForSkew() {
  const double cosine = std::cos(std::atan(skew_));
  for (AdjustedAngle& angle : angles_) {
    angle.tangent *= cosine;
    angle.tangent_z *= cosine;
  }
  scale_ = std::hypot(kScale, kSkewShare * (1.0 - cosine));
}

/// right . (mean - X) = sign (Z T - mean(z T)) (1 + scale)
///                      + h (1 + T^2) (offset + roll + truncation sign(T)).
PathAdjustment::AngleRow PathAdjustment::rowOf(const AdjustedAngle& angle) const {
  const Eigen::Vector2d right = rightOf(courseAt(angle.at));
  const double height = heightOver(angle.at, angle.mean.z()), tangent = angle.tangent;
  const double turned = height * (1.0 + tangent * tangent);
  AngleRow row;
  row.setPath({right.x(), right.y(), sign_ * tangent}, turned, 0.0);
  row.common << sign_ * tangent * height, turned, turned * (tangent > 0.0 ? 1.0 : -1.0), 0.0;
  row.value = right.dot(angle.mean.head<2>()) + sign_ * angle.tangent_z;
  row.metres_per_radian = turned;
  return row;
}

/// The middle of the swath lies ahead of the sensor by the height times the tangent of the pitch,
/// and a place beside it along the scan lines. Where the ground rises ahead, pulses that look ahead
/// meet it sooner: the mean of their tangents is that of (y - Y) / (Z - z), to first order in z.
PathAdjustment::AngleRow PathAdjustment::rowOf(const AdjustedMiddle& middle) const {
  const Eigen::Vector2d course = courseAt(middle.at);
  AngleRow row;
  row.metres_per_radian = heightOver(middle.at, middle.mean.z());
  row.setPath({course.x(), course.y(), 0.0}, 0.0, row.metres_per_radian);
  row.common << 0.0, 0.0, 0.0, row.metres_per_radian;
  row.value = course.dot(middle.mean.head<2>() + middle.covariance / row.metres_per_radian) -
              skew_ * sign_ * middle.tangent * row.metres_per_radian;
  return row;
}

void PathAdjustment::addAngles() {
  const auto add = [this](const auto& angle, double variance) {
    if (!(angle.weight > 0.0)) return;
    const AngleRow row = rowOf(angle);
    addObservation(angle.at, row.path, row.common, row.value,
                   angle.weight / (variance * row.metres_per_radian * row.metres_per_radian));
  };
  for (const AdjustedAngle& angle : angles_) add(angle, noise_);
  for (const AdjustedMiddle& middle : middles_) add(middle, along_);
}

/// Radians.
template <typename Angle>
double PathAdjustment::residualOf(const Angle& angle, const AngleRow& row) const {
  const double of_path = row.path.head<3>().dot(valueAt(angle.at)) +
                         row.path[kRollOf] * angleAt(angle.at, kRollOf) +
                         row.path[kPitchOf] * angleAt(angle.at, kPitchOf);
  return (of_path + row.common.dot(common_) - row.value) / row.metres_per_radian;
}

void PathAdjustment::weighAngles() {
  const auto weigh = [this](auto& angle, double variance) {
    angle.residual = residualOf(angle, rowOf(angle));
    angle.weight = RobustWeight()(angle.residual, std::sqrt(variance));
  };
  for (AdjustedAngle& angle : angles_) weigh(angle, noise_);
  for (AdjustedMiddle& middle : middles_) weigh(middle, along_);
}

void PathAdjustment::updateAngleVariances() {
  const auto varianceOf = [](const auto& angles, double otherwise) {
    double squares = 0.0, weights = 0.0;
    for (const auto& angle : angles) {
      squares += angle.weight * angle.residual * angle.residual;
      weights += angle.weight;
    }
    constexpr double kLeast = kLeastAngleNoise * kLeastAngleNoise;
    return weights > 0.0 ? std::max(squares / weights, kLeast) : otherwise;
  };
  noise_ = varianceOf(angles_, noise_);
  if (!rays_.empty()) along_ = varianceOf(middles_, along_);
}

}  // namespace pcl_als::detail
