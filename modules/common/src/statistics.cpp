// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
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

namespace {

constexpr std::size_t kMany = 4096;         // values, from which the median of a sample saves time
constexpr std::size_t kSample = 1024;       // values of the sample
constexpr std::size_t kRankTolerance = 64;  // four standard deviations of the rank in it

/// The median of many values from those between two values of a sample, which contain it almost
/// always (Floyd and Rivest 1975); nothing where they do not.
std::optional<double> medianNearThatOfSample(const std::vector<double>& values) {
  std::array<double, kSample> sample{};
  for (std::size_t i = 0; i < kSample; ++i) sample[i] = values[i * values.size() / kSample];
  const auto low = sample.begin() + kSample / 2 - kRankTolerance,
             high = sample.begin() + kSample / 2 + kRankTolerance;
  std::nth_element(sample.begin(), low, sample.end());
  std::nth_element(low, high, sample.end());
  std::vector<double> between(values.size());
  std::size_t below = 0, count = 0;
  for (const double value : values) {  // without branches, which could not be predicted
    between[count] = value;
    count += static_cast<std::size_t>(value >= *low) & static_cast<std::size_t>(value <= *high);
    below += static_cast<std::size_t>(value < *low);
  }
  const std::size_t rank = values.size() / 2;
  if (rank < below + 1 || rank >= below + count) return std::nullopt;
  const auto middle = between.begin() + static_cast<std::ptrdiff_t>(rank - below);
  std::nth_element(between.begin(), middle, between.begin() + static_cast<std::ptrdiff_t>(count));
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(between.begin(), middle));
}

}  // namespace

double medianInPlace(std::vector<double>& values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (values.size() >= kMany)
    if (const auto median = medianNearThatOfSample(values)) return *median;
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
