// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string_view>

namespace pcl_als::simulation {

/** \brief Variation of the errors of a trajectory with time along a line.
 *
 * Every process has a mean of zero and the standard deviation of NoiseOptions, taken over many
 * lines and the duration of a line; lines and the six components are independent. With tau =
 * NoiseOptions::correlation_time and T the duration of the line:
 */
enum class ErrorProcess {
  gauss_markov,  ///< first order: correlation exp(-|dt| / tau)
  band_limited,  ///< smooth: eight sines of periods from 0.6 tau to 5 tau, random phase and size
  random_walk,   ///< starts with half of the variance and ends with three halves of it
  drift,         ///< a constant and a linear change over the line, half of the variance each
  white,         ///< independent from one sample of the trajectory to the next
  jumps,         ///< constant between jumps to independent values, on average every tau
};

std::string_view nameOf(ErrorProcess process);
/// UsageError listing the names for any other.
ErrorProcess errorProcessNamed(std::string_view name);

}  // namespace pcl_als::simulation
