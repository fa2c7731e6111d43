// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "noise_model.h"

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

void NoiseModel::validate() const {
  const std::pair<const char*, double> values[] = {{"range noise (m)", range},
                                                   {"angle noise (rad)", angle},
                                                   {"position noise (m)", position},
                                                   {"beam divergence (rad)", beam_divergence}};
  for (const auto& [name, value] : values) {
    if (std::isfinite(value) && value >= 0.0) continue;
    std::ostringstream text;
    text << name << " must be zero or more, is " << value;
    throw UsageError(text.str());
  }
  if (range == 0.0 && position == 0.0)
    throw UsageError("range noise and position noise cannot both be zero");
}

Eigen::Matrix3d NoiseModel::pointingCovariance(const ScanGeometry& g) const {
  const Eigen::Vector3d beam = g.beam();
  const double distance = g.range();
  // The position of the return in the footprint has a standard deviation of a quarter of the 1/e^2
  // diameter.
  const double across_sq = (angle * angle + footprint() * footprint()) * distance * distance;
  return across_sq * (Eigen::Matrix3d::Identity() - beam * beam.transpose());
}

Eigen::Matrix3d NoiseModel::pointCovariance(const ScanGeometry& g) const {
  const Eigen::Vector3d beam = g.beam();
  return pointingCovariance(g) + range * range * beam * beam.transpose() +
         position * position * Eigen::Matrix3d::Identity();
}

double normalVariance(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& normal) {
  return normal.dot(covariance * normal);
}

}  // namespace pcl_als
