// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include <Eigen/Dense>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/trajectory_reconstruction.h>

#include "path_adjustment.h"
#include "path_constants.h"
#include "straight_path.h"

namespace pcl_als {
namespace {

using detail::PathAdjustment;

std::string formatted(const char* format, double a, double b = 0.0) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

void takeSamples(const PathAdjustment& adjustment, double interval, ReconstructedPath& path) {
  path.samples.clear();
  const auto first = static_cast<std::int64_t>(std::floor(path.times.first / interval));
  const auto last = static_cast<std::int64_t>(std::ceil(path.times.last / interval));
  for (std::int64_t i = first; i <= std::max(last, first + 1); ++i)
    path.samples.push_back(adjustment.sampleAt(static_cast<double>(i) * interval));
  path.height = adjustment.heightAboveGround();
}

/// Rounded times: a position is that of a time within half a step, on average.
void allowForRounding(double step, ReconstructedPath& path) {
  if (!(step > 0.0) || !std::isfinite(step)) return;
  for (PathSample& sample : path.samples) {
    const Eigen::Vector3d moved = sample.velocity * (step / std::sqrt(12.0));
    sample.covariance += moved * moved.transpose();
  }
}

/// Largest standard deviation of a coordinate over time, in shares of the height above ground.
double largestShare(const ReconstructedPath& path) {
  double largest = 0.0;
  for (const PathSample& sample : path.samples)
    largest = std::max(largest, sample.covariance.diagonal().maxCoeff());
  return path.height > 0.0 ? std::sqrt(largest) / path.height
                           : std::numeric_limits<double>::infinity();
}

/// Excludes samples that are not determined.
void trim(ReconstructedPath& path) {
  const double limit = TrajectoryReconstruction::kLargestShare * path.height;
  const std::size_t all = path.samples.size();
  const auto uncertain = [limit](const PathSample& sample) {
    return !(sample.covariance.diagonal().maxCoeff() <= limit * limit);
  };
  path.samples.erase(std::remove_if(path.samples.begin(), path.samples.end(), uncertain),
                     path.samples.end());
  path.determined = static_cast<double>(path.samples.size()) / static_cast<double>(all);
  path.found = path.samples.size() > 1;
}

/// What a path deviates from the straight line through its rays by more than an aircraft bends is
/// an error that the adjustment does not know of.
void allowForStraightLine(const std::optional<detail::StraightPath>& line,
                          ReconstructedPath& path) {
  if (!line || path.times.last - path.times.first > detail::kStraightTime) return;
  for (PathSample& sample : path.samples) {
    const PathSample straight = line->at(sample.time);
    const Eigen::Vector3d apart = sample.position - straight.position;
    const Eigen::Matrix3d expected = sample.covariance + straight.covariance;
    const double size = std::sqrt(apart.dot(expected.ldlt().solve(apart)));
    if (size > detail::kBeyondLine) sample.covariance += apart * apart.transpose();
  }
}

/// Why a sensor cannot have moved so; empty where it can. What is uncertain is no evidence.
std::string whyImpossible(const ReconstructedPath& path) {
  double speed = 0.0, climb = 0.0;
  for (const PathSample& sample : path.samples) {
    const Eigen::Vector3d std = sample.velocity_covariance.diagonal().cwiseSqrt();
    speed = std::max(
        speed, sample.velocity.head<2>().norm() - detail::kSignificant * std.head<2>().norm());
    climb = std::max(climb, std::abs(sample.velocity.z()) - detail::kSignificant * std.z());
  }
  if (speed > detail::kFastestFlight)
    return formatted("the sensor would move at %.0f m/s: its rays or scan angles are wrong", speed);
  if (climb > detail::kSteepestFlight)
    return formatted("the sensor would climb or sink at %.0f m/s: its rays are wrong", climb);
  return {};
}

/// Why a strip has no evidence at all; empty where it has.
std::string exclusionReason(const PathEvidence::Counts& counts) {
  if (counts.points == counts.timeless)
    return counts.points == 0 ? "no points" : "its points have no GPS times";
  if (counts.rays > 0 || counts.angles > 0) return {};
  return "no pulse has two returns, and recorded scan angles are zero or absent: nothing shows "
         "from where its points were measured";
}

/// Of strips with one path; files without meaningful source ids have hundreds.
std::string joinedName(std::string name, const std::vector<std::string>& others) {
  constexpr std::size_t kMostNamed = 3;
  for (std::size_t i = 0; i < std::min(others.size(), kMostNamed); ++i) name += " + " + others[i];
  if (others.size() > kMostNamed)
    name += " + " + std::to_string(others.size() - kMostNamed) + " more";
  return name;
}

void addFindings(const PathEvidence& evidence, ReconstructedPath& path) {
  const PathEvidence::Counts& counts = path.counts;
  const auto warn = [&path](const std::string& text) {
    path.warnings.emplace_back("strip " + path.name + ": " + text);
  };
  if (counts.timeless > 0) warn(grouped(counts.timeless) + " points without a time are not used");
  if (counts.duplicates > 0) warn(grouped(counts.duplicates) + " repeated points are not used");
  if (counts.by_time > 0)
    warn("returns have no numbers: " + grouped(counts.by_time) +
         " groups of points of equal times are taken as pulses");
  if (counts.ambiguous > 0)
    warn(grouped(counts.ambiguous) +
         " returns share a time with those of other pulses: the nearest in plan are taken as one "
         "pulse");
  const std::string steps = evidence.times().describe();
  if (!steps.empty()) warn("times are in " + steps);
  if (path.rays > 0 && path.rejected > path.rays / 5)
    warn(formatted("%.0f %% of the rays miss the path and are excluded",
                   100.0 * static_cast<double>(path.rejected) / static_cast<double>(path.rays)));
}

}  // namespace

Eigen::Vector3d ReconstructedPath::meanStd() const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const PathSample& sample : samples) sum += sample.covariance.diagonal();
  return samples.empty() ? sum : (sum / static_cast<double>(samples.size())).cwiseSqrt().eval();
}

