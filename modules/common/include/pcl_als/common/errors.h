// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pcl_als {

/// The setting by which a caller can react to an error or a warning. Messages of the library do not
/// name options of the tools; each tool adds the name of its own option.
enum class Hint {
  none,
  force,             ///< continue in spite of the objection, with a warning
  force_level,       ///< as force; the sensor is then assumed to be level
  keep_uncovered,    ///< keep points without trajectory unchanged
  nominal_model,     ///< use the model with a level sensor whose heading is the course
  positions_only,    ///< use only the positions of the trajectory
  recover_attitude,  ///< recover pitch and crab instead of assuming a vertical sensor
  crs,               ///< state the CRS of the points
  accuracy,          ///< use the file as standard deviations of a trajectory
  axes,              ///< state the axes of a trajectory's attitude
  columns,           ///< name the columns of a trajectory
  leap_seconds,      ///< state the leap seconds of a trajectory in UTC
  geoid,             ///< state the geoid undulation of a trajectory's heights
  max_distance,      ///< compare surfaces that are further apart
  extent,            ///< choose another extent of the rasters
  ground,            ///< choose other points as ground
  control,           ///< use control points
  control_sigma,     ///< state the standard deviation of control points
  flight_sigmas,     ///< state the standard deviations of the trajectory
  strips,            ///< exclude strips, or choose the strips that are used
  channels,          ///< divide strips by the channel of the scanner
  user_data,         ///< divide strips by the user data
  split,             ///< divide the points into flight lines
  system_name,       ///< name the instrument
};

/// Base of all exceptions of this library. what() is one line with the file, record or argument,
/// the fault and the remedy. Text that it quotes from files is made printable (printable()).
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& message, Hint hint = Hint::none);
  Hint hint() const { return remedy_; }

 private:
  Hint remedy_;
};

/// A wrong argument, option or parameter value. Tools end with exit status 1.
class UsageError : public Error {
 public:
  using Error::Error;
};

/// Input that cannot be used: missing, corrupt, without time, without overlap. Tools end with exit
/// status 2.
class InputError : public Error {
 public:
  using Error::Error;
};

// A numerical outcome (too few pairs, rank deficiency, no convergence) is not an exception: it is a
// status with a message in the result. Tools write the result and end with exit status 3.

/// A warning about a result, in one line without names of options, and the setting that concerns
/// it.
struct Warning {
  std::string text;
  Hint hint = Hint::none;

  // Implicit, because most warnings are texts only.
  Warning(std::string what, Hint with = Hint::none) : text(std::move(what)), hint(with) {}
  Warning(const char* what, Hint with = Hint::none) : text(what), hint(with) {}
};
using Warnings = std::vector<Warning>;

/// The texts of warnings, in order.
inline std::vector<std::string> textsOf(const Warnings& warnings) {
  std::vector<std::string> texts;
  texts.reserve(warnings.size());
  for (const Warning& warning : warnings) texts.push_back(warning.text);
  return texts;
}

}  // namespace pcl_als
