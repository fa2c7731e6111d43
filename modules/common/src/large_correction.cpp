// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/large_correction.h>
#include <pcl_als/common/parameter_text.h>

namespace pcl_als {

std::string intervalText(const LargeCorrection& correction) {
  constexpr double kShort = 3.0;  // seconds
  const int digits = correction.to - correction.from < kShort ? 1 : 0;
  char text[80];
  std::snprintf(text, sizeof text, "%.*f to %.*f s", digits, correction.from, digits,
                correction.to);
  return text;
}

std::string sizeText(const LargeCorrection& correction) {
  const TrajectoryAxis& axis = correction.axisInfo();
  const double value = correction.value / axis.internal_per_unit;
  const double std = correction.std / axis.internal_per_unit;
  // Two digits of the standard deviation.
  const double size = std > 0.0 ? std : std::abs(value);
  const int digits = size > 0.0 ? decimalsOfStd(size) : 0;
  char text[120];
  std::snprintf(text, sizeof text, "%s %+.*f +- %.*f %s", std::string(axis.name).c_str(), digits,
                value, digits, std, std::string(axis.unit).c_str());
  return text + std::string(" (") +
         std::string(correction.value < 0.0 ? axis.negative : axis.positive) + ")";
}

std::string causeText(const LargeCorrection& correction) {
  if (correction.causes.empty()) return "no cause found in the data";
  std::string text;
  for (const CorrectionCause& cause : correction.causes)
    text += (text.empty() ? "" : "; ") + cause.evidence;
  return text;
}

std::string describe(const LargeCorrection& correction) {
  char text[120];
  std::snprintf(text, sizeof text,
                ", %.2f m on the ground, %.1f times an ordinary error; probable cause: ",
                correction.on_ground, std::abs(correction.ratio()));
  return "strip " + correction.strip + ", " + intervalText(correction) + ": " +
         sizeText(correction) + text + causeText(correction);
}

}  // namespace pcl_als
