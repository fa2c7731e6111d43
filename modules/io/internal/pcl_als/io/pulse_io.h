// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <vector>

namespace pcl_als {

/// Samples of the pulse of a laser as its receiver records it.
struct PulseSamples {
  double spacing_ns = 0.0;
  double first_ns = 0.0;  ///< time of the first value
  std::vector<double> values;
};

/** \brief Reads a pulse: CSV with the columns time_ns and value.
 *
 * InputError for fewer than five samples and for times that are not evenly spaced and growing.
 */
PulseSamples readPulse(const std::filesystem::path& path);
/// Writes what readPulse() reads; InputError if the file cannot be written.
void writePulse(const std::filesystem::path& path, const PulseSamples& pulse);

}  // namespace pcl_als
