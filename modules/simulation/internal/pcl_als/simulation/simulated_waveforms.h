// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/backscatter.h>
#include <pcl_als/simulation/simulated_point.h>

namespace pcl_als::simulation {

/// Speed of light in vacuum, metres per nanosecond. Ranges are converted to times with it.
inline constexpr double kLightSpeed = 0.299792458;

/// A pulse with its waveform; its parts are in the vectors of SimulatedWaveforms.
struct SimulatedPulse {
  std::uint64_t number = 0;   ///< in its line
  double first_sample = 0.0;  ///< time of the first sample after the emission, nanoseconds
  Eigen::Vector3d to_sensor;  ///< unit vector against the beam, as reported; ground frame
  Eigen::Vector3d true_origin, true_direction;  ///< of the pulse, local frame of the scene
  std::size_t point = 0, points = 0;            ///< first and number of its returns
  std::size_t count = 0, counts = 0;            ///< first and number of its samples
  std::size_t part = 0, parts = 0;              ///< first and number of its backscatter
};

/// Consecutive pulses that have returns. A chunk of memory, used again and again.
struct SimulatedWaveforms {
  std::vector<SimulatedPulse> pulses;
  std::vector<SimulatedPoint> points;
  /// Of each point, picoseconds from the first sample of its waveform: the time of its position.
  std::vector<float> locations;
  std::vector<std::uint16_t> counts;     ///< samples, digitizer counts
  std::vector<Backscatter> backscatter;  ///< the truth, near to far within a pulse, if asked for

  void clear() {
    pulses.clear();
    points.clear();
    locations.clear();
    counts.clear();
    backscatter.clear();
  }
};

}  // namespace pcl_als::simulation
