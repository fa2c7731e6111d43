// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_covariance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pcl_als {
namespace {

// Correlation times between knots with correlations: they change as slowly as the smooth component.
constexpr double kCorrelationSpacing = 0.25;

}  // namespace

StripCovariance::StripCovariance(
    const SharedErrors& errors, const VarianceFactors& levels, InverseEntries inverse,
    Eigen::Matrix<double, Eigen::Dynamic, kSystemParameterCount> elimination,
    const SystemMatrix& parameters)
    : errors_(errors),
      levels_(levels),
      inverse_(std::move(inverse)),
      elimination_(std::move(elimination)),
      parameters_(parameters) {}

StripCovariance::At StripCovariance::at(int strip,
                                        const SharedErrors::Expectation& expectation) const {
  At found{Eigen::Matrix<double, kErrors, kErrors>::Zero(),
           Eigen::Matrix<double, kErrors, kSystemParameterCount>::Zero()};
  Eigen::Matrix<double, kErrors, kSystemParameterCount> elimination = found.parameters;
  for (const auto& [block, weight] : expectation.blocks) {
    elimination += weight * elimination_.middleRows<kErrors>(Eigen::Index{kErrors} * block);
    for (const auto& [other, other_weight] : expectation.blocks)
      found.errors += weight * other_weight * inverse_.block(block, other);
  }
  const auto left = errors_.variancesLeft(strip, expectation, levels_);
  for (int i = 0; i < kErrors; ++i) found.errors(i, i) += left[static_cast<std::size_t>(i)];
  found.parameters = -elimination * parameters_;
  found.errors -= found.parameters * elimination.transpose();
  return found;
}

void StripCovariance::add(int strip, const std::vector<SystemParameter>& order,
                          StripErrors& result) const {
  const std::vector<SharedErrors::Expectation> expectations = errors_.expectationsOf(strip);
  const double spacing = kCorrelationSpacing * errors_.model().correlation_time;
  for (std::size_t i = 0; i < expectations.size(); ++i) {
    const At found = at(strip, expectations[i]);
    const Eigen::Matrix<double, kErrors, 1> std = found.errors.diagonal().cwiseMax(0.0).cwiseSqrt();
    TrajectoryErrorKnot& knot = result.knots[i];
    knot.position_std = std.head<3>();
    knot.angles_std = std.tail<3>();
    const bool last = i + 1 == expectations.size();
    if (!last && !result.correlations.empty() &&
        knot.time < result.correlations.back().time + spacing)
      continue;
    const Eigen::Matrix<double, kErrors, 1> scale = std.cwiseMax(1e-12).cwiseInverse();
    StripErrorCorrelation correlation{
        knot.time, scale.asDiagonal() * found.errors * scale.asDiagonal(), {}};
    correlation.parameters.resize(kErrors, static_cast<Eigen::Index>(order.size()));
    for (std::size_t p = 0; p < order.size(); ++p) {
      const int column = indexOf(order[p]);
      correlation.parameters.col(static_cast<Eigen::Index>(p)) =
          scale.asDiagonal() * found.parameters.col(column) /
          std::sqrt(parameters_(column, column));
    }
    result.correlations.push_back(std::move(correlation));
  }
}

}  // namespace pcl_als
