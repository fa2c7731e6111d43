// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/fields.h>
#include <pcl_als/processing/waveform_job.h>

namespace pcl_als {

/// A decomposition of waveforms, and its files.
struct WaveformReport {
  const WaveformResult* result = nullptr;
  std::string input, output;
};

/// The fields of waveform.json, of a WaveformReport.
const FieldTable& waveformFields();
/// Those of one of its waveforms, which can be read, too.
const Fields<WaveformExample>& waveformExampleFields();
/// The content of waveform.json.
std::string waveformJson(const WaveformReport& report);

}  // namespace pcl_als
