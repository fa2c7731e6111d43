// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/point_uncertainty.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

/// Covariances of trajectory errors are those of the middle of a cell, seconds; cells are counted
/// from zero, so that the order of points changes no bit.
constexpr double kCell = 0.1;

double tangentOfIncidence(const Eigen::Vector3d& beam, const Eigen::Vector3d& normal) {
  if (!normal.allFinite()) return 0.0;
  const double cosine = std::min(1.0, std::abs(beam.dot(normal)));
  const double sine = std::sqrt(1.0 - cosine * cosine);
  return sine < PointUncertainty::kSteepest * cosine ? sine / cosine : PointUncertainty::kSteepest;
}

}  // namespace

PointUncertainty::PointUncertainty(const CalibrationResult& calibration,
                                   std::shared_ptr<const Trajectory> flight,
                                   const CalibrationCovariance::Options& options)
    : flight_(std::move(flight)), shared_(calibration, options) {
  if (!flight_) throw UsageError("uncertainty of points: no trajectory is set");
  for (const SystemEstimate& system : calibration.systems)
    differences_.push_back({system.difference_std.cwiseAbs2(), system.offset_std.cwiseAbs2()});
}

PointUncertainty::Sigma PointUncertainty::sigmaOf(const Eigen::Matrix3d& covariance) {
  return {std::sqrt(std::max(0.0, covariance(0, 0) + covariance(1, 1))),
          std::sqrt(std::max(0.0, covariance(2, 2)))};
}

bool PointUncertainty::covarianceAt(double time, const Eigen::Vector3d& point,
                                    const Eigen::Vector3d& normal, Cursor& cursor,
                                    Eigen::Matrix3d& covariance, std::size_t system,
                                    double range_std) const {
  SensorPose pose;
  if (!std::isfinite(time) || !flight_->poseAt(time, pose, cursor.sample)) return false;
  const double cell = std::floor(time / kCell);
  if (cell != cursor.cell) {
    cursor.cell = cell;
    cursor.covariance = shared_.at((cell + 0.5) * kCell);
  }
  const ScanGeometry geometry = scanGeometry(pose, point);
  Eigen::Matrix<double, 3, CalibrationCovariance::kSize> effect;
  effect.leftCols<kSystemParameterCount>() = designBlock(geometry);
  effect.middleCols<3>(kSystemParameterCount).setIdentity();
  effect.rightCols<3>() = effect.middleCols<3>(indexOf(SystemParameter::boresight_pitch)).eval();
  const ErrorLevels& levels = shared_.levels();
  const Eigen::Vector3d beam = geometry.beam();
  const double range = geometry.range(), across = levels.angle * range;
  const double footprint = levels.footprint * range * tangentOfIncidence(beam, normal);
  Eigen::Matrix3d own = Eigen::Matrix3d::Zero();
  // The level is that of all points, also of what range_std does not contain.
  const double range_error = range_std > levels.range ? range_std : levels.range;
  const double along_sq = range_error * range_error + footprint * footprint;
  if (system < differences_.size()) {
    const Difference& difference = differences_[system];
    const DesignBlock design = effect.leftCols<kSystemParameterCount>();
    own = design * difference.parameters.asDiagonal() * design.transpose();
    own.diagonal() += difference.offset;
  }
  covariance.noalias() = effect * cursor.covariance * effect.transpose();
  covariance += own;
  covariance += (along_sq - across * across) * beam * beam.transpose();
  covariance.diagonal().array() += across * across + levels.position * levels.position;
  return true;
}

}  // namespace pcl_als
