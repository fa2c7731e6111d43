// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>

#include <pcl_als/processing/simulated_survey.h>

namespace pcl_als::detail {

/** \brief Simulates one strip with its waveforms: a LAS file (1.3 for point formats 4 and 5, 1.4
 * for 9 and 10) and its packets in a .wdp file beside it.
 *
 * Descriptor k describes 64 · 2^(k - 1) samples. Samples are stored in the next whole number of
 * bytes. The parametric direction points to the sensor.
 */
StripSummary writeWaveformStrip(const simulation::Simulator& simulator, std::size_t strip,
                                const StripFileOptions& options, int threads,
                                const std::function<void(double share)>& progress);

}  // namespace pcl_als::detail
