// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <sstream>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

const std::array<SystemParameterInfo, kSystemParameterCount>& systemParameters() {
  using P = SystemParameter;
  static constexpr std::array<SystemParameterInfo, kSystemParameterCount> infos{{
      {P::lever_arm_x, "lever_arm_x", "m", 1.0},
      {P::lever_arm_y, "lever_arm_y", "m", 1.0},
      {P::lever_arm_z, "lever_arm_z", "m", 1.0},
      {P::boresight_pitch, "boresight_pitch", "arcsec", kRadiansPerArcsec},
      {P::boresight_roll, "boresight_roll", "arcsec", kRadiansPerArcsec},
      {P::boresight_heading, "boresight_heading", "arcsec", kRadiansPerArcsec},
      {P::range_bias, "range_bias", "m", 1.0},
      {P::scan_angle_scale, "scan_angle_scale", "1", 1.0},
  }};
  return infos;
}

double largestBias(SystemParameter p) {
  return infoOf(p).unit == "m" ? 100.0 : 0.1;
}

std::string refusedBias(SystemParameter p, double bias) {
  const double limit = largestBias(p);
  if (std::abs(bias) < limit) return {};
  const SystemParameterInfo& info = infoOf(p);
  const std::string unit = unitSuffix(p);
  std::ostringstream text;
  text << bias / info.internal_per_unit << unit << " is not between "
       << -limit / info.internal_per_unit << " and " << limit / info.internal_per_unit << unit;
  return text.str();
}

std::optional<SystemParameter> systemParameterNamed(std::string_view name) {
  for (const SystemParameterInfo& info : systemParameters()) {
    if (info.name == name) return info.parameter;
  }
  return std::nullopt;
}

SystemUnknowns SystemEstimate::values() const {
  SystemUnknowns values;
  for (int i = 0; i < kSystemParameterCount; ++i)
    values[i] = parameters[static_cast<std::size_t>(i)].bias;
  values.tail<3>() = offset;
  return values;
}

SystemVector CalibrationResult::biases() const {
  SystemVector biases;
  for (int i = 0; i < kSystemParameterCount; ++i) biases[i] = parameters[i].bias;
  return biases;
}

std::string_view toString(AttitudeSource attitude) {
  switch (attitude) {
    case AttitudeSource::none:
      return "none";
    case AttitudeSource::points:
      return "points";
    case AttitudeSource::trajectory:
      return "trajectory";
    case AttitudeSource::nominal:
      return "nominal";
  }
  return "none";
}

std::string_view modelName(AttitudeSource attitude) {
  const bool rigorous =
      attitude == AttitudeSource::trajectory || attitude == AttitudeSource::nominal;
  return rigorous ? "rigorous" : "quasi_rigorous";
}

std::string_view toString(ParameterStatus status) {
  switch (status) {
    case ParameterStatus::estimated:
      return "estimated";
    case ParameterStatus::fixed:
      return "fixed";
    case ParameterStatus::not_estimable:
      return "not_estimable";
  }
  return "fixed";
}

}  // namespace pcl_als
