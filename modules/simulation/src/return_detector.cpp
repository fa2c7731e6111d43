// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "return_detector.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/simulation/simulated_waveforms.h>

namespace pcl_als::simulation {

namespace {

constexpr int kBisections = 20;  ///< of the time between two samples

/// Where the cubic polynomial through four samples crosses a level between \a i and the next one,
/// of which the first is below the level and the second is not.
double crossingOf(const std::uint16_t* counts, std::size_t samples, std::size_t i, double level) {
  const double b = counts[i], c = counts[i + 1], a = i > 0 ? counts[i - 1] : b,
               d = i + 2 < samples ? counts[i + 2] : c;
  double low = 0.0, high = 1.0;
  for (int k = 0; k < kBisections; ++k) {
    const double u = 0.5 * (low + high), l = u + 1.0, m = u - 1.0, n = u - 2.0;
    const double value =
        -a * u * m * n / 6.0 + b * l * m * n / 2.0 - c * l * u * n / 2.0 + d * l * u * m / 6.0;
    (value < level ? low : high) = u;
  }
  return static_cast<double>(i) + 0.5 * (low + high);
}

}  // namespace

ReturnDetector::ReturnDetector(const WaveformReceiver& receiver, double separation,
                               int most_returns)
    : receiver_(receiver),
      threshold_(receiver.options().detection_threshold * receiver.noise()),
      blind_(2.0 * separation / kLightSpeed),
      edge_to_maximum_(-receiver.pulse().leading(receiver.options().detection_edge)),
      most_(static_cast<std::size_t>(most_returns)) {}

/// Noise goes below the baseline before an echo: that is no valley.
double ReturnDetector::footOf(double valley) const {
  return std::max(valley, receiver_.baseline());
}

/// Maximum of the Gaussian above the foot through a peak and its neighbours; a saturated peak is
/// flat.
double ReturnDetector::topOf(const std::uint16_t* counts, std::size_t samples, std::size_t peak,
                             double foot) const {
  const double top = counts[peak];
  if (peak == 0 || peak + 1 >= samples || top >= receiver_.options().largestCount()) return top;
  if (counts[peak - 1] <= foot || counts[peak + 1] <= foot) return top;
  const double before = std::log(counts[peak - 1] - foot), middle = std::log(top - foot),
               after = std::log(counts[peak + 1] - foot);
  const double curvature = before - 2.0 * middle + after;
  if (curvature >= 0.0) return top;
  return foot + std::exp(middle - (before - after) * (before - after) / (8.0 * curvature));
}

void ReturnDetector::accept(const std::uint16_t* counts, std::size_t samples, std::size_t valley,
                            std::size_t peak) {
  const double spacing = receiver_.options().sample_spacing;
  const double foot = footOf(counts[valley]), top = topOf(counts, samples, peak, foot);
  const double level = foot + receiver_.options().detection_edge * (top - foot);
  std::size_t i = peak;
  while (i > valley && counts[i - 1] >= level) --i;
  const double crossing =
      i > valley ? crossingOf(counts, samples, i - 1, level) : static_cast<double>(i);
  const double time = spacing * crossing + edge_to_maximum_;
  if (!returns_.empty() && time - returns_.back().time < blind_) return;
  returns_.push_back({time, spacing * static_cast<double>(peak), top - receiver_.baseline()});
}

const std::vector<DetectedReturn>& ReturnDetector::detect(const std::uint16_t* counts,
                                                          std::size_t samples) {
  returns_.clear();
  std::size_t valley = 0, peak = 0;
  bool rising = false;
  for (std::size_t i = 1; i < samples && returns_.size() < most_; ++i) {
    const double value = counts[i];
    if (rising) {
      if (value > counts[peak]) peak = i;
      if (value > counts[peak] - threshold_) continue;
      accept(counts, samples, valley, peak);
      rising = false;
      valley = i;
    } else if (value <= counts[valley]) {
      valley = i;
    } else if (value >= footOf(counts[valley]) + threshold_) {
      rising = true;
      peak = i;
    }
  }
  return returns_;
}

}  // namespace pcl_als::simulation
