// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// The system of a point of a calibration with several, by its point source id and the channel of
/// the scanner.
class SystemLookup {
 public:
  SystemLookup() = default;  ///< one system
  explicit SystemLookup(const std::vector<SystemEstimate>& systems);

  /// Id of the strip of points without a point source id; the stem of their file.
  void setStrip(std::string strip) { strip_ = std::move(strip); }
  bool single() const { return system_.empty(); }
  /// Index of the system; InputError for a strip that belongs to none.
  std::uint8_t of(std::uint16_t source, std::uint8_t channel) const;

 private:
  std::map<std::string, std::uint8_t> system_;  ///< by id of the strip
  std::string strip_;
};

}  // namespace pcl_als
