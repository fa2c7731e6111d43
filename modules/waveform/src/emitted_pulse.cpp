// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/waveform/emitted_pulse.h>

namespace pcl_als {
namespace {

constexpr std::size_t kFewestSamples = 8, kMostSamples = 512;
constexpr std::size_t kEnd = 3;          // samples that an end is judged by
constexpr double kLargestEnd = 0.05;     // of the amplitude
constexpr double kLeastAmplitude = 8.0;  // counts: rounding would shape smaller pulses
constexpr double kShareOfPulses = 0.5;   // of which a sample of the mean consists at least

double meanOf(const double* begin, std::size_t count) {
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += begin[i];
  return sum / static_cast<double>(count);
}

double baselineOf(const std::vector<double>& samples) {
  return std::min(meanOf(samples.data(), kEnd), meanOf(&samples[samples.size() - kEnd], kEnd));
}

/// The band-limited function through the samples less a baseline.
double interpolated(const std::vector<double>& samples, double baseline, double time) {
  double sum = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double x = kPi * (time - static_cast<double>(i));
    sum += (samples[i] - baseline) * (std::abs(x) < 1e-9 ? 1.0 : std::sin(x) / x);
  }
  return sum;
}

}  // namespace

EmittedPulseMean::Sum& EmittedPulseMean::at(int offset) {
  std::vector<Sum>& side = offset < 0 ? before_ : after_;
  const auto index = static_cast<std::size_t>(offset < 0 ? -offset - 1 : offset);
  if (index >= side.size()) side.resize(index + 1);
  return side[index];
}

void EmittedPulseMean::add(const std::vector<double>& counts, double saturation) {
  if (counts.size() < kFewestSamples || counts.size() > kMostSamples) return;
  const auto largest = std::max_element(counts.begin(), counts.end());
  const auto top = static_cast<std::size_t>(largest - counts.begin());
  const double baseline = baselineOf(counts), amplitude = *largest - baseline;
  const bool inside = top >= 2 && top + 2 < counts.size();
  if (!inside || *largest >= saturation || amplitude < kLeastAmplitude) return;
  if (counts[top - 1] <= baseline || counts[top + 1] <= baseline) return;
  const double a = std::log(counts[top - 1] - baseline), b = std::log(amplitude),
               c = std::log(counts[top + 1] - baseline);
  const double curvature = a - 2.0 * b + c;
  const double shift = curvature < 0.0 ? 0.5 * (a - c) / curvature : 0.0;
  const double peak = static_cast<double>(top) + shift;
  const double height = interpolated(counts, baseline, peak);
  const auto last = static_cast<double>(counts.size() - 1);
  for (int k = static_cast<int>(std::ceil(-peak)); peak + k <= last; ++k) {
    Sum& sum = at(k);
    sum.value += interpolated(counts, baseline, peak + k) / height;
    ++sum.count;
  }
  sum_peak_ += peak;
  ++pulses_;
}

std::optional<EmittedPulse> EmittedPulseMean::result() const {
  EmittedPulse mean;
  mean.pulses = pulses_;
  const auto append = [&](const Sum& sum) {
    if (static_cast<double>(sum.count) >= kShareOfPulses * static_cast<double>(pulses_))
      mean.samples.push_back(sum.value / static_cast<double>(sum.count));
  };
  for (auto sum = before_.rbegin(); sum != before_.rend(); ++sum) append(*sum);
  for (const Sum& sum : after_) append(sum);
  if (pulses_ == 0 || mean.samples.size() < kFewestSamples) return std::nullopt;
  const double baseline = baselineOf(mean.samples);
  for (double& sample : mean.samples) sample -= baseline;
  const double ends = std::max(meanOf(mean.samples.data(), kEnd),
                               meanOf(&mean.samples[mean.samples.size() - kEnd], kEnd));
  if (ends > kLargestEnd) return std::nullopt;
  mean.peak = sum_peak_ / static_cast<double>(pulses_);
  return mean;
}

}  // namespace pcl_als
