// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <pcl_als/waveform/pulse_response.h>

namespace pcl_als {

/** \brief Estimates the response from waveforms: from single echoes of the commonest width, which
 * is that of hard surfaces across the pulse, and which are neither weak nor saturated.
 *
 * Wider echoes come from inclined and rough surfaces; none is narrower. The echoes are aligned by a
 * decomposition with the present response, and the next response is fitted to their samples by
 * least squares, until it does not change. The first one is a Gaussian with the width of the half
 * maxima of the waveforms. In each half of the echoes the result of the other half is compared with
 * a Gaussian. If it does not fit significantly better, the response is a Gaussian, with the
 * commonest width of single echoes that a decomposition with this Gaussian finds.
 */
class PulseEstimate {
 public:
  /// Takes in a waveform, in digitizer counts, unless it reaches the saturation.
  void add(const std::vector<double>& counts, double saturation);
  std::size_t waveforms() const { return waveforms_.size(); }
  /// None if fewer than kLeastSingleEchoes waveforms have a single strong echo.
  std::optional<EstimatedPulse> estimate() const;

  static constexpr std::size_t kLeastSingleEchoes = 20;
  /// Fewer echoes of the commonest width do not give a shape.
  static constexpr std::size_t kLeastEchoesOfShape = 100;

 private:
  std::vector<std::vector<double>> waveforms_;
};

}  // namespace pcl_als
