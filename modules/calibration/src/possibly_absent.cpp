// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "possibly_absent.h"

#include <cmath>

namespace pcl_als {

PossiblyAbsent::PossiblyAbsent(double absent, double prior, double value, double variance)
    : value_(value), variance_(variance) {
  const double ratio = std::sqrt(prior / variance) * std::exp(-0.5 * value * value / variance);
  probability_ = absent * ratio / (absent * ratio + 1.0 - absent);
}

Eigen::VectorXd PossiblyAbsent::move(const Eigen::VectorXd& covariances) const {
  return covariances * (-probability_ * value_ / variance_);
}

Eigen::MatrixXd PossiblyAbsent::change(const Eigen::VectorXd& covariances) const {
  const double between = (1.0 - probability_) * value_ * value_ / variance_;
  return covariances * covariances.transpose() * (probability_ * (between - 1.0) / variance_);
}

}  // namespace pcl_als
