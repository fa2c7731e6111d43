// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "return_detector.h"

#include <algorithm>

#include <pcl_als/simulation/simulated_waveforms.h>

namespace pcl_als::simulation {

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

void ReturnDetector::accept(const std::uint16_t* counts, std::size_t samples, std::size_t valley,
                            std::size_t peak) {
  const double spacing = receiver_.options().sample_spacing, baseline = receiver_.baseline();
  const double foot = footOf(counts[valley]), top = counts[peak];
  const double level = foot + receiver_.options().detection_edge * (top - foot);
  std::size_t i = peak;
  while (i > valley && counts[i - 1] >= level) --i;
  double crossing = static_cast<double>(i);
  if (i > valley) crossing -= (counts[i] - level) / (counts[i] - counts[i - 1]);
  const double time = spacing * crossing + edge_to_maximum_;
  if (!returns_.empty() && time - returns_.back().time < blind_) return;

  double height = top - baseline;
  if (peak > 0 && peak + 1 < samples && top < receiver_.options().largestCount()) {
    const double before = counts[peak - 1], after = counts[peak + 1];
    const double curvature = before - 2.0 * top + after;
    if (curvature < 0.0) height -= (before - after) * (before - after) / (8.0 * curvature);
  }
  returns_.push_back({time, spacing * static_cast<double>(peak), height});
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
