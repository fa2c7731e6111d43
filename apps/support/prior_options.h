// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/io/prior_file.h>

#include "command_line.h"

namespace pcl_als::app {

/// Replaces the standard deviations of changes between missions that a text names, such as
/// "boresight_roll=2,lever_arm_x=0.005" (m, arcsec, 1). UsageError for a negative one.
void setChanges(std::string_view text, SystemVector& change_std);

/// -prior: values in the command, or a calibration.json or history.json; and -prior_change.
void addPriorOptions(CommandLine& line);

/// The prior of a command.
class GivenPrior {
 public:
  /// Takes it into the settings, whose systems must be set. UsageError for what the text says,
  /// InputError for a file that cannot be used.
  GivenPrior(const CommandLine& line, CalibrationSettings& settings);

  /// A warning where a strip was also one of those that the prior was estimated from.
  void warnOfSameStrips(CalibrationResult& result) const;

 private:
  std::optional<PriorFile> file_;
};

}  // namespace pcl_als::app
