// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <pcl_als/common/statistics.h>

namespace pcl_als {

void RunningStatistics::add(double value) {
  ++count_;
  const double deviation = value - mean_;
  mean_ += deviation / static_cast<double>(count_);
  squares_ += deviation * (value - mean_);
}

void RunningStatistics::merge(const RunningStatistics& other) {
  if (other.count_ == 0) return;
  const double total = static_cast<double>(count_ + other.count_);
  const double deviation = other.mean_ - mean_;
  const double share = static_cast<double>(other.count_) / total;
  squares_ += other.squares_ + deviation * deviation * static_cast<double>(count_) * share;
  mean_ += deviation * share;
  count_ += other.count_;
}

double RunningStatistics::standardDeviation() const {
  return count_ < 2 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count_ - 1));
}

double RunningStatistics::rms() const {
  return count_ == 0 ? 0.0 : std::sqrt(squares_ / static_cast<double>(count_) + mean_ * mean_);
}

double medianInPlace(std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

double robustSigma(std::vector<double> values) {
  const double median = medianInPlace(values);
  for (double& value : values) value -= median;
  return robustSigmaAboutZero(std::move(values));
}

double robustSigmaAboutZero(std::vector<double> values) {
  constexpr double kNormal = 1.4826;  // 1 / normalCritical(0.25), rounded as the NMAD is defined
  for (double& value : values) value = std::abs(value);
  return kNormal * medianInPlace(values);
}

}  // namespace pcl_als
