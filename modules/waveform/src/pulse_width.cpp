// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/waveform/pulse_width.h>
#include <pcl_als/waveform/waveform_decomposer.h>

namespace pcl_als {
namespace {

/// Share of the widths in the shortest interval.
constexpr double kShare = 0.3;
/// Standard deviation of a width over the width, above which an echo is too weak.
constexpr double kLargestRelativeStd = 0.05;
constexpr int kRounds = 3;

/// Full width at half maximum of the largest value above the least fifth of a waveform, in samples.
double fullWidth(const std::vector<double>& counts) {
  std::vector<double> sorted = counts;
  const auto base = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 5);
  std::nth_element(sorted.begin(), base, sorted.end());
  const auto top = std::max_element(counts.begin(), counts.end());
  const double half = 0.5 * (*top + *base);
  auto low = top, high = top;
  while (low != counts.begin() && *low > half) --low;
  while (high != counts.end() && *high > half) ++high;
  return static_cast<double>(high - low) - 1.0;
}

}  // namespace

double shortestIntervalMiddle(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const auto within = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::ceil(share * static_cast<double>(n))), 1, n);
  std::size_t best = 0;
  for (std::size_t i = 0; i + within <= n; ++i)
    if (values[i + within - 1] - values[i] < values[best + within - 1] - values[best]) best = i;
  return 0.5 * (values[best] + values[best + within - 1]);
}

void PulseWidthEstimate::add(const std::vector<double>& counts, double saturation) {
  const bool saturated =
      std::any_of(counts.begin(), counts.end(), [saturation](double y) { return y >= saturation; });
  if (!saturated && counts.size() > 5) waveforms_.push_back(counts);
}

double PulseWidthEstimate::halfMaximumWidth() const {
  std::vector<double> widths;
  for (const std::vector<double>& counts : waveforms_) widths.push_back(fullWidth(counts));
  return std::max(1.0, shortestIntervalMiddle(widths, kShare)) / kFwhmOfGaussian;
}

std::optional<double> PulseWidthEstimate::width() const {
  if (waveforms_.size() < kLeastSingleEchoes) return std::nullopt;
  double width = halfMaximumWidth();
  for (int round = 0; round < kRounds; ++round) {
    WaveformDecomposer decomposer(PulseResponse::gaussian(width));
    Decomposition found;
    std::vector<double> widths;
    for (const std::vector<double>& counts : waveforms_) {
      decomposer.decompose(counts.data(), counts.size(), found);
      const WaveformEcho& echo = found.echo[0];
      if (found.count == 1 && echo.width_std < kLargestRelativeStd * echo.width)
        widths.push_back(echo.width);
    }
    if (widths.size() < kLeastSingleEchoes) return std::nullopt;
    width = shortestIntervalMiddle(widths, kShare);
  }
  return width;
}

}  // namespace pcl_als
