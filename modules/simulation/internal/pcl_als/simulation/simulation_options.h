// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/simulation/error_process.h>
#include <pcl_als/simulation/error_sources.h>
#include <pcl_als/simulation/scanner_options.h>
#include <pcl_als/simulation/waveform_options.h>

namespace pcl_als::simulation {

/// Standard deviations of the errors of the measurements; all zero: no errors.
struct NoiseOptions {
  double range = 0.0;       ///< metres, white, one value per return
  double refraction = 0.0;  ///< of the range: refractive index, one value per session
  double scan_angle = 0.0;  ///< radians, white, error of the mirror encoder per pulse
  double position = 0.0;    ///< metres per axis, trajectory
  double roll_pitch = 0.0;  ///< radians, trajectory
  double heading = 0.0;     ///< radians, trajectory
  ErrorProcess process = ErrorProcess::gauss_markov;  ///< of the trajectory errors
  double correlation_time = 20.0;                     ///< seconds, of the trajectory errors
  double intensity = 0.0;                             ///< relative, white, one value per return
  double control = 0.0;    ///< metres, heights of control points, coordinates of targets
  bool footprint = false;  ///< returns are formed over the beam's footprint, not along its axis

  bool trajectory() const { return position > 0.0 || roll_pitch > 0.0 || heading > 0.0; }

  /// "none"; "range": 2 cm, nothing else; "realistic": range 2 cm, encoder 3 arcsec, refractive
  /// index 3 ppm, intensity 3 %, control 1 cm, footprint, trajectory 1.5 cm, 8 arcsec roll and
  /// pitch, 16 arcsec heading over 20 s. UsageError for another name.
  static NoiseOptions named(std::string_view level);

  /// Sets the trajectory errors to those of a GNSS/INS after post-processing (standard deviations
  /// of position, roll and pitch, heading; correlation time; sources: README of the module):
  /// "survey" 2 cm, 9", 18", 60 s; "tactical" 3 cm, 54", 126", 40 s; "mems" 4 cm, 90", 288", 20 s.
  /// UsageError for another name.
  void setTrajectoryGrade(std::string_view grade);
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
  int session = 1;         ///< from 1; a session is flown a day after the one before
};

struct SceneOptions {
  double relief = 1.0;      ///< factor on the heights of the terrain, 0: a horizontal plane
  double mountains = 0.0;   ///< metres: amplitude of ridges of 3.4 and 1.7 km; at most 400
  double buildings = 1.0;   ///< factor on their number, 0: none; at most 2
  double high_rises = 0.0;  ///< share of the meshes of streets with blocks of 12 to 90 m in height
  double trees = 1.0;       ///< factor on their number, 0: none; at most 4
  double grass = 0.0;       ///< metres: largest height of its blades, 0: level; at most 1
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
  int targets = 0;                               ///< circular targets, control in three dimensions
  double target_diameter = 2.0;                  ///< metres
  SystemVector mounting = SystemVector::Zero();  ///< true parameters (scale: difference from 1)
  SystemVector bias = SystemVector::Zero();      ///< assumed - true, internal units
  ErrorSources errors;
  NoiseOptions noise;
  ScannerOptions scanner;
  std::optional<WaveformOptions> waveform;  ///< the scanner records waveforms
  AtmosphereOptions atmosphere;
  SceneOptions scene;
  std::vector<PlannedLine> lines;
  std::vector<std::pair<int, int>> pairs;  ///< ids of the lines planned to overlap

  /// The presets are listed in the README of the module; "paper" has six lines of Habib et al. 2011
  /// over 1 km x 2 km, 11 million pulses. Biases are those of the paper's kind, noise is none. \a
  /// scale multiplies the lengths of the lines, \a density the pulses per square metre, \a height
  /// the flying heights; the lines are spaced so that their overlaps hold for the \a field_of_view
  /// (radians; 0: that of the preset). UsageError for another name or a value out of range.
  static SimulationOptions preset(std::string_view name, double scale = 1.0, double density = 1.0,
                                  double field_of_view = 0.0, double height = 1.0);

  /// Intensity for which ErrorSource::range_walk is zero: a tenth of the gain.
  double rangeWalkReference() const { return 0.1 * scanner.gain; }

  /// Sets the type of the scanner (ScannerOptions::setType()); a conical or rosette scanner gets no
  /// bias of the scan angle scale, which is that of a mirror.
  void setScanner(std::string_view name);
  /// Divides the lines into sessions of about equally many lines, in their order.
  void setSessions(int count);
  /// Sets the gains of lines from "ID=FACTOR,…"; UsageError for an unknown line or wrong factor.
  void setGains(std::string_view list);

  /// UsageError naming the first value that is impossible.
  void check() const;
};

using pcl_als::setBiases;

}  // namespace pcl_als::simulation
