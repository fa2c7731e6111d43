// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <map>
#include <string>

#include <pcl_als/processing/waveform_job.h>

namespace pcl_als::detail {

/// Fills in WaveformResult::pulses and the samples of the response.
/// \param given origin of responses that were not estimated, as text
void describePulses(const ResponseChoice& choice,
                    const std::map<unsigned, WaveformDescriptor>& descriptors,
                    const std::string& given, WaveformResult& result);

}  // namespace pcl_als::detail
