// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/// Digitised waveforms, each with the adjusted waveform, its echoes and, below, the residuals.
/// Times are nanoseconds from the first sample, amplitudes digitizer counts.
struct WaveformPlot {
  struct Echo {
    double time, amplitude;
    bool new_echo;  ///< that the scanner did not return
  };
  struct Panel {
    std::string title;
    double spacing;  ///< of the samples
    std::vector<double> samples;
    std::vector<double> model;  ///< evenly spaced from the first to the last sample
    std::vector<double> residuals;
    double baseline, noise;  ///< noise: standard deviation of a sample
    std::vector<Echo> echoes;
    std::vector<double> returns;  ///< times
  };
  std::string title;
  std::vector<Panel> panels;
};

/// UsageError without panels, for panels without samples, and for a picture that is too small.
Canvas drawWaveforms(const WaveformPlot& plot, PictureSize size = {});

}  // namespace pcl_als
