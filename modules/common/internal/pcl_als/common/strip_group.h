// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

struct CalibrationResult;

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

/// The system of a point of a calibration with several, or with strips that were held fixed, by
/// its point source id and the channel of the scanner.
class SystemLookup {
 public:
  SystemLookup() = default;  ///< one system
  explicit SystemLookup(const CalibrationResult& calibration);

  /// Id of the strip of points without a point source id; the stem of their file.
  void setStrip(std::string strip) { strip_ = std::move(strip); }
  const std::string& strip() const { return strip_; }
  /// Whether all points are of one system.
  bool single() const { return system_.empty(); }
  /// Field with the channel of the scanner that of() needs: "scanner_channel", "user_data" or the
  /// name of another field; empty: systems and fixed strips do not depend on the channel.
  const std::string& channelField() const { return channel_field_; }
  /// The reason for which the systems of points without these fields are not known; empty: they
  /// are. Without channels all points are of channel 0, which suffices where no other is named.
  std::string objection(bool with_sources, bool with_channels) const;
  /// Index of the system; that of strips that were held fixed is fixed(). InputError for a strip
  /// that belongs to none, and for a point without any id of its strip.
  std::uint8_t of(std::uint16_t source, std::uint8_t channel) const;
  /// The index after that of the last system: points of it are not corrected.
  std::uint8_t fixed() const { return fixed_; }

 private:
  std::map<std::string, std::uint8_t> system_;  ///< by id of the strip
  std::uint8_t fixed_ = 1;
  bool several_ = false;         ///< systems: every strip is of one of them
  bool needs_channels_ = false;  ///< a channel other than 0 is named
  std::string strip_, channel_field_;
};

}  // namespace pcl_als
