// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "attitude_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {
namespace {

constexpr double kFewest = 30.0;                      // instants
constexpr double kMotion = 0.15 * kRadiansPerDegree;  // RMS: less is noise and bending of the mount
constexpr double kClear = 0.7;                        // correlation that counts
constexpr double kRadiansSlope = 20.0;                // of an angle that is too small by 57
constexpr double kLag = 1.0;                          // seconds, of changes of roll

/// Roll and pitch of a body over the local flight line.
struct Angles {
  double roll = 0.0, pitch = 0.0;
};

}  // namespace

double AttitudeComparison::Line::correlation() const {
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}
double AttitudeComparison::Line::spreadX() const {
  return n > 0.0 ? std::sqrt(xx / n) : 0.0;
}
double AttitudeComparison::Line::spreadY() const {
  return n > 0.0 ? std::sqrt(yy / n) : 0.0;
}

void AttitudeComparison::add(const std::vector<AttitudeRecovery::Instant>& instants) {
  for (std::size_t first = 0, last = 0; first < instants.size(); first = last) {
    for (last = first + 1; last < instants.size() && instants[last].pass == instants[first].pass;) {
      ++last;
    }
    addPass(&instants[first], last - first);
  }
}

void AttitudeComparison::addPass(const AttitudeRecovery::Instant* first, std::size_t count) {
  std::vector<Angles> given(count);
  Angles mean;
  double mean_seen = 0.0;
  std::size_t cursor = 0, path_cursor = 0;
  for (std::size_t i = 0; i < count; ++i) {
    SensorPose pose, line;
    if (!flight_.poseAt(first[i].time, pose, cursor) ||
        !path_.poseAt(first[i].time, line, path_cursor)) {
      return;
    }
    given[i].pitch = std::asin(std::clamp(pose.rotation(2, 1), -1.0, 1.0));
    given[i].roll = std::asin(std::clamp(-pose.rotation(2, 0), -1.0, 1.0));
    mean.pitch += given[i].pitch / static_cast<double>(count);
    mean_seen += first[i].pitch / static_cast<double>(count);
  }
  for (std::size_t i = 0, before = 0; i < count; ++i) {
    pitch_.add(given[i].pitch - mean.pitch, first[i].pitch - mean_seen);
    while (first[i].time - first[before].time > kLag) ++before;
    if (before == 0) continue;
    // Right wing down moves the swath to the left.
    roll_.add(given[i].roll - given[before - 1].roll,
              first[before - 1].swath_middle - first[i].swath_middle);
  }
}

AttitudeComparison::Result AttitudeComparison::judged(const Line& line, const char* angle) {
  if (line.n < kFewest || line.spreadY() < kMotion) return {};
  char text[300];
  if (line.correlation() > kClear && line.slope() > kRadiansSlope) {
    std::snprintf(text, sizeof text,
                  "the %s of the trajectory changes by a %.0fth of what the points show: it is in "
                  "radians; give degrees",
                  angle, line.slope());
    return {true, text};
  }
  if (line.correlation() < -kClear && line.slope() < -0.5 && line.slope() > -2.0) {
    std::snprintf(text, sizeof text,
                  "the %s of the trajectory has the opposite sign of what the points show "
                  "(correlation %.2f): give roll right wing down and pitch nose up as positive",
                  angle, line.correlation());
    return {true, text};
  }
  return {};
}

AttitudeComparison::Result AttitudeComparison::result() const {
  Result found = judged(pitch_, "pitch");
  if (found.text.empty()) found = judged(roll_, "roll");
  if (!found.text.empty() || pitch_.n < kFewest || pitch_.spreadY() < kMotion) return found;
  char text[300];
  const double degrees = pitch_.spreadY() / kRadiansPerDegree;
  if (pitch_.spreadX() == 0.0) {
    std::snprintf(text, sizeof text,
                  "the pitch of the trajectory is the same at all times, the points show changes "
                  "of %.2f degrees: an attitude column without values?",
                  degrees);
    return {false, text};
  }
  if (pitch_.spreadX() > kMotion && std::abs(pitch_.correlation()) < 0.3) {
    std::snprintf(text, sizeof text,
                  "the pitch of the trajectory (changes of %.2f degrees) does not follow what the "
                  "points show (%.2f degrees, correlation %.2f): another flight's attitude, or "
                  "another clock",
                  pitch_.spreadX() / kRadiansPerDegree, degrees, pitch_.correlation());
    return {false, text};
  }
  return {};
}

}  // namespace pcl_als::detail
