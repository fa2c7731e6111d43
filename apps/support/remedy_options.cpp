// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "remedy_options.h"

#include <pcl_als/las/damaged_file.h>

namespace pcl_als::app {
namespace {

/// The option of a tool that serves a remedy, and what it does there.
struct RemedyOption {
  Remedy remedy;
  const char* option;
  const char* text;
  const char* tool = nullptr;  ///< one that has the option, to be named by tools without it
};
constexpr RemedyOption kRemedyOptions[] = {
    {Remedy::force, "force", "use -force to continue"},
    {Remedy::force_level, "force", "-force takes the sensor as level"},
    {Remedy::keep_uncovered, "keep_uncovered", "-keep_uncovered leaves them as they are"},
    {Remedy::nominal_model, "model",
     "or use -model nominal, which takes the sensor as level with its heading along the course"},
    {Remedy::positions_only, "model", "or use -model quasi_rigorous, which needs no attitude"},
    {Remedy::recover_attitude, "vertical", "without -vertical they are recovered from the points"},
    {Remedy::crs, "crs", "give one with -crs"},
    {Remedy::accuracy, "accuracy", "this file is one for -accuracy"},
    {Remedy::axes, "trajectory_axes", "state them with -trajectory_axes"},
    {Remedy::columns, "columns", "or name the columns with -columns"},
    {Remedy::leap_seconds, "leap_seconds", "state them with -leap_seconds"},
    {Remedy::geoid, "geoid", "-geoid subtracts the undulation"},
    {Remedy::max_distance, "max_distance", "-max_distance compares surfaces further apart"},
    {Remedy::extent, "extent", "see -extent"},
    {Remedy::ground, "ground", "see -ground and -ground_classes"},
    {Remedy::control, "control", "see -control"},
    {Remedy::control_sigma, "control_sigma",
     "see -control_sigma and the column sigma of the control file"},
    {Remedy::flight_sigmas, "position_sigma",
     "see -ins, -position_sigma, -roll_pitch_sigma and -heading_sigma"},
    {Remedy::strips, "without", "-strips and -without choose strips"},
    {Remedy::channels, "channels", "-channels scanner_channel divides them", "pcl_als_calibrate"},
    {Remedy::user_data, "channels", "-channels user_data divides them", "pcl_als_calibrate"},
    {Remedy::split, "split", "-split divides the points into flight lines"},
    {Remedy::system_name, "system_name", "-system_name chooses one"},
};

/// "; use -force to continue": what serves a remedy; empty where nothing does, and of a flag that
/// is given already.
std::string adviceFor(const CommandLine& line, Remedy remedy) {
  for (const RemedyOption& entry : kRemedyOptions) {
    if (entry.remedy != remedy) continue;
    if (const Option* option = line.find(entry.option)) {
      const bool in_use = option->role == Role::flag && line.given(entry.option);
      return in_use ? "" : std::string("; ") + entry.text;
    }
    if (entry.tool != nullptr) return std::string("; ") + entry.tool + " " + entry.text;
  }
  return {};
}

}  // namespace

std::string withOption(const CommandLine& line, const Error& error) {
  if (dynamic_cast<const DamagedFile*>(&error) != nullptr)
    return error.what() + std::string("; pcl_als_convert -keep_readable saves what is intact");
  return error.what() + adviceFor(line, error.remedy());
}

void nameOptions(const CommandLine& line, Warnings& warnings) {
  for (Warning& warning : warnings) {
    warning.text += adviceFor(line, warning.remedy);
    warning.remedy = Remedy::none;
  }
}

}  // namespace pcl_als::app
