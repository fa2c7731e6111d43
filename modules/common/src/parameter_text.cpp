// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <sstream>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/parameter_text.h>

namespace pcl_als {

std::string plainName(SystemParameter parameter) {
  std::string name(infoOf(parameter).name);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string unitText(SystemParameter parameter) {
  const std::string_view unit = infoOf(parameter).unit;
  return unit == "1" ? std::string() : std::string(unit);
}

std::string unitSuffix(SystemParameter parameter) {
  const std::string unit = unitText(parameter);
  return unit.empty() ? unit : " " + unit;
}

int tableDecimals(SystemParameter parameter) {
  const std::string_view unit = infoOf(parameter).unit;
  return unit == "m" ? 4 : unit == "arcsec" ? 2 : 7;
}

int decimalsOfStd(double std) {
  const int leading = std > 0.0 ? static_cast<int>(std::floor(std::log10(std))) : -6;
  return std::clamp(1 - leading, 0, 9);
}

std::string shortValue(SystemParameter parameter, double value) {
  std::ostringstream text;
  text.precision(3);
  text << value / infoOf(parameter).internal_per_unit;
  return text.str();
}

std::string inUnit(SystemParameter parameter, double value) {
  return shortValue(parameter, value) + unitSuffix(parameter);
}

std::string valueText(SystemParameter parameter, double value, double std) {
  const double unit = infoOf(parameter).internal_per_unit;
  const int decimals = decimalsOfStd(std / unit);
  return numberText(value / unit, decimals) + " ± " + numberText(std / unit, decimals) +
         unitSuffix(parameter);
}

std::string estimateText(SystemParameter parameter, const ParameterEstimate& estimate) {
  if (estimate.status == ParameterStatus::estimated)
    return valueText(parameter, estimate.bias, estimate.std);
  const std::string status =
      estimate.status == ParameterStatus::fixed ? "not estimated" : "not determined";
  return estimate.reason.empty() ? status : status + ": " + estimate.reason;
}

}  // namespace pcl_als
