// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

namespace pcl_als::detail {

/// A waveform with one echo, aligned by its time.
struct AlignedEcho {
  const std::vector<double>* counts = nullptr;
  double amplitude = 0.0;  ///< digitizer counts
  double time = 0.0;       ///< samples
};

struct AveragedPulse {
  std::vector<double> values;  ///< largest value 1, about
  double spacing = 0.0;        ///< samples of the waveform
};

/** \brief The mean shape of echoes, on a finer grid than their samples.
 *
 * The samples are y = b + A r(i - t) + e with the amplitude A and time t of their echo and an
 * unknown baseline b of each waveform. The response r is a spline of the fifth degree with
 * equidistant knots. Its coefficients follow from least squares over all waveforms, with the
 * weights of Huber, so that other echoes in a few of the waveforms have little influence. The ends
 * in which r does not differ significantly from zero are cut off; what is left has a margin of
 * zeros.
 *
 * \param echoes at least one
 * \param width standard deviation of the Gaussian with the full width at half maximum of the
 * response, samples
 * \param knot_spacing distance of the knots, in this width
 * \return no values if the echoes do not determine the response
 */
AveragedPulse averagePulse(const std::vector<AlignedEcho>& echoes, double width,
                           double knot_spacing);

}  // namespace pcl_als::detail
