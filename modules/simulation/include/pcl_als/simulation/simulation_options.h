// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/simulation/error_process.h>

namespace pcl_als::simulation {

/// Standard deviations of the errors of the measurements; all zero: no errors.
struct NoiseOptions {
  double range = 0.0;       ///< metres, white, one value per return
  double scan_angle = 0.0;  ///< radians, white, error of the mirror encoder per pulse
  double position = 0.0;    ///< metres per axis, trajectory
  double roll_pitch = 0.0;  ///< radians, trajectory
  double heading = 0.0;     ///< radians, trajectory
  ErrorProcess process = ErrorProcess::gauss_markov;  ///< of the trajectory errors
  double correlation_time = 20.0;                     ///< seconds, of the trajectory errors
  double intensity = 0.0;                             ///< relative, white, one value per return
  double control = 0.0;                               ///< metres, heights of the control points
  bool footprint = false;  ///< returns are formed over the beam's footprint, not along its axis

  bool trajectory() const { return position > 0.0 || roll_pitch > 0.0 || heading > 0.0; }

  /// "none"; "range": 2 cm, nothing else; "realistic": range 2 cm, encoder 3 arcsec, intensity 3 %,
  /// control 1 cm, footprint, trajectory 1.5 cm, 8 arcsec roll and pitch, 16 arcsec heading over
  /// 20 s. UsageError for another name.
  static NoiseOptions named(std::string_view level);
};

/// Laser unit: an oscillating mirror with constant angular rate (zig-zag on the ground).
struct ScannerOptions {
  double field_of_view = 40.0 * kRadiansPerDegree;  ///< full angle, radians, (0, 75 degrees]
  double divergence = 0.33e-3;        ///< full angle between the 1/e^2 points of the beam, radians
  int max_returns = 5;                ///< per pulse, 1 … 15
  double return_separation = 1.5;     ///< metres: closer echoes are merged
  double detection_threshold = 0.05;  ///< share of the pulse's energy of the weakest return
  double gain = 10000.0;  ///< digital number of a full-footprint target of reflectance 1, normal to
                          ///< the beam, at 1000 m in vacuum
  double range_exponent = 2.0;      ///< signal falls with range to this power
  double incidence_exponent = 1.0;  ///< of surfaces (not leaves): 1 Lambertian
};

/// Air between sensor and ground, at 1064 nm.
struct AtmosphereOptions {
  double visibility_km = 48.3;
  double temperature_c = 29.8;
  double pressure_kpa = 101.81;
};

/// One planned flight line; coordinates relative to SimulationOptions::origin.
struct PlannedLine {
  std::uint16_t id = 1;                             ///< point source id
  Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< position of the first pulse, metres
  Eigen::Vector2d end = Eigen::Vector2d::Zero();
  double height = 1000.0;  ///< metres above the origin's height (mean terrain)
  double speed = 60.0;     ///< metres per second
  double density = 1.0;    ///< pulses per square metre, mean over the nominal swath
  double gain = 1.0;       ///< factor on the scanner's gain while this line is flown
};

struct SceneOptions {
  double relief = 1.0;     ///< factor on the heights of the terrain, 0: a horizontal plane
  double buildings = 1.0;  ///< factor on their number, 0: none; at most 2
  double trees = 1.0;      ///< factor on their number, 0: none; at most 4
};

/** \brief All options of a simulation. Equal options give equal points for any number of threads.
 *
 * Biases are assumed - true (Habib et al. 2011, Eq. (8)): the system has the parameters `mounting`,
 * the points are computed with `mounting + bias`.
 */
struct SimulationOptions {
  std::string name;                                     ///< of the preset
  Eigen::Vector3d origin{700000.0, 5660000.0, 1000.0};  ///< block centre, ground frame, metres
  std::string crs = "EPSG:32611";
  std::uint64_t seed = 1;
  double start_time = 401000.0;    ///< GPS seconds of week of the first trajectory sample
  double trajectory_rate = 200.0;  ///< Hz
  double line_interval = 240.0;    ///< seconds without trajectory between two lines
  bool vertical = false;           ///< no attitude motion, no crab
  double attitude_amplitude = 0.5 * kRadiansPerDegree;  ///< largest roll, and pitch about its mean
  double mean_pitch = 1.0 * kRadiansPerDegree;
  double largest_crab = 3.0 * kRadiansPerDegree;
  int control_points = 37;
  SystemVector mounting = SystemVector::Zero();  ///< true parameters (scale: difference from 1)
  SystemVector bias = SystemVector::Zero();      ///< assumed - true, internal units
  NoiseOptions noise;
  ScannerOptions scanner;
  AtmosphereOptions atmosphere;
  SceneOptions scene;
  std::vector<PlannedLine> lines;
  std::vector<std::pair<int, int>> pairs;  ///< ids of the lines planned to overlap

  /// "paper" (six lines of Habib et al. 2011 over 1 km x 2 km, 11 million pulses) or "small" (five
  /// lines, 0.9 million), or "uav" (eight lines of a drone 75 m above ground at 6 m/s, 30 m apart,
  /// 1.5 million), with the paper's kind of biases and no noise. \a scale multiplies the
  /// lengths of the lines, \a density the pulses per square metre; the lines are spaced so that
  /// their overlaps hold for the \a field_of_view (radians). UsageError for another name or a value
  /// out of range.
  static SimulationOptions preset(std::string_view name, double scale = 1.0, double density = 1.0,
                                  double field_of_view = ScannerOptions().field_of_view);

  /// UsageError naming the first value that is impossible.
  void check() const;
};

using pcl_als::setBiases;

}  // namespace pcl_als::simulation
