// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/lidar_system.h>
#include <pcl_als/simulation/simulated_point.h>
#include <pcl_als/simulation/simulation_options.h>

#include "flown_line.h"
#include "pulse_tracer.h"
#include "random.h"

namespace pcl_als::simulation {

/// One channel of the scanner in one strip.
struct Channel {
  Channel(const SimulationOptions& options, const PlannedLine& line, int number)
      : errors(options.errors.of(line.session, line.id, number)),
        true_system(options.mounting, options.scanner.laserFromChannel(number)),
        assumed_system(options.mounting + options.bias + errors.system,
                       options.scanner.laserFromChannel(number)) {}

  double error(ErrorSource source) const { return errors.of(source); }
  /// The angles that the encoder reports, without noise.
  BeamAngles reported(const ScanPattern::Reading& reading) const;

  ErrorValues errors;
  LidarSystem true_system, assumed_system;
};

/// A pulse as it was fired, and as position, attitude and encoder report it.
struct Shot {
  const Channel& channel;
  double time;  ///< true
  Eigen::Vector3d true_origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d true_direction = Eigen::Vector3d::Zero();
  /// Reported, with the true parameters.
  Eigen::Vector3d unbiased_origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d unbiased_direction = Eigen::Vector3d::Zero();
  Eigen::Vector3d assumed_origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d assumed_direction = Eigen::Vector3d::Zero();
  double assumed_heading = 0.0;
};

/// Aims the pulses of a line, and computes points from what is measured of them.
class PulseRun {
 public:
  PulseRun(const SimulationOptions& options, double extinction, const FlownLine& line);

  /// Position and direction of a pulse, true.
  Shot aim(const ScanPattern::Reading& reading) const;
  /// Position and direction as they are reported.
  void report(const ScanPattern::Reading& reading, Random& random, Shot& shot) const;
  /// What all points of a pulse have in common.
  SimulatedPoint startPoint(const ScanPattern::Reading& reading, const Shot& shot) const;
  /// Number of an echo with this signal, without noise.
  double numberOf(double signal, double range) const;
  /// A range plus the errors of a detector that depend on the echo: range walk and incidence.
  double withDetectionError(double range, const Shot& shot, const Echo& echo,
                            double intensity) const;
  /// Computes the coordinates of an echo from its range and the error of its measurement.
  void place(const Shot& shot, const Echo& echo, double measurement_error, double number,
             SimulatedPoint& point) const;

  const SimulationOptions& options() const { return options_; }
  const FlownLine& line() const { return line_; }
  /// Start of the random numbers of a pulse.
  Random randomOf(std::uint64_t pulse) const {
    return Random(keyOf({options_.seed, 0x9015E, line_.plan().id, pulse}));
  }

 private:
  /// As GNSS/INS sees it, without the systematic shift of the trajectory.
  Pose poseAt(double time) const {
    return options_.noise.trajectory() ? line_.noisyPose(time) : line_.truePose(time);
  }

  const SimulationOptions& options_;
  double extinction_;
  const FlownLine& line_;
  double refraction_;  ///< error of all ranges, relative
  std::vector<Channel> channels_;
};

/// Fires pulses whose returns are formed by energy and separation, without waveforms.
class DiscreteRun {
 public:
  DiscreteRun(const SimulationOptions& options, double extinction, const Scene& scene,
              const FlownLine& line)
      : run_(options, extinction, line), tracer_(scene, options.scanner, options.noise.footprint) {}

  void fire(std::uint64_t pulse, std::vector<SimulatedPoint>& points);

 private:
  void record(const Shot& shot, const Echo& echo, Random& random, SimulatedPoint& point) const;

  PulseRun run_;
  PulseTracer tracer_;
};

}  // namespace pcl_als::simulation
