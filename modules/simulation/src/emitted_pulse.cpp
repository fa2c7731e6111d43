// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "emitted_pulse.h"

#include <algorithm>
#include <numeric>

namespace pcl_als::simulation {

namespace {

constexpr double kTableStep = 1.0 / 200.0;   ///< standard deviations of the pulse
constexpr double kGaussianReach = 6.0;       ///< standard deviations: 1.5e-8 of the maximum
constexpr double kDecayReach = 16.0;         ///< decay times: 1.1e-7
constexpr double kLeastSkewness = 1e-3;      ///< less is a Gaussian
constexpr int kDecaySteps = 640;             ///< of the integral over the decay
constexpr std::size_t kStepsPerSample = 64;  ///< of a pulse by samples

double gaussian(double x) {
  return std::exp(-0.5 * x * x);
}

/// Values of the pulse of unit standard deviation, kTableStep apart.
std::vector<double> shapeOf(double skewness) {
  const bool decays = skewness >= kLeastSkewness;
  // Moments are added up: variance s^2 + d^2 = 1, third moment 2 d^3 = skewness.
  const double decay = decays ? std::cbrt(0.5 * skewness) : 0.0;
  const double sigma = std::sqrt(1.0 - decay * decay);
  const double reach = 2.0 * kGaussianReach + kDecayReach * decay;
  std::vector<double> values;
  for (double t = -kGaussianReach; t <= reach - kGaussianReach; t += kTableStep) {
    if (!decays) {
      values.push_back(gaussian(t));
      continue;
    }
    double sum = 0.0;
    for (int i = 0; i < kDecaySteps; ++i) {
      const double u = kDecayReach * (i + 0.5) / kDecaySteps;
      sum += std::exp(-u) * gaussian((t - decay * u) / sigma);
    }
    values.push_back(sum);
  }
  return values;
}

std::vector<double> interpolated(const std::vector<double>& samples) {
  const auto sample = [&samples](std::ptrdiff_t i) {
    return i < 0 || i >= static_cast<std::ptrdiff_t>(samples.size())
               ? 0.0
               : samples[static_cast<std::size_t>(i)];
  };
  std::vector<double> values;
  for (std::ptrdiff_t i = -1; i < static_cast<std::ptrdiff_t>(samples.size()); ++i) {
    const double p = sample(i - 1), q = sample(i), r = sample(i + 1), s = sample(i + 2);
    for (std::size_t k = 0; k < kStepsPerSample; ++k) {
      const double u = static_cast<double>(k) / static_cast<double>(kStepsPerSample);
      values.push_back(
          q +
          0.5 * u * (r - p + u * (2.0 * p - 5.0 * q + 4.0 * r - s + u * (3.0 * (q - r) + s - p))));
    }
  }
  values.push_back(0.0);
  return values;
}

}  // namespace

EmittedPulse::EmittedPulse(const WaveformOptions& options) {
  if (options.pulse.empty()) {
    table_ = shapeOf(options.pulse_skewness);
    normalise();
    const double stretch = options.pulse_width / width();
    start_ *= stretch;
    step_ *= stretch;
  } else {
    table_ = interpolated(options.pulse);
    step_ = options.pulse_spacing / static_cast<double>(kStepsPerSample);
    normalise();
  }
}

/// The maximum becomes 1, at the time 0: that of the parabola through the largest three values.
void EmittedPulse::normalise() {
  const auto largest = std::max_element(table_.begin() + 1, table_.end() - 1);
  const double before = largest[-1], top = largest[0], after = largest[1];
  const double curvature = before - 2.0 * top + after;
  const double shift = curvature < 0.0 ? 0.5 * (before - after) / curvature : 0.0;
  const double maximum = top - 0.25 * (before - after) * shift;
  start_ = -step_ * (static_cast<double>(largest - table_.begin()) + shift);
  for (double& value : table_) value /= maximum;
}

double EmittedPulse::leading(double share) const {
  auto i = static_cast<std::size_t>(std::lround(-start_ / step_));
  while (i > 0 && table_[i] >= share) --i;
  const double rest = (share - table_[i]) / (table_[i + 1] - table_[i]);
  return start_ + step_ * (static_cast<double>(i) + rest);
}

double EmittedPulse::trailing(double share) const {
  auto i = static_cast<std::size_t>(std::lround(-start_ / step_));
  while (i + 1 < table_.size() && table_[i] >= share) ++i;
  const double rest = (table_[i - 1] - share) / (table_[i - 1] - table_[i]);
  return start_ + step_ * (static_cast<double>(i - 1) + rest);
}

double EmittedPulse::area() const {
  return step_ * std::accumulate(table_.begin(), table_.end(), 0.0);
}

}  // namespace pcl_als::simulation
