// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/simulation/waveform_options.h>

namespace pcl_als::simulation {

namespace {

constexpr std::size_t kFewestSamples = 5;

void requireWithin(double value, double least, double most, const std::string& what) {
  if (!(value >= least && value <= most))
    throw UsageError("simulation: the " + what + " must be from " + shortText(least) + " to " +
                     shortText(most));
}

void checkPulse(const std::vector<double>& pulse) {
  if (pulse.size() < kFewestSamples)
    throw UsageError("simulation: a pulse needs five samples or more");
  if (!std::all_of(pulse.begin(), pulse.end(), [](double v) { return std::isfinite(v); }))
    throw UsageError("simulation: a sample of the pulse is no number");
  const auto largest = std::max_element(pulse.begin(), pulse.end());
  if (!(*largest > 0.0) || largest == pulse.begin() || largest == pulse.end() - 1)
    throw UsageError("simulation: the pulse needs a positive maximum between its ends");
}

}  // namespace

void WaveformOptions::check() const {
  requireWithin(pulse_width, 0.1, 100.0, "pulse width (ns)");
  requireWithin(pulse_skewness, 0.0, 1.5, "skewness of the pulse");
  requireWithin(pulse_spacing, 0.001, 100.0, "spacing of the samples of the pulse (ns)");
  if (!pulse.empty()) checkPulse(pulse);
  requireWithin(sample_spacing, 0.05, 100.0, "spacing of samples (ns)");
  const double picoseconds = 1000.0 * sample_spacing;
  if (std::abs(picoseconds - std::round(picoseconds)) > 1e-6)
    throw UsageError("simulation: the spacing of samples must be whole picoseconds");
  requireWithin(bits, 4, 16, "number of bits of a sample");
  requireWithin(baseline, 0.0, 0.5, "baseline (share of the largest count)");
  requireWithin(noise, 0.0, 0.2, "noise of samples (share of the largest count)");
  requireWithin(full_scale, 1.0, 1e9, "digital number of the full scale");
  requireWithin(detection_threshold, 1.0, 1000.0, "detection threshold (standard deviations)");
  requireWithin(detection_edge, 0.1, 0.9, "share of the height at the leading edge");
  requireWithin(rings, 1, 20, "number of rings of sub-rays");
}

}  // namespace pcl_als::simulation
