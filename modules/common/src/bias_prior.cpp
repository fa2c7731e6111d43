// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/bias_prior.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

Eigen::MatrixXd block(const SystemMatrix& matrix, const std::vector<SystemParameter>& rows,
                      const std::vector<SystemParameter>& columns) {
  Eigen::MatrixXd part(rows.size(), columns.size());
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (std::size_t c = 0; c < columns.size(); ++c)
      part(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) =
          matrix(indexOf(rows[r]), indexOf(columns[c]));
  return part;
}

SystemMatrix embedded(const Eigen::MatrixXd& part, const std::vector<SystemParameter>& parameters) {
  SystemMatrix matrix = SystemMatrix::Zero();
  for (std::size_t r = 0; r < parameters.size(); ++r)
    for (std::size_t c = 0; c < parameters.size(); ++c)
      matrix(indexOf(parameters[r]), indexOf(parameters[c])) =
          part(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
  return matrix;
}

}  // namespace

std::vector<SystemParameter> BiasPrior::known() const {
  std::vector<SystemParameter> parameters;
  for (const SystemParameterInfo& info : systemParameters())
    if (of(info.parameter)) parameters.push_back(info.parameter);
  return parameters;
}

SystemMatrix BiasPrior::covariance() const {
  const std::vector<SystemParameter> parameters = known();
  if (parameters.empty()) return SystemMatrix::Zero();
  const Eigen::MatrixXd inverse = inverseOfDefinite(block(information, parameters, parameters));
  if (inverse.size() == 0) throw InputError("prior: its information is not positive definite");
  return embedded(inverse, parameters);
}

BiasPrior BiasPrior::marginal(const std::vector<SystemParameter>& parameters) const {
  std::vector<SystemParameter> kept, left;
  for (const SystemParameter p : known()) {
    const bool wanted = std::find(parameters.begin(), parameters.end(), p) != parameters.end();
    (wanted ? kept : left).push_back(p);
  }
  BiasPrior part = *this;
  Eigen::MatrixXd of_kept = block(information, kept, kept);
  const Eigen::MatrixXd coupling = block(information, kept, left);
  // Independent parameters keep their information to the last digit.
  if (!coupling.isZero(0.0)) {
    const Eigen::MatrixXd inverse = inverseOfDefinite(block(information, left, left));
    if (inverse.size() == 0) throw InputError("prior: its information is not positive definite");
    of_kept -= coupling * inverse * coupling.transpose();
    of_kept = (0.5 * (of_kept + of_kept.transpose())).eval();
  }
  part.information = embedded(of_kept, kept);
  for (const SystemParameter p : left) part.mean[indexOf(p)] = 0.0;
  return part;
}

BiasPrior BiasPrior::without(SystemParameter parameter) const {
  std::vector<SystemParameter> others = known();
  others.erase(std::remove(others.begin(), others.end(), parameter), others.end());
  return marginal(others);
}

SystemVector BiasPrior::replacing(SystemVector biases) const {
  for (const SystemParameter p : known()) biases[indexOf(p)] = mean[indexOf(p)];
  return biases;
}

void BiasPrior::add(SystemParameter parameter, double value, double std) {
  mean[indexOf(parameter)] = value;
  information(indexOf(parameter), indexOf(parameter)) = 1.0 / (std * std);
}

BiasPrior biasPrior(const std::vector<SystemParameter>& parameters, const SystemVector& mean,
                    const Eigen::MatrixXd& covariance) {
  BiasPrior prior;
  if (parameters.empty()) return prior;
  const Eigen::MatrixXd inverse = inverseOfDefinite(covariance);
  if (inverse.size() == 0)
    throw InputError("the covariance matrix of the parameters is not positive definite");
  prior.information = embedded(inverse, parameters);
  for (const SystemParameter p : parameters) prior.mean[indexOf(p)] = mean[indexOf(p)];
  return prior;
}

SystemVector missionChangeStd() {
  constexpr double kLength = 0.005, kScale = 1e-5;  // metres, 1
  constexpr double kAngle = 5.0 * kRadiansPerArcsec;
  SystemVector std;
  std << kLength, kLength, kLength, kAngle, kAngle, 2.0 * kAngle, kLength, kScale;
  return std;
}

}  // namespace pcl_als
