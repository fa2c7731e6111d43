// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/simulation/lidar_system.h>
#include <pcl_als/simulation/simulation_options.h>

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
  std::uint64_t pulseCount() const { return pulse_count_; }
  double pulseRate() const { return pulse_rate_; }         ///< Hz
  double scanLineRate() const { return scan_line_rate_; }  ///< sweeps per second, both ways counted

  double timeOf(std::uint64_t pulse) const {
    return first_time_ + kLead + static_cast<double>(pulse) / pulse_rate_;
  }
  Pose truePose(double time) const { return interpolate(true_, time); }
  Pose writtenPose(double time) const { return interpolate(written_, time); }

  /// The tables in the ground frame.
  void append(const Eigen::Vector3d& origin, bool written,
              std::vector<TrajectorySample>& samples) const;

 private:
  Pose interpolate(const std::vector<Pose>& table, double time) const;
  void addErrors(const NoiseOptions& noise, std::uint64_t key);

  PlannedLine plan_;
  double first_time_, rate_, pulse_rate_ = 0.0, scan_line_rate_ = 0.0;
  std::uint64_t pulse_count_ = 0;
  std::vector<Pose> true_, written_;
};

/// The mirror: constant angular rate from edge to edge and back.
class ScanPattern {
 public:
  ScanPattern(const FlownLine& line, double field_of_view)
      : sweeps_per_pulse_(line.scanLineRate() / line.pulseRate()), half_(0.5 * field_of_view) {}

  struct Reading {
    double angle;         ///< radians, left of flight positive
    bool to_right, last;  ///< the mirror moves to the right; last pulse of its sweep
  };
  Reading at(std::uint64_t pulse) const;

 private:
  double sweeps_per_pulse_, half_;
};

}  // namespace pcl_als::simulation
