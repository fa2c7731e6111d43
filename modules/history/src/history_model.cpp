// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "history_model.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace pcl_als::detail {

MissionInformation informationOf(const std::vector<CalibrationMission>& missions,
                                 const SystemVector& change_std) {
  MissionInformation result;
  const auto s = change_std.asDiagonal();
  for (const CalibrationMission& mission : missions) {
    const SystemMatrix& l = mission.information;
    const SystemMatrix inner = SystemMatrix::Identity() + SystemMatrix(s * l * s);
    const Eigen::LLT<SystemMatrix> factor(inner);
    const SystemMatrix left = l * s, right = s * l;
    result.matrix.emplace_back(l - left * factor.solve(right));
    result.vector.emplace_back(mission.information_vector -
                               left * factor.solve(s * mission.information_vector));
  }
  return result;
}

std::vector<HistoryTerm> constantTerms(const std::vector<CalibrationMission>& missions) {
  std::vector<HistoryTerm> terms;
  for (const SystemParameterInfo& info : systemParameters()) {
    const int p = indexOf(info.parameter);
    HistoryTerm term{p, Eigen::VectorXd::Ones(static_cast<Eigen::Index>(missions.size()))};
    bool matters = false, determined = false;
    for (const CalibrationMission& mission : missions) {
      matters = matters || mission.information(p, p) > 0.0;
      determined = determined || mission.determines(info.parameter);
      term.prior_std = std::max(term.prior_std, mission.held_std[p]);
    }
    if (!matters) continue;
    if (determined) term.prior_std = 0.0;
    terms.push_back(std::move(term));
  }
  return terms;
}

HistoryModel::HistoryModel(const MissionInformation& data, std::vector<HistoryTerm> terms)
    : data_(data), terms_(std::move(terms)) {
  const auto size = static_cast<Eigen::Index>(terms_.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const HistoryTerm& a = terms_[static_cast<std::size_t>(i)];
    for (Eigen::Index k = 0; k <= i; ++k) {
      const HistoryTerm& b = terms_[static_cast<std::size_t>(k)];
      for (std::size_t m = 0; m < data_.size(); ++m) {
        const auto at = static_cast<Eigen::Index>(m);
        normal(i, k) += a.design[at] * b.design[at] * data_.matrix[m](a.parameter, b.parameter);
      }
      normal(k, i) = normal(i, k);
    }
    // The prior of a held parameter; else the bias is less than the largest that is accepted, which
    // keeps the system regular where flights determine a combination of parameters only.
    const double std =
        a.prior_std > 0.0 ? a.prior_std : largestBias(static_cast<SystemParameter>(a.parameter));
    normal(i, i) += a.design.squaredNorm() / static_cast<double>(a.design.size()) / (std * std);
  }
  // Scaled to unit diagonal: units of the parameters differ by many orders of magnitude.
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  const Eigen::LDLT<Eigen::MatrixXd> factor(scaled);
  covariance_ =
      scale.asDiagonal() * factor.solve(Eigen::MatrixXd::Identity(size, size)) * scale.asDiagonal();
  log_determinant_ = factor.vectorD().array().abs().log().sum() - 2.0 * scale.array().log().sum();
  const Eigen::VectorXd right = rightSide(data_.vector);
  solution_ = covariance_ * right;
  explained_ = solution_.dot(right);
}

Eigen::VectorXd HistoryModel::rightSide(const std::vector<SystemVector>& vectors) const {
  Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms_.size()));
  for (std::size_t i = 0; i < terms_.size(); ++i)
    for (std::size_t m = 0; m < vectors.size(); ++m)
      right[static_cast<Eigen::Index>(i)] +=
          terms_[i].design[static_cast<Eigen::Index>(m)] * vectors[m][terms_[i].parameter];
  return right;
}

SystemVector HistoryModel::valuesAt(std::size_t mission, const Eigen::VectorXd& solution,
                                    bool all) const {
  SystemVector values = SystemVector::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i)
    if (all || terms_[i].lasting)
      values[terms_[i].parameter] += terms_[i].design[static_cast<Eigen::Index>(mission)] *
                                     solution[static_cast<Eigen::Index>(i)];
  return values;
}

SystemVector HistoryModel::at(std::size_t mission) const {
  return valuesAt(mission, solution_, false);
}

SystemMatrix HistoryModel::covarianceAt(std::size_t mission) const {
  const auto at = static_cast<Eigen::Index>(mission);
  SystemMatrix covariance = SystemMatrix::Zero();
  for (std::size_t i = 0; i < terms_.size(); ++i)
    for (std::size_t k = 0; k < terms_.size(); ++k) {
      if (!terms_[i].lasting || !terms_[k].lasting) continue;
      covariance(terms_[i].parameter, terms_[k].parameter) +=
          terms_[i].design[at] * terms_[k].design[at] *
          covariance_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
    }
  return covariance;
}

std::vector<SystemVector> HistoryModel::residuals(const std::vector<SystemVector>& vectors) const {
  const Eigen::VectorXd solution = covariance_ * rightSide(vectors);
  std::vector<SystemVector> result;
  result.reserve(vectors.size());
  for (std::size_t m = 0; m < vectors.size(); ++m)
    result.emplace_back(vectors[m] - data_.matrix[m] * valuesAt(m, solution, true));
  return result;
}

double HistoryModel::scoreVariance(const HistoryTerm& term) const {
  Eigen::VectorXd common = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(terms_.size()));
  double own = 0.0;
  for (std::size_t m = 0; m < data_.size(); ++m) {
    const auto at = static_cast<Eigen::Index>(m);
    if (term.design[at] == 0.0) continue;
    const auto& row = data_.matrix[m].row(term.parameter);
    own += term.design[at] * term.design[at] * row[term.parameter];
    for (std::size_t i = 0; i < terms_.size(); ++i)
      common[static_cast<Eigen::Index>(i)] +=
          term.design[at] * terms_[i].design[at] * row[terms_[i].parameter];
  }
  constexpr double kLeast = 1e-9;  // of the variance without the other unknowns: not estimable
  const double variance = own - common.dot(covariance_ * common);
  return variance > kLeast * own ? variance : 0.0;
}

}  // namespace pcl_als::detail
