// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/simulation/simulator.h>

namespace pcl_als::benchmark {

/// An echo or return of a pulse: as found, not as true.
struct FoundEcho {
  double range = 0.0;      ///< metres from the firing point
  double amplitude = 0.0;  ///< digitizer counts; of returns without an echo NaN
  double width = 0.0;      ///< full width at half maximum, nanoseconds
  double range_std = 0.0;  ///< metres
  bool is_new = false;     ///< no return of the detector
};

/// What was found in the waveform of a pulse, and the truth.
struct DecomposedPulse {
  const simulation::SimulatedWaveforms& truth;
  const simulation::SimulatedPulse& pulse;
  std::vector<double> returns;    ///< ranges by the detector of discrete returns, metres
  std::vector<FoundEcho> echoes;  ///< of the decomposition
};

struct DecomposedStrip {
  WaveformResult result;
  std::uint64_t points_before = 0, points_after = 0;
};

/** \brief Simulates the first strip into a folder, decomposes its waveforms as pcl_als_waveform
 * does, and goes through its pulses.
 *
 * The truth is that of a second simulation in memory, whose pulses are those of the file in the
 * same order.
 */
DecomposedStrip decomposeSimulated(const simulation::SimulationOptions& options,
                                   const std::filesystem::path& folder,
                                   const WaveformSettings& settings,
                                   const std::function<void(const DecomposedPulse&)>& take);

}  // namespace pcl_als::benchmark
