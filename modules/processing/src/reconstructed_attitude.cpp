// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "reconstructed_attitude.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/attitude_recovery.h>

namespace pcl_als::detail {
namespace {

constexpr std::size_t kEvery = 8;                            // points of which one is used
constexpr double kWidthTolerance = 1.5 * kRadiansPerDegree;  // of a swath with both edges
constexpr double kCompleteShare = 0.7;  // of the times at which both edges must be seen
constexpr double kMountRoll = 0.5 * kRadiansPerDegree;      // rad, asymmetry of the field of view
constexpr double kPitchNoise = 0.01 * kRadiansPerDegree;    // rad
constexpr double kHeadingNoise = 0.02 * kRadiansPerDegree;  // rad

AttitudeRecovery::Outcome recover(const SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& flight) {
  std::vector<AttitudeRecovery> strips(survey.strips().size(), AttitudeRecovery(flight));
  std::vector<std::size_t> counts(strips.size(), 0);
  survey.read([&](const SurveyReader::Run& run) {
    const auto s = static_cast<std::size_t>(run.strip);
    for (std::size_t row = run.from; row < run.to; ++row)
      if (counts[s]++ % kEvery == 0)
        strips[s].add(run.time(run.chunk.gps_time[row]), run.position(row),
                      static_cast<double>(run.chunk.scan_angle[row]) * kRadiansPerDegree);
  });
  AttitudeRecovery all(flight);
  for (const AttitudeRecovery& strip : strips) all.merge(strip);
  return all.recover();
}

/// Roll over time from the middle of swaths with both edges.
class RollOfSwath {
 public:
  explicit RollOfSwath(const std::vector<AttitudeRecovery::Swath>& swath) {
    std::vector<double> widths;
    for (const auto& bin : swath) widths.push_back(bin.right - bin.left);
    if (widths.empty()) return;
    const double width = medianInPlace(widths);
    for (const auto& bin : swath) {
      if (std::abs(bin.right - bin.left - width) > kWidthTolerance) continue;
      times_.push_back(bin.time);
      rolls_.push_back(-0.5 * (bin.left + bin.right));
    }
    complete_ =
        static_cast<double>(times_.size()) >= kCompleteShare * static_cast<double>(swath.size());
    std::vector<double> changes;
    for (std::size_t i = 2; i < rolls_.size(); ++i)
      changes.push_back(rolls_[i] - 2.0 * rolls_[i - 1] + rolls_[i - 2]);
    // Second differences of independent errors have six times their variance.
    noise_ = changes.empty() ? kMountRoll : robustSigma(changes) / std::sqrt(6.0);
  }

  bool complete() const { return complete_ && times_.size() > 2; }
  double std() const { return std::hypot(noise_, kMountRoll); }
  double at(double time) const {
    const auto next = std::upper_bound(times_.begin(), times_.end(), time);
    if (next == times_.begin()) return rolls_.front();
    if (next == times_.end()) return rolls_.back();
    const auto i = static_cast<std::size_t>(next - times_.begin());
    const double share = (time - times_[i - 1]) / (times_[i] - times_[i - 1]);
    return (1.0 - share) * rolls_[i - 1] + share * rolls_[i];
  }

 private:
  std::vector<double> times_, rolls_;
  bool complete_ = false;
  double noise_ = 0.0;
};

double headingOf(const Eigen::Matrix3d& rotation) {
  const Eigen::Vector3d forward = rotation.col(1);
  const double heading = std::atan2(forward.x(), forward.y());
  return heading < 0.0 ? heading + 2.0 * kPi : heading;
}

void setAngles(const AttitudeRecovery::Outcome& outcome, const RollOfSwath& roll,
               ReconstructedTrajectory& flight) {
  std::size_t cursor = 0;
  for (const ReconstructedPath& path : flight.paths) {
    if (!path.found) continue;
    for (const PathSample& point : path.samples) {
      const auto at = std::lower_bound(
          flight.samples.begin(), flight.samples.end(), point.time,
          [](const TrajectorySample& sample, double time) { return sample.time < time; });
      SensorPose pose;
      if (at == flight.samples.end() || at->time != point.time ||
          !outcome.flight->poseAt(point.time, pose, cursor))
        continue;
      at->roll = roll.at(point.time);
      at->pitch = std::asin(std::clamp(pose.rotation(2, 1), -1.0, 1.0));
      at->heading = headingOf(pose.rotation);
      const Eigen::Vector2d course = point.velocity.head<2>().normalized();
      const double along =
          std::sqrt(course.dot(point.covariance.topLeftCorner<2, 2>() * course)) / path.height;
      flight.accuracy[static_cast<std::size_t>(at - flight.samples.begin())].angles =
          Eigen::Vector3d(roll.std(), std::hypot(along, kPitchNoise), kHeadingNoise);
    }
  }
}

}  // namespace

void recoverAttitude(const SurveyReader& survey, ReconstructedTrajectory& flight,
                     ProgressReport& progress) {
  progress.begin("Recovering the attitude");
  const auto path = std::make_shared<const Trajectory>(flight.samples);
  const AttitudeRecovery::Outcome outcome = recover(survey, path);
  const RollOfSwath roll(outcome.swath);
  if (!outcome.found) {
    flight.attitude = "no roll, pitch and heading: " + outcome.remark;
  } else if (!roll.complete()) {
    flight.attitude =
        "no roll, pitch and heading: the edges of the swath, which show the roll, are not complete";
  } else {
    setAngles(outcome, roll, flight);
    flight.attitude = outcome.remark + "; roll from the edges of the swath";
  }
  progress.end(roll.complete() && outcome.found ? "roll, pitch and heading" : "none");
  progress.remark(flight.attitude);
}

}  // namespace pcl_als::detail
