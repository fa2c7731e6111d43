// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pcl_als {

/// What a caller may set to go on where an input is refused, or to follow a warning. Messages do
/// not name options: a tool adds the name of its own.
enum class Hint {
  none,
  force,             ///< to go on all the same, with a warning
  force_level,       ///< force, which takes the sensor as level
  keep_uncovered,    ///< to leave points without trajectory as they are
  nominal_model,     ///< the model with a level sensor whose heading is the course
  positions_only,    ///< the model that uses the positions of the trajectory only
  recover_attitude,  ///< to recover pitch and crab instead of taking the sensor as vertical
  crs,               ///< to state the CRS of the points
  accuracy,          ///< to give a file of standard deviations as such
  axes,              ///< to state the axes of a trajectory's attitude
  columns,           ///< to name the columns of a trajectory
  leap_seconds,      ///< to state the leap seconds of a trajectory in UTC
  geoid,             ///< to give the geoid undulation of a trajectory's heights
  max_distance,      ///< to compare surfaces that are further apart
  extent,            ///< another extent of the rasters
  ground,            ///< other points as ground
  control,           ///< to give control points
  control_sigma,     ///< to state the standard deviation of control points
  flight_sigmas,     ///< to state the standard deviations of the trajectory
  strips,            ///< to leave strips out, or to use some only
  channels,          ///< to divide strips by the channel of the scanner
  user_data,         ///< to divide strips by the user data
  split,             ///< to divide the points into flight lines
  system_name,       ///< to name the instrument
};

/// Base of every exception of this library. what() is one line that names the file, record or
/// option and what to do, printable() whatever it quotes.
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

/// What a user should know of a result, in one line without names of options, and what a caller may
/// set about it.
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
