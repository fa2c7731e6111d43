// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <pcl_als/common/errors.h>
#include <pcl_als/history/calibration_mission.h>

namespace pcl_als {
namespace {

/// Estimated parameters of one system with their correlations.
struct EstimatedParameters {
  std::array<ParameterEstimate, kSystemParameterCount> parameters;
  std::vector<SystemParameter> order;
  Eigen::MatrixXd correlation;
};

EstimatedParameters firstSystem(const CalibrationResult& calibration, const std::string& name) {
  EstimatedParameters result{calibration.parameters, calibration.correlation_order,
                             calibration.correlation};
  const auto is_estimated = [&](SystemParameter p) {
    return calibration[p].status == ParameterStatus::estimated;
  };
  if (!std::all_of(result.order.begin(), result.order.end(), is_estimated))
    throw InputError(name + ": the correlation matrix names a parameter that is not estimated");
  if (result.order.empty())
    throw InputError(name + ": no parameter is estimated with correlations; a history needs them");
  return result;
}

EstimatedParameters systemNamed(const CalibrationResult& calibration, const std::string& name,
                                const std::string& system) {
  const auto& systems = calibration.systems;
  const auto found = std::find_if(systems.begin(), systems.end(),
                                  [&](const SystemEstimate& s) { return s.group.name == system; });
  if (found == systems.end()) {
    std::string known;
    for (const SystemEstimate& s : systems) known += (known.empty() ? "" : ", ") + s.group.name;
    throw InputError(name + ": has no system '" + system + "'; " +
                     (known.empty() ? "it has one system without a name" : "it has " + known));
  }
  if (found == systems.begin()) return firstSystem(calibration, name);
  EstimatedParameters result{found->parameters, {}, {}};
  for (const SystemParameterInfo& info : systemParameters())
    if (found->parameters[static_cast<std::size_t>(indexOf(info.parameter))].status ==
        ParameterStatus::estimated)
      result.order.push_back(info.parameter);
  const auto size = static_cast<Eigen::Index>(result.order.size());
  result.correlation = Eigen::MatrixXd::Identity(size, size);
  return result;
}

Eigen::MatrixXd scaledBy(const Eigen::VectorXd& scale, const Eigen::MatrixXd& matrix) {
  return scale.asDiagonal() * matrix * scale.asDiagonal();
}

/// Inverse of a positive definite matrix whose rows have different units; empty where it is not.
Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& matrix) {
  if (!matrix.allFinite() || !(matrix.diagonal().array() > 0.0).all()) return {};
  const Eigen::VectorXd scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scaledBy(scale, matrix));
  if (factor.info() != Eigen::Success) return {};
  return scaledBy(scale, factor.solve(Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols())));
}

/// Adds what the estimates tell of themselves and of the held parameters.
void addInformation(const EstimatedParameters& estimated, const Eigen::VectorXd& bias,
                    const Eigen::MatrixXd& covariance, const HeldParameters& held,
                    CalibrationMission& mission) {
  const auto size = static_cast<Eigen::Index>(estimated.order.size());
  const auto held_size = static_cast<Eigen::Index>(held.parameters.size());
  const bool known = held.effect.rows() == size && held.effect.cols() == held_size;
  Eigen::MatrixXd inverse, design = Eigen::MatrixXd::Identity(size, size);
  std::vector<SystemParameter> order = estimated.order;
  if (known && held_size > 0) {
    const Eigen::Map<const Eigen::VectorXd> std(held.std.data(), held_size);
    inverse = inverseOf(covariance -
                        held.effect * std.cwiseAbs2().asDiagonal() * held.effect.transpose());
  }
  if (inverse.size() > 0) {
    design.conservativeResize(size, size + held_size);
    design.rightCols(held_size) = -held.effect;
    for (std::size_t k = 0; k < held.parameters.size(); ++k) {
      order.push_back(held.parameters[k]);
      mission.held_std[indexOf(held.parameters[k])] = held.std[k];
    }
  } else {
    inverse = inverseOf(covariance);
  }
  if (inverse.size() == 0)
    throw InputError(mission.name + ": the correlation matrix is not positive definite");
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
  constexpr double kNothing = 1e-6;  // of the information with the prior
  const SystemVector diagonal = mission.information.diagonal();
  const SystemVector scale =
      (diagonal.array() > 0.0).select(diagonal.cwiseSqrt().cwiseInverse(), SystemVector::Ones());
  const SystemMatrix scaled = scaledBy(scale, mission.information - prior.information);
  const SystemVector vector =
      scale.cwiseProduct(mission.information_vector - prior.information * prior.mean);
  const Eigen::SelfAdjointEigenSolver<SystemMatrix> eigen(scaled);
  const SystemVector kept =
      (eigen.eigenvalues().array() > kNothing).select(SystemVector::Ones(), SystemVector::Zero());
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
    const double std =
        mission.held_std[p] > 0.0 ? mission.held_std[p] : largestBias(info.parameter);
    regular(p, p) += 1.0 / (std * std);
  }
  constexpr double kTellsSomething = 0.05;  // of the largest bias that is accepted
  const Eigen::MatrixXd covariance = inverseOf(regular);
  const SystemVector bias = covariance * mission.information_vector;
  for (const SystemParameterInfo& info : systemParameters()) {
    const int p = indexOf(info.parameter);
    if (std::isnan(mission.std[p])) continue;
    const double std = std::sqrt(covariance(p, p));
    const bool tells = std < kTellsSomething * largestBias(info.parameter);
    mission.bias[p] = tells ? bias[p] : std::numeric_limits<double>::quiet_NaN();
    mission.std[p] = tells ? std : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system) {
  const EstimatedParameters estimated =
      system.empty() ? firstSystem(calibration, name) : systemNamed(calibration, name, system);
  CalibrationMission mission;
  mission.name = name;
  mission.day = calibration.day;
  mission.bias.setConstant(std::numeric_limits<double>::quiet_NaN());
  mission.std = mission.bias;
  const auto size = static_cast<Eigen::Index>(estimated.order.size());
  Eigen::VectorXd bias(size), std(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int p = indexOf(estimated.order[static_cast<std::size_t>(i)]);
    const ParameterEstimate& estimate = estimated.parameters[static_cast<std::size_t>(p)];
    bias[i] = mission.bias[p] = estimate.bias;
    std[i] = mission.std[p] = estimate.std;
    if (!(std[i] > 0.0))
      throw InputError(name + ": the standard deviation of " +
                       std::string(systemParameters()[static_cast<std::size_t>(p)].name) +
                       " is not a positive number");
  }
  const bool first = system.empty() || system == calibration.systems.front().group.name;
  addInformation(estimated, bias, scaledBy(std, estimated.correlation),
                 first ? calibration.held_parameters : HeldParameters(), mission);
  if (calibration.prior.any()) removePrior(calibration.prior.marginal(estimated.order), mission);
  return mission;
}

}  // namespace pcl_als
