// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace pcl_als {

/// Full width at half maximum of a Gaussian over its standard deviation, 2 sqrt(2 ln 2).
inline constexpr double kFwhmOfGaussian = 2.3548200450309493;

/// Samples of a response, with its maximum, 1, at the time 0.
struct ResponseSamples {
  std::vector<double> values;
  double spacing = 0.0;  ///< samples of the waveform
  int first = 0;         ///< of the values: its time is first * spacing

  double timeOf(std::size_t i) const { return spacing * (first + static_cast<int>(i)); }
  /// Third central moment over the third power of the standard deviation.
  double skewness() const;
};

/** \brief The response of a system to a point target, and its convolution with the Gaussian spread
 * of an extended target.
 *
 * All times are in samples of the waveform. The width u of an echo is the standard deviation of the
 * Gaussian with the full width at half maximum of the response, broadened: u² = u0² + s² for a
 * target that spreads the pulse by s, with the width u0 of the response. The response is normalised
 * to a largest value of 1 at every width; its time is that of the maximum at width u0.
 *
 * Copies share their tables. Const member functions may be called by several threads.
 */
class PulseResponse {
 public:
  /// exp(-t² / (2 u²)). UsageError for a width that is not positive.
  static PulseResponse gaussian(double width);
  /** \brief A response that is given by samples, such as the emitted pulse.
   *
   * \param samples with a baseline of zero at both ends
   * \param spacing of these samples, in samples of the waveform
   * UsageError for fewer than five samples, values that are no numbers, no positive value, a
   * maximum at an end, and a spacing that is not positive.
   */
  static PulseResponse sampled(const std::vector<double>& samples, double spacing);

  bool isGaussian() const { return table_ == nullptr; }
  double width() const { return width_; }       ///< u0, samples
  double leastWidth() const { return least_; }  ///< of an echo, samples
  double largestWidth() const { return largest_; }

  /// Samples before and after the time of an echo of this width in which the response is not zero.
  double before(double width) const;
  double after(double width) const;

  /// The response at a time from that of the echo, for the width u0; 0 outside its reach.
  double valueAt(double time) const;
  /// The response for the width u0, at a quarter of this width: sampled() makes it again.
  ResponseSamples samples() const;
  /// The same response where a sample of the waveform takes 1 / \a ratio of the time.
  PulseResponse stretched(double ratio) const;

  /** \brief Response r of an echo at the samples first, first + 1, …, last - 1, and its
   * derivatives.
   *
   * \param time of the echo, samples
   * \param value,by_time,by_width r, dr/dtime and dr/dwidth; arrays of last - first values
   * The samples must lie within [time - before(width), time + after(width)].
   */
  void evaluate(double time, double width, int first, int last, double* value, double* by_time,
                double* by_width) const;

 private:
  struct Table;
  PulseResponse() = default;

  double width_ = 0.0, least_ = 0.0, largest_ = 0.0;
  std::shared_ptr<const Table> table_;
};

/// A response that was estimated from waveforms (PulseEstimate).
struct EstimatedPulse {
  PulseResponse response;
  /// Single echoes of the commonest width, from which the shape was or would be estimated.
  std::size_t echoes = 0;
  /// How much better the mean shape of one half of these echoes fits the other half than a Gaussian
  /// does: mean of n ln(RSS of the Gaussian / RSS of the shape) over the echoes, each with n
  /// samples, and its standard deviation. About the difference in chi-square. 0 for too few echoes.
  double gain = 0.0, gain_std = 0.0;
};

/// The shape, and what it is from: "skewness 0.61, from 912 single echoes, …".
std::string describe(const EstimatedPulse& pulse);

}  // namespace pcl_als
