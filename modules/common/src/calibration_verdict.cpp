// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>

#include <pcl_als/common/calibration_verdict.h>

namespace pcl_als {
namespace {

struct StatusName {
  CalibrationStatus status;
  std::string_view name;
};

constexpr std::array<StatusName, 5> kNames{{
    {CalibrationStatus::usable, "usable"},
    {CalibrationStatus::parameters_affected, "parameters_affected"},
    {CalibrationStatus::no_improvement, "no_improvement"},
    {CalibrationStatus::not_determined, "not_determined"},
    {CalibrationStatus::not_converged, "not_converged"},
}};

}  // namespace

std::string_view toString(CalibrationStatus status) {
  return kNames[static_cast<std::size_t>(status)].name;
}

std::optional<CalibrationStatus> calibrationStatusNamed(std::string_view name) {
  for (const StatusName& known : kNames) {
    if (known.name == name) return known.status;
  }
  return std::nullopt;
}

void CalibrationVerdict::downgrade(CalibrationStatus against, const std::string& why) {
  if (against == CalibrationStatus::usable) return;
  reason = usable() || reason.empty() ? why : reason + "; " + why;
  status = std::max(status, against);
}

std::string CalibrationVerdict::text() const {
  std::string words(toString(status));
  std::replace(words.begin(), words.end(), '_', ' ');
  return reason.empty() ? words : words + ": " + reason;
}

}  // namespace pcl_als
