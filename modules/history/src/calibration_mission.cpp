// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>

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

}  // namespace

CalibrationMission missionOf(const CalibrationResult& calibration, const std::string& name,
                             const std::string& system) {
  const EstimatedParameters estimated =
      system.empty() ? firstSystem(calibration, name) : systemNamed(calibration, name, system);
  CalibrationMission mission;
  mission.name = name;
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
  const Eigen::LLT<Eigen::MatrixXd> factor(estimated.correlation);
  if (factor.info() != Eigen::Success || !estimated.correlation.allFinite())
    throw InputError(name + ": the correlation matrix is not positive definite");
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(size, size));
  const Eigen::MatrixXd information =
      std.cwiseInverse().asDiagonal() * inverse * std.cwiseInverse().asDiagonal();
  const Eigen::VectorXd vector = information * bias;
  for (Eigen::Index i = 0; i < size; ++i) {
    const int row = indexOf(estimated.order[static_cast<std::size_t>(i)]);
    mission.information_vector[row] = vector[i];
    for (Eigen::Index k = 0; k < size; ++k)
      mission.information(row, indexOf(estimated.order[static_cast<std::size_t>(k)])) =
          information(i, k);
  }
  return mission;
}

std::string dateText(long day) {
  constexpr std::time_t kGpsEpoch = 315964800, kDay = 86400;  // seconds since 1970-01-01
  const std::time_t time = kGpsEpoch + kDay * day;
  std::tm date{};
  gmtime_r(&time, &date);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d", &date);
  return text;
}

}  // namespace pcl_als
