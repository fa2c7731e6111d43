// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_units.h>

namespace pcl_als {
namespace {

constexpr double kSameLength = 5e-7;  ///< relative

struct NamedUnit {
  const char* option;
  const char* name;
  double metres;
};

constexpr NamedUnit kUnits[] = {
    {"m", "metre", 1.0}, {"ft", "foot", 0.3048}, {"us_ft", "US survey foot", 12.0 / 39.37}};

}  // namespace

LengthUnit lengthUnitOf(double metres, const std::string& name) {
  if (!(std::isfinite(metres) && metres > 0.0))
    throw UsageError("the length of a unit must be a positive number of metres");
  for (const NamedUnit& unit : kUnits)
    if (std::abs(metres / unit.metres - 1.0) <= kSameLength) return {unit.name, unit.metres};
  if (!name.empty()) return {name, metres};
  char text[40];
  std::snprintf(text, sizeof text, "unit of %.9g m", metres);
  return {text, metres};
}

LengthUnit lengthUnitNamed(const std::string& text, const std::string& what) {
  for (const NamedUnit& unit : kUnits)
    if (text == unit.option) return {unit.name, unit.metres};
  throw UsageError(what + ": '" + text +
                   "' is none of m (metre), ft (international foot) and us_ft (US survey foot)");
}

}  // namespace pcl_als
