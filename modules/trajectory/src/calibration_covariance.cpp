// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/calibration_covariance.h>

namespace pcl_als {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
constexpr double kNear =
    1.0;  // seconds: farther from a record the trajectory's accuracy is unknown

Vector6 stacked(const Eigen::Vector3d& position, const Eigen::Vector3d& angles) {
  Vector6 all;
  all << position, angles;
  return all;
}

/// Strips that were measured at the same time cannot be told apart by it: without corrections of
/// the strips they are treated as times that no strip covers.
std::optional<TrajectoryErrors> errorsOf(const CalibrationResult& calibration, bool needed) {
  try {
    return TrajectoryErrors(calibration.strip_errors);
  } catch (const InputError&) {
    if (needed) throw;
    return std::nullopt;
  }
}

}  // namespace

CalibrationCovariance::CalibrationCovariance(const CalibrationResult& calibration,
                                             const Options& options)
    : strip_corrections_(options.strip_corrections),
      accuracy_(options.accuracy),
      levels_(calibration.error_levels.value_or(ErrorLevels())),
      errors_(errorsOf(calibration, options.strip_corrections)),
      order_(calibration.correlation_order) {
  for (int i = 0; i < kSystemParameterCount; ++i) {
    const double std = calibration.parameters[static_cast<std::size_t>(i)].std;
    std_[i] = std::isfinite(std) ? std : 0.0;
  }
  parameters_ = std_.cwiseAbs2().asDiagonal();
  for (std::size_t a = 0; a < order_.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const double correlation =
          calibration.correlation(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
      const int i = indexOf(order_[a]), j = indexOf(order_[b]);
      if (std::isfinite(correlation))
        parameters_(i, j) = parameters_(j, i) = correlation * std_[i] * std_[j];
    }
  }
}

bool CalibrationCovariance::isKnown(double time) const {
  TrajectoryErrorKnot knot;
  return errors_ && errors_->at(time, knot) && knot.hasStd();
}

Vector6 CalibrationCovariance::priorStd(double time) const {
  const double position = levels_.trajectory_position, tilt = levels_.trajectory_roll_pitch;
  Vector6 std = stacked(Eigen::Vector3d::Constant(position),
                        Eigen::Vector3d(tilt, tilt, levels_.trajectory_heading));
  if (accuracy_.empty()) return std;
  const auto after =
      std::lower_bound(accuracy_.begin(), accuracy_.end(), time,
                       [](const TrajectoryErrorKnot& knot, double t) { return knot.time < t; });
  const auto before = after == accuracy_.begin() ? after : after - 1;
  const auto& near =
      after == accuracy_.end() || time - before->time < after->time - time ? *before : *after;
  if (std::abs(near.time - time) > kNear) return std;
  const Vector6 stated = stacked(near.position_std, near.angles_std);
  for (int i = 0; i < 6; ++i) {
    if (std::isfinite(stated[i])) std[i] = stated[i];
  }
  return std;
}

CalibrationCovariance::Matrix CalibrationCovariance::at(double time) const {
  constexpr int kErrors = kSystemParameterCount;  // first of them
  Matrix all = Matrix::Zero();
  all.topLeftCorner<kErrors, kErrors>() = parameters_;
  auto errors = all.block<6, 6>(kErrors, kErrors);
  TrajectoryErrorKnot knot;
  if (!errors_ || !errors_->at(time, knot) || !knot.hasStd()) {
    errors = priorStd(time).cwiseAbs2().asDiagonal();
    return all;
  }
  const Vector6 std = stacked(knot.position_std, knot.angles_std);
  errors = std.cwiseAbs2().asDiagonal();
  StripErrorCorrelation correlation;
  if (errors_->correlationAt(time, correlation)) {
    errors = std.asDiagonal() * correlation.errors * std.asDiagonal();
    for (std::size_t p = 0; p < order_.size(); ++p) {
      const int i = indexOf(order_[p]);
      const Vector6 column =
          std_[i] * std.cwiseProduct(correlation.parameters.col(static_cast<Eigen::Index>(p)));
      all.block<6, 1>(kErrors, i) = column;
      all.block<1, 6>(i, kErrors) = column.transpose();
    }
  }
  const Vector6 left = stacked(knot.position, knot.angles);
  if (!strip_corrections_) errors += left * left.transpose();
  return all;
}

}  // namespace pcl_als
