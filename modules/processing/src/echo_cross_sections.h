// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/pulse_echoes.h>

#include "waveform_pulses.h"

namespace pcl_als::detail {

/// Cross sections of the echoes of one pulse, in order of time.
struct PulseSections {
  bool covered = false;  ///< by the trajectory, and below the sensor; otherwise the rest is empty
  std::vector<double> cross_section, coefficient;
  std::vector<double> transmission;  ///< that both were divided by; 1: not corrected
};

/** \brief Computes cross sections of the echoes of a file with the ranges from a trajectory.
 *
 * Const member functions may be called by several threads.
 */
class EchoCrossSections {
 public:
  /// UsageError for a model out of range; InputError for a file without GPS time, times that the
  /// trajectory cannot have, and points that it cannot have measured.
  EchoCrossSections(const LasFile& las, const CrossSectionSettings& settings);

  /// Estimates the calibration constant from targets and the coefficient of the whole pulse from
  /// single echoes, as the settings ask for them. InputError if that is not possible.
  void calibrate(const WaveformSource& source, const std::map<unsigned, PulseResponse>& responses,
                 const EchoSettings& echo_settings);
  const CrossSectionResult& result() const { return result_; }

  /// \param echoes of the pulse \param node position on the trajectory of the pulse before, 0 at
  /// first
  void evaluate(const WaveformPulse& pulse, const PulseEchoes& echoes, std::size_t& node,
                PulseSections& out) const;

 private:
  struct Sight {
    double range = 0.0, cosine = 0.0;  ///< metres; of the angle to the vertical
  };
  Eigen::Vector3d positionOf(const std::byte* record) const {
    return LasRecordLayout::positionOf(record, metres_.scale, metres_.offset);
  }
  bool sightOf(const std::byte* record, std::size_t& node, Sight& sight) const;
  void requireReach() const;
  void useTargets(const ReferenceCalibration& calibration);

  const LasFile& las_;
  const CrossSectionSettings& settings_;
  LasScaling metres_;
  Eigen::Vector3d metres_per_unit_;
  TimeAlignment times_;
  CrossSectionModel model_;
  CrossSectionResult result_;
};

}  // namespace pcl_als::detail
