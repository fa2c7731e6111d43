// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/simulation/simulated_waveforms.h>

#include "footprint_tracer.h"
#include "pulse_run.h"
#include "return_detector.h"
#include "waveform_receiver.h"

namespace pcl_als::simulation {

/// Fires pulses whose waveforms are recorded, with the returns that are detected in them.
class WaveformRun {
 public:
  /// \param truth keeps the backscatter of every pulse
  WaveformRun(PulseRun run, const Scene& scene, const WaveformReceiver& receiver, bool truth);
  WaveformRun(const WaveformRun&) = delete;
  WaveformRun& operator=(const WaveformRun&) = delete;

  /// Appends a pulse, unless nothing of it is detected.
  void fire(std::uint64_t pulse, SimulatedWaveforms& out);

 private:
  void receive(const std::vector<Backscatter>& parts, double energy);
  Echo surfacesAt(const std::vector<Backscatter>& parts, double time) const;
  /// \param first_sample nanoseconds after the emission; \param timing error of ranges, metres
  void addReturns(const ScanPattern::Reading& reading, const Shot& shot,
                  const std::vector<Backscatter>& parts, const std::vector<DetectedReturn>& returns,
                  double first_sample, double timing, SimulatedWaveforms& out) const;

  PulseRun run_;
  FootprintTracer tracer_;
  WaveformReceiver receiver_;
  ReturnDetector detector_;
  bool truth_;
  std::vector<ReceivedPower> power_;
};

}  // namespace pcl_als::simulation
