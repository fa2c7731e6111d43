// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {

CalibrationResult instrumentOf(const CalibrationResult& calibration) {
  CalibrationResult instrument;
  instrument.system_name = calibration.system_name;
  instrument.verdict = calibration.verdict;
  instrument.attitude = calibration.attitude;
  instrument.scan_planes = calibration.scan_planes;
  instrument.parameters = calibration.parameters;
  instrument.systems = calibration.systems;
  instrument.channel_field = calibration.channel_field;
  instrument.sources = calibration.sources;
  instrument.source_scale = calibration.source_scale;
  instrument.correlation_order = calibration.correlation_order;
  instrument.correlation = calibration.correlation;
  instrument.prior = calibration.prior;
  instrument.prior_differences = calibration.prior_differences;
  instrument.rms_with_prior = calibration.rms_with_prior;
  instrument.held_parameters = calibration.held_parameters;
  instrument.line_fit_half_width = calibration.line_fit_half_width;
  instrument.error_levels = calibration.error_levels;
  instrument.inputs = calibration.inputs;
  instrument.crs = calibration.crs;
  return instrument;
}

CalibrationResult calibrationOfSystem(const CalibrationResult& calibration,
                                      const std::string& name) {
  const auto& systems = calibration.systems;
  std::vector<std::string> names;
  for (const SystemEstimate& system : systems) names.push_back(system.group.name);
  if (name.empty() && systems.size() > 1)
    throw UsageError("the calibration has several systems; name one of them: " + joined(names));
  const auto found = std::find(names.begin(), names.end(), name);
  if (!name.empty() && found == names.end())
    throw UsageError("the calibration has no system '" + name + "'" +
                     (names.empty() ? "; it has one without a name" : " (" + joined(names) + ")"));
  CalibrationResult chosen = calibration;
  if (name.empty()) return chosen;
  chosen.systems = {systems[static_cast<std::size_t>(found - names.begin())]};
  if (found == names.begin()) return chosen;
  chosen.parameters = chosen.systems.front().parameters;
  chosen.correlation_order.clear();
  for (const SystemParameterInfo& info : systemParameters())
    if (chosen[info.parameter].status == ParameterStatus::estimated)
      chosen.correlation_order.push_back(info.parameter);
  const auto size = static_cast<Eigen::Index>(chosen.correlation_order.size());
  chosen.correlation = Eigen::MatrixXd::Identity(size, size);
  chosen.held_parameters = {};
  return chosen;
}

bool isOfAnotherFlight(const CalibrationResult& calibration, double from, double to) {
  bool known = false;
  const auto contains = [&](double first, double last) {
    known = true;
    return first - RecoveredAttitude::kMaximumExtrapolation <= to &&
           from <= last + RecoveredAttitude::kMaximumExtrapolation;
  };
  for (const StripErrors& strip : calibration.strip_errors) {
    if (strip.knots.empty()) continue;
    if (contains(strip.knots.front().time, strip.knots.back().time)) return false;
  }
  for (const RecoveredAttitude::Pass& pass : calibration.recovered_attitude.passes())
    if (contains(pass.front().time, pass.back().time)) return false;
  return known;
}

}  // namespace pcl_als
