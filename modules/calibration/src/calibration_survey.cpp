// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The two passes of SystemCalibrationEngine over the points.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <pcl_als/calibration/system_calibration_engine.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/memory.h>
#include <pcl_als/common/parallel.h>

#include "area_matcher.h"
#include "control_coverage.h"
#include "group_differences.h"
#include "strip_error_check.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

constexpr double kControlAreaSize = 4.0;  // metres: contains the patch at a control point
// Radians (half a degree): the effect of such an attitude on biases of 100 arc-seconds that are
// estimated with the vertical model is one arc-second.
constexpr double kVertical = 0.0087;

/// Side of the area that contains a target wherever it is searched for, and the ground around it.
double targetAreaSize(const ControlPoint& point, double window) {
  constexpr double kAround = 2.0;  // diameters
  if (point.kind != ControlPoint::Kind::target) return 0.0;
  return 2.0 * window + kAround * point.diameter;
}

std::string seconds(double from, double to) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << from << " … " << to << " s";
  return text.str();
}

}  // namespace

int SystemCalibrationEngine::addStrip(const std::string& id) {
  ids_.push_back(id);
  used_.push_back(true);
  held_of_.push_back(-1);
  plausibility_.addStrip(id);
  if (attitude_ == AttitudeSource::none) recoveries_.emplace_back(trajectory_);
  if (trajectory_->hasAttitude()) scanners_.emplace_back(trajectory_);
  return map_.addStrip();
}

void SystemCalibrationEngine::survey(int strip, const LidarReturn* points, std::size_t count) {
  map_.add(strip, points, count);
  if (isReference(strip)) return;
  plausibility_.addRun(strip, points, count);
  constexpr std::size_t kEvery = 16;  // points used for the attitude and for the scan planes
  for (std::size_t i = 0; i < count && !scanners_.empty(); i += kEvery)
    scanners_[static_cast<std::size_t>(strip)].add(points[i]);
  if (recoveries_.empty()) return;
  AttitudeRecovery& recovery = recoveries_[static_cast<std::size_t>(strip)];
  for (std::size_t i = 0; i < count; i += kEvery) recovery.add(points[i].time, points[i].position);
}

void SystemCalibrationEngine::describeAttitudes() {
  for (std::size_t strip = 0; strip < recoveries_.size(); ++strip) {
    if (!used_[strip] || isReference(static_cast<int>(strip))) continue;
    const AttitudeRecovery::Outcome outcome = recoveries_[strip].assess();
    const std::string text = "strip " + ids_[strip] + ": " + outcome.remark;
    attitude_remarks_.push_back(text);
    if (!outcome.linear) warnings_.push_back(text + "; it is taken as level");
  }
}

/// Without this, models of linear scanners would interpret points ahead and behind as pitch and
/// crab.
void SystemCalibrationEngine::useNonLinearModel(const std::string& remark) {
  const std::string text =
      remark + ": the attitude of a scanner that is not linear has to come with the trajectory";
  if (!settings_.force) {
    throw InputError(text + "; give one with roll, pitch and heading", Remedy::nominal_model);
  }
  warnings_.push_back(text);
  if (!settings_.recover_attitude) return;
  warnings_.push_back(
      "the sensor is taken as level with its heading along the course (nominal "
      "attitude)");
  trajectory_ = std::make_shared<const Trajectory>(trajectory_->withNominalAttitude());
  attitude_ = AttitudeSource::nominal;
}

void SystemCalibrationEngine::recoverAttitude() {
  if (recoveries_.empty()) return;
  describeAttitudes();
  AttitudeRecovery all(trajectory_);
  for (std::size_t strip = 0; strip < recoveries_.size(); ++strip) {
    if (used_[strip] && !isReference(static_cast<int>(strip))) all.merge(recoveries_[strip]);
  }
  const AttitudeRecovery::Outcome outcome = all.recover();
  recoveries_.clear();
  if (!outcome.linear) {
    useNonLinearModel(outcome.remark);
    return;
  }
  if (!settings_.recover_attitude) {
    if (outcome.found && outcome.size > kVertical) {
      warnings_.emplace_back(
          "the sensor is taken as vertical and aligned with the flight line, "
          "it was not: " +
              outcome.remark + "; standard deviations do not include that",
          Remedy::recover_attitude);
    }
    return;
  }
  trajectory_ = outcome.flight;
  if (outcome.found) {
    recovered_attitude_ = outcome.attitude;
    attitude_ = AttitudeSource::points;
  } else {
    warnings_.push_back(outcome.remark);
  }
}

