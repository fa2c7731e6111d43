// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>

#include <pcl_als/processing/waveform_job.h>

namespace pcl_als::detail {

/// decomposeWaveforms() of a Pulse file (.pls) with its Waves file.
WaveformResult decomposePulses(const std::filesystem::path& input,
                               const std::filesystem::path& output,
                               const WaveformSettings& settings, ProgressReport& progress);

}  // namespace pcl_als::detail
