// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/simulation/lidar_system.h>
#include <pcl_als/simulation/simulation_options.h>

#include "scan_pattern.h"

namespace pcl_als::simulation {

/** \brief One line as it was flown, and as GNSS/INS saw it.
 *
 * Both are tables at the trajectory rate, local frame; between its samples the aircraft moves and
 * turns linearly, which at 200 Hz is within a few micrometres of the smooth motion they sample.
 * The trajectory reaches kLead before the first and after the last pulse.
 */
class FlownLine {
 public:
  static constexpr double kLead = 3.0;  ///< seconds

  /// \param wind direction it blows to, radians clockwise from north: crab is largest across it
  FlownLine(const PlannedLine& plan, const SimulationOptions& options, double first_time,
            double wind);

  const PlannedLine& plan() const { return plan_; }
  double firstTime() const { return first_time_; }
  double lastTime() const;
  const ScanPattern& pattern() const { return pattern_; }
  double firstPulseTime() const { return first_time_ + kLead; }

  Pose truePose(double time) const { return interpolate(true_, time); }
  /// With the random errors of GNSS/INS.
  Pose noisyPose(double time) const { return interpolate(noisy_, time); }
  /// Systematic shift of the delivered trajectory (offset and jump of ErrorSources), metres.
  Eigen::Vector3d shiftAt(double time) const;

  /// The tables in the ground frame; \a written: as delivered, with all errors.
  void append(const Eigen::Vector3d& origin, bool written,
              std::vector<TrajectorySample>& samples) const;

 private:
  Pose interpolate(const std::vector<Pose>& table, double time) const;
  void addErrors(const NoiseOptions& noise, std::uint64_t key);

  PlannedLine plan_;
  ScanPattern pattern_;
  double first_time_, rate_;
  Eigen::Vector3d offset_, jump_;
  std::vector<Pose> true_, noisy_;
};

}  // namespace pcl_als::simulation