void SystemCalibrationEngine::findScanPlanes() {
  std::vector<const ScannerDetection*> strips;
  for (std::size_t strip = 0; strip < scanners_.size(); ++strip) {
    if (used_[strip] && !isReference(static_cast<int>(strip))) strips.push_back(&scanners_[strip]);
  }
  const ScanPlanes planes = scanPlanes(strips);
  std::map<ScannerPattern, std::size_t> patterns;
  for (const ScannerDetection* strip : strips) ++patterns[strip->assess().pattern];
  const std::size_t cones = patterns[ScannerPattern::conical];
  conical_ = 2 * cones > strips.size();
  const std::size_t rosettes = patterns[ScannerPattern::rosette];
  rosette_ = 2 * rosettes > strips.size();
  source_scale_.about_axis = 2 * (cones + rosettes) > strips.size();
  scanners_.clear();
  if (planes.empty()) return;
  attitude_remarks_.push_back("the scanner has " + std::to_string(planes.size()) +
                              " scan planes; scan angles are those in the plane of each pulse");
  trajectory_ = std::make_shared<const Trajectory>(trajectory_->withScanPlanes(planes));
}

void SystemCalibrationEngine::leaveOutSmallStrips() {
  for (std::size_t strip = 0; strip < ids_.size(); ++strip) {
    const std::size_t count = map_.pointCount(static_cast<int>(strip));
    if (map_.invalidCount(static_cast<int>(strip)) > 0) {
      warnings_.push_back("strip " + ids_[strip] + ": " +
                          std::to_string(map_.invalidCount(static_cast<int>(strip))) +
                          " points with a time or coordinate that is not finite were ignored");
    }
    if (count >= settings_.minimum_points || !used_[strip] || isReference(static_cast<int>(strip)))
      continue;
    leaveOut(static_cast<int>(strip), LeftOutReason::too_few_points);
    warnings_.push_back("strip " + ids_[strip] + " has only " + std::to_string(count) +
                        " points and is left out");
  }
}

void SystemCalibrationEngine::leaveOut(int strip, LeftOutReason reason) {
  const auto index = static_cast<std::size_t>(strip);
  used_[index] = false;
  left_out_.push_back({ids_[index], reason, map_.pointCount(strip), map_.pointCount(strip)});
}

/// Strips whose firing points are less certain than the trajectory, because their times are
/// rounded.
void SystemCalibrationEngine::leaveOutRoundedTimes() {
  std::string last;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    const int strip = static_cast<int>(i);
    const double distance = plausibility_.distancePerStep(strip);
    // Rounding errors are uniformly distributed within a step.
    const double std = distance / std::sqrt(12.0);
    if (!used_[i] || isHeld(strip) || std < settings_.shared_errors.position) continue;
    char along[80];
    std::snprintf(along, sizeof along, "standard deviation along the flight %.3g m", std);
    last = "strip " + ids_[i] + ": its GPS times are rounded to " + plausibility_.timeSteps(strip) +
           ", " + along + "; lever_arm_y and boresight_pitch would be wrong";
    leaveOut(strip, LeftOutReason::rounded_times);
    warnings_.push_back(last + ": the strip is left out; give files with the original times");
  }
  if (last.empty() || std::count(used_.begin(), used_.end(), true) > 1) return;
  throw InputError(last + ": fewer than two strips are left; give files with the original times");
}

void SystemCalibrationEngine::checkTimes() const {
  for (std::size_t strip = 0; strip < ids_.size(); ++strip) {
    if (!used_[strip] || isReference(static_cast<int>(strip))) continue;
    const double start = map_.startTime(static_cast<int>(strip)),
                 end = map_.endTime(static_cast<int>(strip));
    if (start < trajectory_->startTime() || end > trajectory_->endTime()) {
      throw InputError("strip " + ids_[strip] + " was measured at " + seconds(start, end) +
                       ", the trajectory covers " +
                       seconds(trajectory_->startTime(), trajectory_->endTime()) +
                       ": give the trajectory of this flight");
    }
  }
}

void SystemCalibrationEngine::checkTrajectory() {
  for (std::size_t strip = 0; strip < ids_.size(); ++strip) {
    if (!used_[strip] || isReference(static_cast<int>(strip)))
      plausibility_.leaveOut(static_cast<int>(strip));
  }
  if (settings_.reconstructed_height_std) plausibility_.nameReconstructed();
  for (const Warning& warning : plausibility_.check(settings_.force, true)) {
    warnings_.push_back(warning);
  }
  height_error_ = plausibility_.heightError();
  if (settings_.reconstructed_height_std) {
    double lowest = HUGE_VAL;
    for (std::size_t strip = 0; strip < ids_.size(); ++strip) {
      const double height = plausibility_.meanHeight(static_cast<int>(strip));
      if (height > 0.0) lowest = std::min(lowest, height);
    }
    height_error_ = uncertainHeight(*settings_.reconstructed_height_std, lowest);
  }
  plausibility_.release();
}

int SystemCalibrationEngine::stripNamed(const std::string& id) const {
  const auto found = std::find(ids_.begin(), ids_.end(), id);
  if (found != ids_.end()) return static_cast<int>(found - ids_.begin());
  std::string known;
  for (const std::string& name : ids_) known += (known.empty() ? "" : ", ") + name;
  throw UsageError("pairs name strip '" + id + "', but the strips are " + known);
}

