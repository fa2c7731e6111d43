// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

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
