// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/radiometry/reference_targets.h>

namespace pcl_als {
namespace {

/// A median is less certain than a mean of normal values by this (square root of pi / 2).
constexpr double kMedianFactor = 1.2533;

}  // namespace

ReferenceCalibration::ReferenceCalibration(std::vector<ReferenceTarget> targets, double radius)
    : targets_(std::move(targets)), radius_(radius), values_(targets_.size()) {
  if (targets_.empty()) throw UsageError("reference targets: there are none");
  if (!std::isfinite(radius) || radius <= 0.0)
    throw UsageError("reference targets: the radius must be more than 0 m");
  for (const ReferenceTarget& target : targets_) {
    if (!(target.reflectance > 0.0 && target.reflectance <= 2.0))
      throw UsageError("reference target " + target.id +
                       ": the reflectance must be more than 0 and at most 2");
    if (!(target.sigma >= 0.0 && target.sigma < 1.0))
      throw UsageError("reference target " + target.id + ": sigma must be from 0 to under 1");
  }
}

bool ReferenceCalibration::touches(double min_x, double min_y, double max_x, double max_y) const {
  return std::any_of(targets_.begin(), targets_.end(), [&](const ReferenceTarget& t) {
    return t.x >= min_x - radius_ && t.x <= max_x + radius_ && t.y >= min_y - radius_ &&
           t.y <= max_y + radius_;
  });
}

void ReferenceCalibration::add(double x, double y, double corrected_intensity) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const double dx = x - targets_[i].x, dy = y - targets_[i].y;
    if (dx * dx + dy * dy <= radius_ * radius_) values_[i].push_back(corrected_intensity);
  }
}

ReferenceResult ReferenceCalibration::solve() const {
  ReferenceResult result;
  double weights = 0.0, sum = 0.0;
  std::vector<double> logs(targets_.size());
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const ReferenceTarget& target = targets_[i];
    ReferenceResult::Target& entry = result.targets.emplace_back();
    entry.id = target.id;
    entry.points = values_[i].size();
    entry.reflectance = target.reflectance;
    if (entry.points < kLeastPoints) {
      result.warnings.push_back("target " + target.id + " has " + std::to_string(entry.points) +
                                " usable points, " + std::to_string(kLeastPoints) +
                                " are needed: not used");
      continue;
    }
    std::vector<double> values = values_[i];
    const double spread = robustSigma(values), median = medianInPlace(values);
    const double of_points =
        kMedianFactor * spread / (median * std::sqrt(static_cast<double>(entry.points)));
    entry.relative_std = std::max(1e-4, std::hypot(of_points, target.sigma / target.reflectance));
    entry.measured = median;  // scaled below
    entry.used = true;
    logs[i] = std::log(median / target.reflectance);
    const double weight = 1.0 / (entry.relative_std * entry.relative_std);
    weights += weight;
    sum += weight * logs[i];
  }
  if (weights == 0.0) return result;
  const double mean = sum / weights;
  result.constant = std::exp(mean);
  double chi_sq = 0.0, squares = 0.0, used = 0.0;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    ReferenceResult::Target& entry = result.targets[i];
    if (!entry.used) continue;
    entry.measured /= result.constant;
    used += 1.0;
    chi_sq += std::pow((logs[i] - mean) / entry.relative_std, 2);
    squares += std::pow(entry.measured / entry.reflectance - 1.0, 2);
  }
  const double excess = used > 1.0 ? std::max(1.0, chi_sq / (used - 1.0)) : 1.0;
  result.relative_std = std::sqrt(excess / weights);
  if (used > 1.0)
    result.relative_rms = std::sqrt(squares / used);
  else
    result.warnings.push_back("a single target: nothing checks its reflectance or its place");
  return result;
}

}  // namespace pcl_als
