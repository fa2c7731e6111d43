// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <vector>

namespace pcl_als {

/** \brief Estimates the width of the response from waveforms: the commonest width of single echoes
 * that are neither weak nor saturated, which is that of hard surfaces across the pulse.
 *
 * Wider echoes come from inclined and rough surfaces; none is narrower. The widths are those of a
 * decomposition with a response of a width that is estimated from the half maxima of the waveforms
 * first and repeated with the result.
 */
class PulseWidthEstimate {
 public:
  /// Takes in a waveform, in digitizer counts, unless it reaches the saturation.
  void add(const std::vector<double>& counts, double saturation);
  std::size_t waveforms() const { return waveforms_.size(); }
  /// Width in samples (PulseResponse::width()); none if fewer than kLeastSingleEchoes waveforms
  /// have a single strong echo.
  std::optional<double> width() const;

  static constexpr std::size_t kLeastSingleEchoes = 20;

 private:
  double halfMaximumWidth() const;

  std::vector<std::vector<double>> waveforms_;
};

/// Middle of the shortest interval that holds a share of the values: the mode of a distribution
/// that is skewed. \pre values is not empty and share lies in (0, 1]
double shortestIntervalMiddle(std::vector<double> values, double share);

}  // namespace pcl_als
