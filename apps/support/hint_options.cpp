// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "hint_options.h"

#include <pcl_als/las/damaged_file.h>

namespace pcl_als::app {
namespace {

/// The option of a tool that serves a hint, and what it does there.
struct RemedyOption {
  Hint hint;
  const char* option;
  const char* text;
  const char* tool = nullptr;  ///< one that has the option, to be named by tools without it
};
constexpr RemedyOption kRemedyOptions[] = {
    {Hint::force, "force", "use -force to continue"},
    {Hint::force_level, "force", "-force takes the sensor as level"},
    {Hint::keep_uncovered, "keep_uncovered", "-keep_uncovered leaves them as they are"},
    {Hint::nominal_model, "model",
     "or use -model nominal, which takes the sensor as level with its heading along the course"},
    {Hint::positions_only, "model", "or use -model quasi_rigorous, which needs no attitude"},
    {Hint::recover_attitude, "vertical", "without -vertical they are recovered from the points"},
    {Hint::crs, "crs", "give one with -crs"},
    {Hint::accuracy, "trajectory_accuracy", "this file is one for -trajectory_accuracy"},
    {Hint::axes, "trajectory_axes", "state them with -trajectory_axes"},
    {Hint::columns, "columns", "or name the columns with -columns"},
    {Hint::leap_seconds, "leap_seconds", "state them with -leap_seconds"},
    {Hint::geoid, "geoid", "-geoid subtracts the undulation"},
    {Hint::max_distance, "max_distance", "-max_distance compares surfaces further apart"},
    {Hint::extent, "bounds", "see -bounds"},
    {Hint::ground, "ground", "see -ground and -ground_classes"},
    {Hint::control, "control", "see -control"},
    {Hint::control_sigma, "control_sigma",
     "see -control_sigma and the column sigma of the control file"},
    {Hint::flight_sigmas, "position_sigma",
     "see -ins, -position_sigma, -roll_pitch_sigma and -heading_sigma"},
    {Hint::strips, "without", "-strips and -without choose strips"},
    {Hint::channels, "channels", "-channels scanner_channel divides them", "pcl_als_calibrate"},
    {Hint::user_data, "channels", "-channels user_data divides them", "pcl_als_calibrate"},
    {Hint::split, "split", "-split divides the points into flight lines"},
    {Hint::system_name, "system_name", "-system_name chooses one"},
};

/// "; use -force to continue": what serves a hint; empty where nothing does, and of a flag that
/// is given already.
std::string adviceFor(const CommandLine& line, Hint hint) {
  for (const RemedyOption& entry : kRemedyOptions) {
    if (entry.hint != hint) continue;
    if (const Option* option = line.find(entry.option)) {
      const bool in_use = option->role == Role::flag && line.given(entry.option);
      return in_use ? "" : std::string("; ") + entry.text;
    }
    if (entry.tool != nullptr) return std::string("; ") + entry.tool + " " + entry.text;
  }
  return {};
}

}  // namespace

std::string withHint(const CommandLine& line, const Error& error) {
  if (dynamic_cast<const DamagedFile*>(&error) != nullptr)
    return error.what() + std::string("; pcl_als_convert -keep_readable saves what is intact");
  return error.what() + adviceFor(line, error.hint());
}

void nameOptions(const CommandLine& line, Warnings& warnings) {
  for (Warning& warning : warnings) {
    warning.text += adviceFor(line, warning.hint);
    warning.hint = Hint::none;
  }
}

}  // namespace pcl_als::app
