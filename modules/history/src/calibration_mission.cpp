// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Eigenvalues>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/parameter_covariance.h>
#include <pcl_als/history/calibration_history.h>

namespace pcl_als {
namespace {

Eigen::MatrixXd scaledBy(const Eigen::VectorXd& scale, const Eigen::MatrixXd& matrix) {
  return scale.asDiagonal() * matrix * scale.asDiagonal();
}

/// Adds what the estimates tell of themselves and of the held parameters.
void addInformation(const CalibrationResult& estimated, const Eigen::MatrixXd& covariance,
                    CalibrationMission& mission) {
  const HeldParameters& held = estimated.held_parameters;
  std::vector<SystemParameter> order = estimated.correlation_order;
  const auto size = static_cast<Eigen::Index>(order.size());
  const auto held_size = static_cast<Eigen::Index>(held.parameters.size());
  const bool known = held.effect.rows() == size && held.effect.cols() == held_size;
  Eigen::MatrixXd inverse, design = Eigen::MatrixXd::Identity(size, size);
  if (known && held_size > 0) {
    const Eigen::Map<const Eigen::VectorXd> std(held.std.data(), held_size);
    inverse = inverseOfDefinite(covariance - held.effect * std.cwiseAbs2().asDiagonal() *
                                                 held.effect.transpose());
  }
  if (inverse.size() > 0) {
    design.conservativeResize(size, size + held_size);
    design.rightCols(held_size) = -held.effect;
    for (std::size_t k = 0; k < held.parameters.size(); ++k) {
      order.push_back(held.parameters[k]);
      mission.held_std[indexOf(held.parameters[k])] = held.std[k];
    }
  } else {
    inverse = inverseOfDefinite(covariance);
  }
  if (inverse.size() == 0)
    throw InputError(mission.name + ": the correlation matrix is numerically singular");
  Eigen::VectorXd bias(size);
  for (Eigen::Index i = 0; i < size; ++i)
    bias[i] = estimated[order[static_cast<std::size_t>(i)]].bias;
  const Eigen::MatrixXd information = design.transpose() * inverse * design;
  const Eigen::VectorXd vector = design.transpose() * (inverse * bias);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int row = indexOf(order[i]);
    mission.information_vector[row] = vector[static_cast<Eigen::Index>(i)];
    for (std::size_t k = 0; k < order.size(); ++k)
      mission.information(row, indexOf(order[k])) =
          information(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
  }
}

/// Takes the information of a prior out. Standard deviations of calibrations are at least those of
/// the model, so that the rest need not be positive definite: directions in which nothing is left
/// are of no information.
void removePrior(const BiasPrior& prior, CalibrationMission& mission) {
  constexpr double kNegligible = 1e-6;  // of the information with the prior
  const SystemVector diagonal = mission.information.diagonal();
  const SystemVector scale =
      (diagonal.array() > 0.0).select(diagonal.cwiseSqrt().cwiseInverse(), SystemVector::Ones());
  const SystemMatrix scaled = scaledBy(scale, mission.information - prior.information);
  const SystemVector vector =
      scale.cwiseProduct(mission.information_vector - prior.information * prior.mean);
  const Eigen::SelfAdjointEigenSolver<SystemMatrix> eigen(scaled);
  const SystemVector kept = (eigen.eigenvalues().array() > kNegligible)
                                .select(SystemVector::Ones(), SystemVector::Zero());
  const SystemMatrix& axes = eigen.eigenvectors();
  const SystemMatrix rest =
      axes * kept.cwiseProduct(eigen.eigenvalues()).asDiagonal() * axes.transpose();
  const SystemVector left = axes * kept.asDiagonal() * (axes.transpose() * vector);
  mission.information = scaledBy(scale.cwiseInverse(), rest);
  mission.information_vector = left.cwiseQuotient(scale);
  // What the flight tells alone, where that is enough to tell something.
  SystemMatrix regular = mission.information;
  for (const SystemParameterInfo& info : systemParameters()) {
    const int p = indexOf(info.parameter);
    regular(p, p) += 1.0 / std::pow(mission.priorStd(info.parameter), 2);
  }
  constexpr double kLargestInformativeStd = 0.05;  // of the largest bias that is accepted
  const Eigen::MatrixXd covariance = inverseOfDefinite(regular);
  if (covariance.size() == 0)
    throw InputError(mission.name + ": without its prior the flight is numerically singular");
  const SystemVector bias = covariance * mission.information_vector;
  for (const SystemParameterInfo& info : systemParameters()) {
    const int p = indexOf(info.parameter);
    if (std::isnan(mission.std[p])) continue;
    const double std = std::sqrt(covariance(p, p));
    const bool tells = std < kLargestInformativeStd * largestBias(info.parameter);
    mission.bias[p] = tells ? bias[p] : std::numeric_limits<double>::quiet_NaN();
    mission.std[p] = tells ? std : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system) {
  CalibrationResult estimated;
  try {
    estimated = calibrationOfSystem(calibration, system);
  } catch (const UsageError& error) {
    throw UsageError(name + ": " + error.what());
  }
  CalibrationMission mission;
  mission.name = name;
  mission.day = calibration.day;
  mission.bias.setConstant(std::numeric_limits<double>::quiet_NaN());
  mission.std = mission.bias;
  addInformation(estimated, estimatedCovariance(estimated, name), mission);
  for (const SystemParameter p : estimated.correlation_order) {
    mission.bias[indexOf(p)] = estimated[p].bias;
    mission.std[indexOf(p)] = estimated[p].std;
  }
  if (calibration.prior.any())
    removePrior(calibration.prior.marginal(estimated.correlation_order), mission);
  return mission;
}

}  // namespace pcl_als
