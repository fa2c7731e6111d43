// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "sample_window.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace pcl_als::detail {

SampleWindow::SampleWindow(const std::vector<const TrajectorySample*>& anchors)
    : origin_(*anchors[anchors.size() / 2]) {
  const auto [first, last] = std::minmax_element(
      anchors.begin(), anchors.end(),
      [](const TrajectorySample* a, const TrajectorySample* b) { return a->time < b->time; });
  centre_ = 0.5 * ((*first)->time + (*last)->time);
  per_second_ = 2.0 / std::max((*last)->time - (*first)->time, 1e-9);
  order_ = anchors.size() >= 7 ? 4 : anchors.size() >= 5 ? 3 : 2;
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 6> right = Eigen::Matrix<double, 4, 6>::Zero();
  for (const TrajectorySample* anchor : anchors) {
    const Basis b = basis(anchor->time);
    normal += b * b.transpose();
    right += b * valuesRelativeTo(*anchor, origin_).transpose();
  }
  // Samples of equal times leave the normal matrix singular: the small term then levels the curve.
  for (int i = 0; i < 4; ++i) normal(i, i) += i < order_ ? 1e-9 : 1.0;
  inverse_ = normal.ldlt().solve(Eigen::Matrix4d::Identity());
  coefficients_ = inverse_ * right;
  for (const TrajectorySample* anchor : anchors) {
    const ChannelValues residual = deviation(*anchor);
    for (std::size_t c = 0; c < kSampleChannels; ++c)
      if (!(residual[c] <= misfit_[c])) misfit_[c] = residual[c];
  }
}

/// Legendre polynomials.
SampleWindow::Basis SampleWindow::basis(double time) const {
  const double t = (time - centre_) * per_second_;
  Basis b(1.0, t, 0.5 * (3.0 * t * t - 1.0), 0.5 * (5.0 * t * t - 3.0) * t);
  for (int i = order_; i < 4; ++i) b[i] = 0.0;
  return b;
}

ChannelValues SampleWindow::deviation(const TrajectorySample& sample) const {
  const SampleValues predicted = coefficients_.transpose() * basis(sample.time);
  return channelsOf(valuesRelativeTo(sample, origin_) - predicted);
}

double SampleWindow::amplification(double time) const {
  const Basis b = basis(time);
  return std::sqrt(1.0 + b.dot(inverse_ * b));
}

}  // namespace pcl_als::detail