TrajectoryReconstruction::TrajectoryReconstruction(const Settings& settings) : settings_(settings) {
  if (!(settings.knot_spacing > 0.0) || !(settings.interval > 0.0))
    throw UsageError("trajectory reconstruction: intervals must be positive");
}

int TrajectoryReconstruction::addStrip(const std::string& name) {
  strips_.push_back({name, {}, {}});
  return static_cast<int>(strips_.size()) - 1;
}

void TrajectoryReconstruction::add(int strip, const LidarReturn* points, std::size_t count) {
  PathEvidence& evidence = strips_[static_cast<std::size_t>(strip)].evidence;
  for (std::size_t i = 0; i < count; ++i) evidence.add(points[i]);
}

/// Strips that share at least a fifth of the quarters of a second of the shorter one.
void TrajectoryReconstruction::joinSimultaneous() {
  constexpr double kShared = 0.2;
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    for (std::size_t k = i + 1; k < strips_.size();) {
      const auto &a = strips_[i].evidence.bins(), &b = strips_[k].evidence.bins();
      const auto& shorter = a.size() < b.size() ? a : b;
      const auto& longer = a.size() < b.size() ? b : a;
      std::size_t shared = 0;
      for (const auto& entry : shorter) shared += longer.count(entry.first);
      if (shared == 0 ||
          static_cast<double>(shared) < kShared * static_cast<double>(shorter.size())) {
        ++k;
        continue;
      }
      strips_[i].evidence.merge(strips_[k].evidence);
      strips_[i].joined.push_back(strips_[k].name);
      strips_.erase(strips_.begin() + static_cast<std::ptrdiff_t>(k));
      k = i + 1;
    }
    strips_[i].name = joinedName(strips_[i].name, strips_[i].joined);
  }
}

std::vector<ReconstructedPath> TrajectoryReconstruction::reconstruct() {
  for (Strip& strip : strips_) strip.evidence.finish();
  joinSimultaneous();
  std::vector<ReconstructedPath> paths;
  for (const Strip& strip : strips_) {
    std::vector<TimeRange> passes = strip.evidence.passes(kGap);
    if (passes.empty()) passes.emplace_back();
    for (const TimeRange& pass : passes)
      paths.push_back(reconstruct(strip, pass, &pass == &passes.front()));
  }
  std::stable_sort(paths.begin(), paths.end(),
                   [](const auto& a, const auto& b) { return a.times.first < b.times.first; });
  return paths;
}

/// Recorded angles have systematic errors; they are used where rays are not sufficient, and rays
/// that agree with each other are believed rather than angles that contradict them.
bool TrajectoryReconstruction::adjust(const Strip& strip, const TimeRange& span,
                                      ReconstructedPath& path) const {
  PathAdjustment rays(strip.evidence, span, settings_);
  const bool by_rays = rays.adjustRays();
  if (by_rays) takeSamples(rays, settings_.interval, path);
  const auto line = detail::straightPath(strip.evidence, span);
  const double share = by_rays ? largestShare(path) : std::numeric_limits<double>::infinity();
  if (share > detail::kRaysSuffice && rays.hasAngles()) {
    PathAdjustment both = rays;
    if (both.adjustWithAngles()) {
      const bool contradicts = line && line->fitting > detail::kMostMissing &&
                               both.missingShare() > detail::kMostMissing;
      if (!contradicts && both.angleNoise() < detail::kMostAngleNoise) {
        takeSamples(both, settings_.interval, path);
        allowForStraightLine(line, path);
        both.describe(path);
        return true;
      }
      const std::string found =
          contradicts ? formatted(
                            "its rays and its recorded scan angles contradict each other: the "
                            "sensor is %.0f m above ground by the rays, %.0f m by the angles",
                            line->height, both.heightAboveGround())
                      : formatted(
                            "its recorded scan angles do not fit the positions of its points "
                            "(%.1f degrees off)",
                            both.angleNoise() / kRadiansPerDegree);
      if (share > kLargestShare)
        path.reason = found;
      else
        path.warnings.emplace_back("strip " + path.name + ": " + found + "; they are not used");
    }
  }
  rays.describe(path);
  if (!by_rays || !path.reason.empty()) return false;
  allowForStraightLine(line, path);
  return true;
}

ReconstructedPath TrajectoryReconstruction::reconstruct(const Strip& strip, const TimeRange& span,
                                                        bool first) const {
  ReconstructedPath path;
  path.name = strip.name;
  path.times = span;
  path.counts = strip.evidence.counts();
  path.reason = exclusionReason(path.counts);
  if (!path.reason.empty()) return path;
  const bool solved = adjust(strip, span, path);
  if (solved) {
    allowForRounding(strip.evidence.times().step(), path);
    trim(path);
    path.reason = whyImpossible(path);
    path.found = path.found && path.reason.empty();
  }
  if (!path.found) path.samples.clear();
  if (!path.found && path.reason.empty())
    path.reason = solved ? formatted(
                               "the path is uncertain by more than %.0f %% of the height "
                               "above ground (%.0f m)",
                               100.0 * kLargestShare, path.height)
                         : "rays and recorded scan angles do not determine a path";
  if (path.found && path.determined < 1.0)
    path.warnings.emplace_back("strip " + path.name +
                               formatted(": the path is not determined for %.0f %% of the time",
                                         std::ceil(100.0 * (1.0 - path.determined))));
  if (first) addFindings(strip.evidence, path);
  return path;
}

}  // namespace pcl_als
