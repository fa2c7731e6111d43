// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "straight_path.h"

#include <algorithm>

#include "path_constants.h"
#include "ray_fit.h"

namespace pcl_als::detail {
PathSample StraightPath::at(double at_time) const {
  const double t = at_time - time;
  PathSample sample;
  sample.time = at_time;
  sample.position = position + t * velocity;
  sample.velocity = velocity;
  const double bend = 0.5 * kBend * t * t;
  sample.covariance =
      covariance.topLeftCorner<3, 3>() +
      t * (covariance.topRightCorner<3, 3>() + covariance.bottomLeftCorner<3, 3>()) +
      t * t * covariance.bottomRightCorner<3, 3>() +
      (bend * bend + kRough * kRough) * Eigen::Matrix3d::Identity();
  sample.velocity_covariance =
      covariance.bottomRightCorner<3, 3>() + (kBend * kBend * t * t) * Eigen::Matrix3d::Identity();
  return sample;
}

std::optional<StraightPath> straightPath(const PathEvidence& evidence, const TimeRange& span) {
  std::vector<SensorRay> rays;
  StraightPath line;
  for (const auto& entry : evidence.bins()) {
    for (const PulseRay& ray : entry.second.rays) {
      if (ray.time < span.first || ray.time > span.last) continue;
      rays.emplace_back(ray, evidence.origin());
      line.time += ray.time;
    }
  }
  line.rays = rays.size();
  if (line.rays < kFewestRaysOfLine) return std::nullopt;
  const auto count = static_cast<double>(line.rays);
  line.time /= count;
  const std::optional<RayFit> fit = fitRays(rays, true, line.time);
  if (!fit) return std::nullopt;
  line.position = evidence.origin() + fit->unknowns.head<3>();
  line.velocity = fit->unknowns.tail<3>();
  line.covariance = fit->scale * fit->scale * fit->cofactor;
  const double across = std::clamp(fit->scale, kAcross, 10.0 * kAcross);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    line.height += rays[i].direction.z() * rays[i].distance / count;
    line.fitting += fit->residuals[i] < kNormRejection * across ? 1.0 / count : 0.0;
  }
  return line;
}

}  // namespace pcl_als::detail
