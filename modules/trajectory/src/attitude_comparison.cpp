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
// RMS: biases of 100 arcsec are wrong by one arcsec with a model that is level meanwhile.
constexpr double kLargeMotion = 0.5 * kRadiansPerDegree;
// Slopes: of angles that are too small by 57, and half way from 0 to -1 and beyond.
constexpr double kRadiansSlope = 15.0, kOpposite = -0.25, kLikelyOpposite = -0.5;
constexpr double kConstant = 1e-16;  // rad^2: rounding
// Exchanged columns: share of the misfit that is left, correlation.
constexpr double kExchanged = 0.4, kAlike = 0.8;
constexpr double kFarBeyond = -2.0;  // neither a wrong sign nor a wrong unit

/// Calls visit(first, count) for each run of items of one pass.
template <typename Item, typename Visit>
void forEachPass(const std::vector<Item>& items, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < items.size(); first = last) {
    for (last = first + 1; last < items.size() && items[last].pass == items[first].pass;) ++last;
    visit(&items[first], last - first);
  }
}

}  // namespace

double AttitudeComparison::Line::correlation() const {
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}
double AttitudeComparison::Line::misfit() const {
  return n > 0.0 ? std::sqrt(std::max(0.0, xx - 2.0 * xy + yy) / n) : 0.0;
}
double AttitudeComparison::Line::spreadX() const {
  return n > 0.0 ? std::sqrt(xx / n) : 0.0;
}
double AttitudeComparison::Line::spreadY() const {
  return n > 0.0 ? std::sqrt(yy / n) : 0.0;
}

void AttitudeComparison::add(const AttitudeRecovery::Outcome& outcome) {
  forEachPass(outcome.instants, [this](const AttitudeRecovery::Instant* first, std::size_t count) {
    addPitch(first, count);
  });
  forEachPass(outcome.swath, [this](const AttitudeRecovery::Swath* first, std::size_t count) {
    addRoll(first, count);
  });
}

bool AttitudeComparison::anglesAt(double time, Angles& angles) {
  SensorPose pose;
  if (!flight_.poseAt(time, pose, cursor_)) return false;
  angles.pitch = std::asin(std::clamp(pose.rotation(2, 1), -1.0, 1.0));
  angles.roll = std::asin(std::clamp(-pose.rotation(2, 0), -1.0, 1.0));
  return true;
}

void AttitudeComparison::addPitch(const AttitudeRecovery::Instant* first, std::size_t count) {
  std::vector<MotionSample> series;
  std::vector<double> rolls;
  double mean_roll = 0.0, mean = 0.0, mean_seen = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    Angles given;
    if (!anglesAt(first[i].time, given)) return;
    series.push_back({first[i].time, given.pitch, first[i].pitch});
    rolls.push_back(given.roll);
    mean_roll += given.roll / static_cast<double>(count);
    mean += given.pitch / static_cast<double>(count);
    mean_seen += first[i].pitch / static_cast<double>(count);
  }
  pitch_.add(series);
  for (std::size_t i = 0; i < count; ++i) {
    pitch_level_.add(series[i].x - mean, series[i].y - mean_seen);
    roll_level_.add(rolls[i] - mean_roll, series[i].y - mean_seen);
  }
}

void AttitudeComparison::addRoll(const AttitudeRecovery::Swath* first, std::size_t count) {
  std::vector<MotionSample> left, right, recorded, together;
  double sum = 0.0, sum_sq = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const AttitudeRecovery::Swath& at = first[i];
    Angles given;
    if (!anglesAt(at.time, given)) return;
    // Right wing down moves the swath to the left.
    left.push_back({at.time, given.roll, -at.left});
    right.push_back({at.time, given.roll, -at.right});
    together.push_back({at.time, at.left, at.right});
    if (std::isfinite(at.recorded)) recorded.push_back({at.time, given.roll, at.recorded});
    sum += given.roll, sum_sq += given.roll * given.roll;
  }
  edges_.add(left), edges_.add(right), recorded_.add(recorded), together_.add(together);
  const double n = static_cast<double>(count);
  largest_roll_ = std::max(largest_roll_, sum_sq / n - sum * sum / (n * n));
}

AttitudeComparison::Result AttitudeComparison::judged(const MotionSlope& slope, const char* angle,
                                                      const char* shown) {
  char text[300];
  if (slope.above(kRadiansSlope)) {
    std::snprintf(text, sizeof text,
                  "the %s of the trajectory changes by a %.0fth of what the points show%s: it is "
                  "in radians; give degrees",
                  angle, slope.slope(), shown);
    return {true, text};
  }
  if (slope.below(kOpposite) && slope.slope() < kLikelyOpposite && slope.slope() > kFarBeyond) {
    std::snprintf(text, sizeof text,
                  "the %s of the trajectory has the opposite sign of what the points show%s "
                  "(changes of %.2f degrees, slope %.2f, standard deviation %.2f): give "
                  "roll right wing down and pitch nose up as positive",
                  angle, shown, slope.motionX() / kRadiansPerDegree, slope.slope(), slope.std());
    return {true, text};
  }
  return {};
}

/// Angles that stay the same, or belong to another flight, while the points show motion.
AttitudeComparison::Result AttitudeComparison::withoutMotion() const {
  char text[300];
  const Line& pitch = pitch_level_;
  const double degrees = pitch.spreadY() / kRadiansPerDegree;
  const bool moves = pitch.n >= kFewest && pitch.spreadY() > kMotion;
  if (moves && pitch.spreadX() == 0.0) {
    std::snprintf(text, sizeof text,
                  "the pitch of the trajectory is the same at all times, the points show changes "
                  "of %.2f degrees: an attitude column without values?",
                  degrees);
    return {pitch.spreadY() > kLargeMotion, text};
  }
  if (moves && pitch.spreadX() > kMotion && std::abs(pitch.correlation()) < 0.3) {
    std::snprintf(text, sizeof text,
                  "the pitch of the trajectory (changes of %.2f degrees) does not follow what the "
                  "points show (%.2f degrees, correlation %.2f): another flight's attitude, or "
                  "another clock",
                  pitch.spreadX() / kRadiansPerDegree, degrees, pitch.correlation());
    return {false, text};
  }
  // Edges of tiles and of water move one by one; both together roll.
  if (largest_roll_ < kConstant && together_.above(0.5) && !together_.above(1.5)) {
    return {together_.motionX() > kLargeMotion,
            "the roll of the trajectory is the same at all times, but both edges of the swath "
            "move together: an attitude column without values?"};
  }
  return {};
}

/// Whether the points show the roll of the trajectory as their pitch, and not its pitch. A pitch of
/// the opposite sign differs from theirs by at most twice as much as any roll that is not related.
bool AttitudeComparison::exchanged() const {
  return pitch_level_.n >= kFewest && pitch_level_.misfit() > kMotion &&
         roll_level_.misfit() < kExchanged * pitch_level_.misfit() &&
         roll_level_.correlation() > kAlike;
}

AttitudeComparison::Result AttitudeComparison::result() const {
  if (exchanged()) {
    return {true,
            "the pitch that the points show is the roll of the trajectory: give its columns of "
            "roll and pitch in the right order"};
  }
  Result found = judged(pitch_, "pitch", "");
  if (found.text.empty()) found = judged(edges_, "roll", " at the edges of the swath");
  if (found.text.empty()) found = judged(recorded_, "roll", " in their recorded scan angles");
  return found.text.empty() ? withoutMotion() : found;
}

}  // namespace pcl_als::detail