/// With pairs given by name, other strips are used for control only.
void SystemCalibrationEngine::leaveOutUnpaired() {
  if (wanted_pairs_.empty() || !control_.empty() || !held_.empty()) return;
  std::vector<bool> paired(ids_.size(), false);
  for (const auto& [a, b] : wanted_pairs_) {
    paired[static_cast<std::size_t>(stripNamed(a))] = true;
    paired[static_cast<std::size_t>(stripNamed(b))] = true;
  }
  for (std::size_t strip = 0; strip < ids_.size(); ++strip) {
    if (!paired[strip]) used_[strip] = false;
  }
}

void SystemCalibrationEngine::choosePairs() {
  std::vector<StripPair> wanted;
  for (const auto& [a, b] : wanted_pairs_) {
    const int i = stripNamed(a), j = stripNamed(b);
    if (i == j) throw UsageError("pairs name strip '" + a + "' with itself");
    wanted.emplace_back(std::min(i, j), std::max(i, j));
  }
  pairs_.clear();
  for (const SurveyMap::Overlap& overlap : map_.overlaps(settings_.minimum_overlap)) {
    if (!used_[overlap.strips.first] || !used_[overlap.strips.second]) continue;
    const bool a = isHeld(overlap.strips.first), b = isHeld(overlap.strips.second);
    if (a && b) continue;
    const bool chosen = a || b || wanted.empty() ||
                        std::find(wanted.begin(), wanted.end(), overlap.strips) != wanted.end();
    if (chosen) pairs_.push_back(overlap.strips);
  }
  for (const StripPair& pair : wanted) {
    if (std::find(pairs_.begin(), pairs_.end(), pair) != pairs_.end()) continue;
    warnings_.push_back("strips " + ids_[pair.first] + " and " + ids_[pair.second] +
                        " do not overlap enough");
  }
  if (!pairs_.empty() || !control_.empty()) return;
  const auto used = std::count(used_.begin(), used_.end(), true);
  throw InputError(
      used < 2 ? "fewer than two strips with enough points and no control: nothing to compare"
               : "no two strips overlap and there is no control: nothing to compare");
}

void SystemCalibrationEngine::checkControl() {
  std::vector<int> strips;
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (used_[i] && !isReference(static_cast<int>(i))) strips.push_back(static_cast<int>(i));
  }
  const ControlCoverage coverage = coverageOf(control_, map_, strips);
  control_remark_ = coverage.remark;
  if (coverage.objection.empty()) return;
  if (!settings_.force) throw InputError(coverage.objection, Remedy::force);
  warnings_.push_back(coverage.objection);
}

void SystemCalibrationEngine::adaptLimits() {
  double highest = 0.0;
  for (std::size_t i = 0; i < ids_.size(); ++i)
    highest = std::max(highest, plausibility_.meanHeight(static_cast<int>(i)));
  settings_.limits = settings_.limits.atHeight(highest);
}

/// The cells of a large survey need as much memory as its pairs do later.
void SystemCalibrationEngine::releaseMap() {
  pair_heights_.resize(pairs_.size());
  parallelFor(pairs_.size(), settings_.threads,
              [this](std::size_t i) { pair_heights_[i] = map_.heightOffset(pairs_[i]); });
  map_.releaseCells();
  returnFreeMemory();
}

void SystemCalibrationEngine::chooseAreas() {
  shareSurvey();
  compared_ = settings_.systems.empty() && settings_.diagnose ? comparedGroups(ids_, flownTimes())
                                                              : std::vector<StripGroup>();
  systems_ = compared_.empty() ? stripSystems(settings_.systems, settings_.own, ids_)
                               : stripSystems(compared_, {{}, false}, ids_);
  holdSurfaces();
  adaptLimits();
  leaveOutUnpaired();
  leaveOutSmallStrips();
  leaveOutRoundedTimes();
  checkTimes();
  checkTrajectory();
  recoverAttitude();
  findScanPlanes();
  checkControl();
  checkReferences();
  choosePairs();
  areas_ = map_.selectAreas(pairs_, settings_.selection);
  releaseMap();
  pair_areas_ = areas_.size();
  for (const ControlPoint& point : control_) {
    const double size = std::max(
        {kControlAreaSize, point.extent, targetAreaSize(point, settings_.max_normal_distance)});
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * size);
    areas_.push_back({point.position.head<2>() - half, size, settings_.selection.margin});
  }
  index_ = std::make_unique<AreaIndex>(areas_);
  matchers_.clear();
  for (const SurveyArea& area : areas_) {
    AreaMatcher& matcher = matchers_.emplace_back(area, ids_.size());
    for (std::size_t i = 0; i < ids_.size(); ++i)
      if (held_of_[i] >= 0)
        matcher.hold(static_cast<int>(i), held_[static_cast<std::size_t>(held_of_[i])].surface.std,
                     !isReference(static_cast<int>(i)));
  }
}

void SystemCalibrationEngine::load(int strip, const LidarReturn* points, std::size_t count) {
  if (!used_[static_cast<std::size_t>(strip)]) return;
  for (const LidarReturn* p = points; p != points + count; ++p) {
    if (!p->position.allFinite() || !std::isfinite(p->time)) continue;
    for (const int area : index_->candidates(p->position))
      matchers_[static_cast<std::size_t>(area)].add(strip, *p);
  }
}

}  // namespace pcl_als
