// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <random>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/history/calibration_history.h>

namespace pcl_als::test {

/// A calibration result with the given estimates, standard deviations and correlations.
inline CalibrationResult calibrationWith(const std::vector<SystemParameter>& order,
                                         const Eigen::VectorXd& bias, const Eigen::VectorXd& std,
                                         const Eigen::MatrixXd& correlation) {
  CalibrationResult result;
  result.attitude = AttitudeSource::trajectory;
  result.correlation_order = order;
  result.correlation = correlation;
  for (std::size_t i = 0; i < order.size(); ++i) {
    ParameterEstimate& estimate = result[order[i]];
    estimate.status = ParameterStatus::estimated;
    estimate.bias = bias[static_cast<Eigen::Index>(i)];
    estimate.std = estimate.std_formal = std[static_cast<Eigen::Index>(i)];
  }
  return result;
}

/** \brief Calibrations of one system with seven estimated parameters: standard deviations vary by
 * a factor of two between missions, correlations are random with absolute values up to about 0.6.
 */
class MissionSimulator {
 public:
  explicit MissionSimulator(unsigned seed) : generator_(seed) {}

  static const std::vector<SystemParameter>& order() {
    using P = SystemParameter;
    static const std::vector<P> kOrder = {
        P::lever_arm_x,       P::lever_arm_y, P::boresight_pitch, P::boresight_roll,
        P::boresight_heading, P::range_bias,  P::scan_angle_scale};
    return kOrder;
  }
  /// Typical standard deviations of a calibration flight, internal units.
  static Eigen::VectorXd typicalStd() {
    Eigen::VectorXd std(7);
    std << 0.01, 0.01, 2.0 * kRadiansPerArcsec, 1.5 * kRadiansPerArcsec, 8.0 * kRadiansPerArcsec,
        0.003, 1e-5;
    return std;
  }

  double normal() { return normal_(generator_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }

  CalibrationResult calibration(const Eigen::VectorXd& truth) {
    const Eigen::Index n = truth.size();
    const Eigen::MatrixXd mix =
        Eigen::MatrixXd::NullaryExpr(n, n, [&] { return 0.25 * normal(); }) +
        Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd product = mix * mix.transpose();
    const Eigen::VectorXd scale = product.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd correlation = scale.asDiagonal() * product * scale.asDiagonal();
    const Eigen::VectorXd std =
        typicalStd().unaryExpr([&](double value) { return value * uniform(0.7, 1.4); });
    const Eigen::MatrixXd root = correlation.llt().matrixL();
    const Eigen::VectorXd error =
        std.asDiagonal() * (root * Eigen::VectorXd::NullaryExpr(n, [&] { return normal(); }));
    return calibrationWith(order(), truth + error, std, correlation);
  }

 private:
  std::mt19937_64 generator_;
  std::normal_distribution<double> normal_;
};

}  // namespace pcl_als::test
