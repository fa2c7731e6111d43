// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/statistics.h>

#include "path_adjustment.h"
#include "path_constants.h"

namespace pcl_als::detail {
namespace {

/// RMS of the residuals of rays over their standard deviations, by tenths of the strip's time.
std::vector<double> residualsByTime(const std::vector<AdjustedRay>& rays, double from, double to) {
  constexpr std::size_t kParts = 10;
  std::vector<double> squares(kParts, 0.0), counts(kParts, 0.0);
  for (const AdjustedRay& ray : rays) {
    if (!(ray.weight > 0.0)) continue;
    const double part = kParts * (ray.time - from) / std::max(to - from, 1e-9);
    const auto k = static_cast<std::size_t>(std::clamp(part, 0.0, kParts - 1.0));
    squares[k] += 0.5 * ray.residual * ray.residual / ray.variance;
    counts[k] += 1.0;
  }
  for (std::size_t k = 0; k < kParts; ++k)
    squares[k] = counts[k] > 0.0 ? std::sqrt(squares[k] / counts[k]) : 0.0;
  return squares;
}

}  // namespace

double PathAdjustment::missingShare() const {
  const auto missing = std::count_if(rays_.begin(), rays_.end(),
                                     [](const AdjustedRay& ray) { return !(ray.weight > 0.0); });
  return rays_.empty() ? 0.0 : static_cast<double>(missing) / static_cast<double>(rays_.size());
}

void PathAdjustment::describe(ReconstructedPath& path) const {
  path.rays = rays_.size();
  forBins([&path](std::int64_t, const PathEvidence::Bin& bin) { path.points += bin.points; });
  std::vector<double> separations;
  for (const AdjustedRay& ray : rays_) {
    if (ray.weight > 0.0)
      separations.push_back(ray.separation);
    else
      ++path.rejected;
  }
  if (!separations.empty()) path.separation = medianInPlace(separations);
  if (!solved_) return;
  path.across = std::sqrt(across_);
  path.apart = std::sqrt(apart_);
  path.agility_plan = std::sqrt(plan_ / perDensity());
  path.agility_height = std::sqrt(height_ / perDensity());
  path.residuals = residualsByTime(rays_, spline_.from(), spline_.to());
  ReconstructedPath::Angles& angles = path.angles;
  angles.used = with_angles_;
  angles.right_positive = sign_ > 0.0;
  if (!angles_.empty()) angles.height_ratio = std::abs(angleSlope());
  if (!with_angles_) return;
  angles.scale = common_[0];
  angles.offset = common_[1];
  angles.scale_std = std::sqrt(normal_.commonCovariance()(0, 0));
  angles.offset_std = std::sqrt(normal_.commonCovariance()(1, 1));
  angles.roll = std::sqrt(roll_);
  angles.noise = std::sqrt(noise_);
}

}  // namespace pcl_als::detail
