// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>

#include <pcl_als/simulation/lidar_system.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

/** \brief When and where to the pulses of a line are fired.
 *
 * Pulses are numbered in order of time. The channels fire in turn. The rates follow from density
 * and speed: the pulses of a channel are as far apart along a sweep as its sweeps are along the
 * flight (conical: as far apart along the circle as the arcs, fore and aft counted, are below the
 * flight path).
 */
class ScanPattern {
 public:
  ScanPattern(const PlannedLine& line, const ScannerOptions& scanner);

  struct Reading {
    double time;  ///< seconds since the first pulse
    int channel;
    BeamAngles beam;
    bool to_right, last;  ///< the beam moves to the right; the last pulse of its sweep
  };
  Reading at(std::uint64_t pulse) const;

  double pulseRate() const { return pulse_rate_; }  ///< Hz, mean, of all channels
  double sweepsPerSecond() const {
    return sweep_rate_;
  }  ///< of one channel; conical: revolutions;
     ///< rosette: petals
  std::uint64_t pulseCount() const { return pulse_count_; }

 private:
  /// Sweeps (revolutions, petals) since the first pulse.
  double phaseOf(std::uint64_t pulse) const {
    return static_cast<double>(pulse) * (sweep_rate_ / pulse_rate_);
  }
  void readSweep(std::uint64_t pulse, Reading& reading) const;
  void readRound(std::uint64_t pulse, Reading& reading) const;
  /// Unit vector of a pulse of a conical or rosette scanner, right-forward-up.
  Eigen::Vector3d roundBeam(double phase) const;

  ScannerOptions scanner_;
  double half_, pulse_rate_, sweep_rate_;
  std::uint64_t pulse_count_;
};

/// Angles of a unit vector (right-forward-up) that looks down.
BeamAngles anglesOf(const Eigen::Vector3d& beam);
/// The same azimuth, with the angle from the vertical multiplied by a factor.
BeamAngles deflectedMore(const BeamAngles& beam, double factor);

}  // namespace pcl_als::simulation
