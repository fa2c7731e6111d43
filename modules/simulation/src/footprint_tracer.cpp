// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "footprint_tracer.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/common/system_parameters.h>

#include "pulse_tracer.h"

namespace pcl_als::simulation {

namespace {

/// Mean of r² over the part of a Gaussian beam of unit standard deviation between two shares of its
/// energy. With u = r² / 2, the energy beyond u is exp(-u); the integral of 2 u exp(-u) is taken.
double meanSquareRadius(double from_share, double to_share) {
  const auto integral = [](double beyond) {  // of 2 u exp(-u) from the radius outwards
    return beyond > 0.0 ? 2.0 * beyond * (1.0 - std::log(beyond)) : 0.0;
  };
  return (integral(1.0 - from_share) - integral(1.0 - to_share)) / (to_share - from_share);
}

}  // namespace

FootprintTracer::FootprintTracer(const Scene& scene, const ScannerOptions& scanner, int rings)
    : scene_(scene), scanner_(scanner) {
  const double all = rings * rings;
  for (int k = 1; k <= rings; ++k) {
    const double radius = std::sqrt(meanSquareRadius((k - 1) * (k - 1) / all, k * k / all));
    const int count = 6 * k - 3;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * kPi * (i + 0.5 * (k % 2)) / count;
      sub_rays_.push_back(radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
  }
}

const std::vector<Backscatter>& FootprintTracer::trace(const Eigen::Vector3d& origin,
                                                       const Eigen::Vector3d& direction) {
  parts_.clear();
  if (!scene_.trace(origin, direction, hits_)) return parts_;
  const double sigma = 0.25 * scanner_.divergence;
  const double energy = 1.0 / static_cast<double>(sub_rays_.size());
  const Eigen::Vector3d a = direction.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d b = direction.cross(a);
  for (const Eigen::Vector2d& place : sub_rays_) {
    const Eigen::Vector3d ray = (direction + sigma * (place.x() * a + place.y() * b)).normalized();
    if (scene_.trace(origin, ray, hits_))
      appendBackscatter(hits_, ray, energy, scanner_.incidence_exponent, parts_);
  }
  std::stable_sort(parts_.begin(), parts_.end(),
                   [](const Backscatter& l, const Backscatter& r) { return l.range < r.range; });
  return parts_;
}

}  // namespace pcl_als::simulation
