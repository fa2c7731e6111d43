// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "waveform_receiver.h"

namespace pcl_als::simulation {

/// Return that the detector reports.
struct DetectedReturn {
  double time = 0.0;       ///< nanoseconds from the first sample, of the maximum of the echo
  double peak_time = 0.0;  ///< the same, of the largest sample
  double height = 0.0;     ///< counts above the baseline
};

/** \brief Detector of discrete returns in a waveform, as scanners have it in their electronics.
 *
 * A peak rises by the threshold above the lowest sample before it and falls by it behind. Its time
 * is that at which the leading edge crosses a share of the rise, interpolated between samples, plus
 * the time from there to the maximum of the emitted pulse. The detector is blind for a while after
 * a return. It does not correct for the width of an echo: a stretched echo is detected too early.
 */
class ReturnDetector {
 public:
  /// \param separation metres in which a second return is not detected
  ReturnDetector(const WaveformReceiver& receiver, double separation, int most_returns);

  /// Near to far.
  const std::vector<DetectedReturn>& detect(const std::uint16_t* counts, std::size_t samples);

 private:
  double footOf(double valley) const;
  double topOf(const std::uint16_t* counts, std::size_t samples, std::size_t peak,
               double foot) const;
  void accept(const std::uint16_t* counts, std::size_t samples, std::size_t valley,
              std::size_t peak);

  const WaveformReceiver& receiver_;
  double threshold_, blind_;  ///< counts, nanoseconds
  double edge_to_maximum_;    ///< nanoseconds
  std::size_t most_;
  std::vector<DetectedReturn> returns_;
};

}  // namespace pcl_als::simulation
