// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// Strips that one system measured: one of several scanners, a channel of a scanner, or a session
/// (a day, an installation of the scanner).
struct StripGroup {
  std::string name;
  std::vector<std::string> strips;  ///< by id
};

/// A group from "NAME=STRIPS[:CHANNEL]": ids separated by commas, 3-7 for numbers in a row; with a
/// channel, the strips of that channel (channelStrip()). UsageError for another form.
StripGroup stripGroup(std::string_view text);

/// The id of a channel's strip, where the channels of a scanner are strips of their own: 3.ch1.
std::string channelStrip(const std::string& strip, int channel);
/// The id without the channel: 3 for 3.ch1.
std::string passOfStrip(const std::string& strip);

/// A channel of the scanner from the value of a field. InputError "WHERE holds 300, which is no
/// channel (0 to 255)".
std::uint8_t channelOfValue(double value, const std::string& where);

/// What a system has of its own: the biases of the eight parameters, and an offset of its
/// coordinates (east, north, up; metres), all assumed - true.
inline constexpr int kSystemUnknownCount = kSystemParameterCount + 3;
using SystemUnknowns = Eigen::Matrix<double, kSystemUnknownCount, 1>;

/// Which of them may differ from those of the first system.
struct PerSystemParameters {
  std::vector<SystemParameter> parameters{
      SystemParameter::boresight_pitch, SystemParameter::boresight_roll,
      SystemParameter::boresight_heading, SystemParameter::range_bias,
      SystemParameter::scan_angle_scale};
  bool offset = false;  ///< of the coordinates: another base station, datum or geoid
};

/// From "boresight,range_bias,offset": names of parameters; "boresight" and "lever_arm" stand for
/// three each. UsageError for an unknown name.
PerSystemParameters ownUnknowns(std::string_view text);

}  // namespace pcl_als
