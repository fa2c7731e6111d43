// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_als {

/// The mean of emitted pulses, at the spacing of their samples.
struct EmittedPulse {
  std::vector<double> samples;  ///< largest value about 1, baseline 0 at both ends
  double peak = 0.0;            ///< mean time of the maxima, samples from the first one
  std::size_t pulses = 0;       ///< in the mean
};

/** \brief Averages the samples of emitted pulses, each shifted to the time of its maximum and
 * divided by its amplitude.
 *
 * The time of a maximum is that of the parabola through the logarithms of the three largest
 * samples, which is exact for a Gaussian. Between samples a pulse is the band-limited function
 * (sum of sinc functions) through them. The baseline is the lesser of the means of the three
 * samples at both ends.
 */
class EmittedPulseMean {
 public:
  /// Takes in a pulse, unless it is saturated, smaller than 8 counts, shorter than 8 or longer than
  /// 512 samples, or has its maximum near an end.
  void add(const std::vector<double>& counts, double saturation);
  std::size_t pulses() const { return pulses_; }
  /// None if there are no pulses, or if they were cut off: the mean of the three samples at an end
  /// exceeds a twentieth of the amplitude.
  std::optional<EmittedPulse> result() const;

 private:
  /// Sums of values at whole samples from the maximum, and how many pulses have them.
  struct Sum {
    double value = 0.0;
    std::size_t count = 0;
  };
  Sum& at(int offset);

  std::vector<Sum> before_, after_;  ///< offsets -1, -2, … and 0, 1, …
  double sum_peak_ = 0.0;
  std::size_t pulses_ = 0;
};

}  // namespace pcl_als
