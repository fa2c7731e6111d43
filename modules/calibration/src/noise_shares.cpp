// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "noise_shares.h"

#include <algorithm>

namespace pcl_als {

NoiseShares::NoiseShares(const std::vector<std::size_t>& points) {
  for (const std::size_t count : points) used_.emplace_back(count, 0.0);
}

void NoiseShares::add(std::size_t of_point, std::int32_t point, std::size_t of_patch,
                      const Tin::Triangle& triangle, const Eigen::Vector3d& weights,
                      double point_variance, double vertex_variance) {
  Pair pair{of_point,       static_cast<std::size_t>(point), of_patch, {}, weights, point_variance,
            vertex_variance};
  used_[pair.of_point][pair.point] += 1.0;
  for (int i = 0; i < 3; ++i) {
    pair.vertex[i] = static_cast<std::size_t>(triangle.vertex[i]);
    used_[pair.of_patch][pair.vertex[i]] += weights[i];
  }
  pairs_.push_back(pair);
}

void NoiseShares::setSharing(AreaObservations& observations) const {
  for (std::size_t k = 0; k < observations.size(); ++k) {
    PairObservation& o = observations[k];
    const Pair& pair = pairs_[k];
    const std::vector<double>& vertices = used_[pair.of_patch];
    double patch = 0.0;
    for (int i = 0; i < 3; ++i) patch += pair.weights[i] * vertices[pair.vertex[i]];
    const double point = used_[pair.of_point][pair.point];
    const double row = pair.point_variance * point + pair.vertex_variance * patch;
    o.variance_inflation = std::max(1.0F, static_cast<float>(row / o.variance));
  }
}

}  // namespace pcl_als
