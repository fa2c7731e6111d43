// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/trajectory/attitude_recovery.h>

#include "attitude_pass.h"

namespace pcl_als {
namespace {

using detail::kAttitudeBin;
using detail::PassBin;
using detail::PulseSums;

// Seconds without points after which another pass begins: less than a turn between strips takes,
// more than a conical scanner needs to see a small area again from behind.
constexpr double kPassGap = 20.0;
constexpr double kFewNotLinear = 0.3;  // share of the points that other passes outvote

/// Bins in order of time, cut where a pass ends.
std::vector<std::vector<PassBin>> passesOf(
    const std::unordered_map<std::int64_t, PulseSums>& bins) {
  const std::map<std::int64_t, PulseSums> in_order(bins.begin(), bins.end());
  std::vector<std::vector<PassBin>> passes;
  for (const auto& [index, sums] : in_order) {
    if (passes.empty() ||
        static_cast<double>(index - passes.back().back().index) * kAttitudeBin > kPassGap) {
      passes.emplace_back();
    }
    PassBin& bin = passes.back().emplace_back();
    bin.index = index;
    bin.sums = sums;
  }
  return passes;
}

/// Collects the results of the passes.
class Recovered {
 public:
  explicit Recovered(double start) : start_(start) {}

  void add(std::vector<PassBin>& bins) {
    detail::smoothPlanes(bins);
    AttitudeRecovery::Pass pass = detail::judgePass(bins);
    pass.from = timeOf(bins.front()), pass.to = timeOf(bins.back());
    const bool linear = pass.verdict == AttitudeRecovery::Verdict::linear;
    RecoveredAttitude::Pass knots;
    addSwath(bins);
    for (const PassBin& bin : bins) {
      // A pass that shows nothing is level, and takes nothing from its neighbours.
      const PitchAndCrab angles = linear ? PitchAndCrab{bin.pitch(), bin.crab()} : PitchAndCrab();
      const RecoveredAttitude::Knot knot{timeOf(bin), angles};
      if (knots.empty() || knot.time > knots.back().time) knots.push_back(knot);
      if (linear && bin.well_determined) addInstant(bin);
    }
    known_.addPass(std::move(knots));
    passes_.push_back(pass);
  }

  AttitudeRecovery::Outcome outcome(const std::shared_ptr<const Trajectory>& flight, bool turned);

 private:
  double timeOf(const PassBin& bin) const {
    return start_ + static_cast<double>(bin.index) * kAttitudeBin + bin.sums.time / bin.sums.n;
  }
  void addInstant(const PassBin& bin) {
    instants_.push_back({timeOf(bin), bin.pitch(), bin.crab(), passes_.size()});
  }
  void addSwath(const std::vector<PassBin>& bins);
  /// The pass that represents those that are not linear, where these outweigh the others.
  const AttitudeRecovery::Pass* objectingPass() const;

  double start_;
  RecoveredAttitude known_;
  std::vector<AttitudeRecovery::Pass> passes_;
  std::vector<AttitudeRecovery::Instant> instants_;
  std::vector<AttitudeRecovery::Swath> swath_;
};

void Recovered::addSwath(const std::vector<PassBin>& bins) {
  const double scale = detail::recordedScale(bins);
  for (const PassBin& bin : bins) {
    const PulseSums& sums = bin.sums;
    if (sums.n < detail::kFewestOfBin) continue;
    const double recorded = (sums.recorded / scale - sums.seen) / sums.angles;
    swath_.push_back({timeOf(bin), std::atan(sums.leftmost), std::atan(sums.rightmost), recorded,
                      passes_.size()});
  }
}

const AttitudeRecovery::Pass* Recovered::objectingPass() const {
  double all = 0.0, objecting = 0.0;
  const AttitudeRecovery::Pass* largest = nullptr;
  for (const AttitudeRecovery::Pass& pass : passes_) {
    if (pass.verdict == AttitudeRecovery::Verdict::undetermined) continue;
    all += pass.points;
    if (pass.verdict == AttitudeRecovery::Verdict::linear) continue;
    objecting += pass.points;
    if (largest == nullptr || pass.points > largest->points) largest = &pass;
  }
  return objecting > kFewNotLinear * all ? largest : nullptr;
}

AttitudeRecovery::Range united(const std::vector<AttitudeRecovery::Pass>& passes,
                               AttitudeRecovery::Range AttitudeRecovery::Pass::*range) {
  AttitudeRecovery::Range all{std::numeric_limits<double>::infinity(),
                              -std::numeric_limits<double>::infinity()};
  for (const AttitudeRecovery::Pass& pass : passes) {
    if (pass.verdict != AttitudeRecovery::Verdict::linear) continue;
    all = {std::min(all.low, (pass.*range).low), std::max(all.high, (pass.*range).high)};
  }
  return all;
}

/// RMS of pitch and crab together over time, radians.
double rootMeanSquare(const RecoveredAttitude& attitude) {
  double sum = 0.0, knots = 0.0;
  for (const RecoveredAttitude::Pass& pass : attitude.passes()) {
    for (const RecoveredAttitude::Knot& knot : pass) {
      const PitchAndCrab& a = knot.angles;
      sum += a.pitch * a.pitch + a.crab * a.crab;
    }
    knots += static_cast<double>(pass.size());
  }
  return std::sqrt(sum / knots);
}

AttitudeRecovery::Outcome Recovered::outcome(const std::shared_ptr<const Trajectory>& flight,
                                             bool turned) {
  using Pass = AttitudeRecovery::Pass;
  AttitudeRecovery::Outcome outcome;
  outcome.flight = flight;
  outcome.passes = passes_;
  outcome.swath = std::move(swath_);
  std::vector<double> off;
  for (const Pass& pass : passes_) {
    if (pass.verdict != AttitudeRecovery::Verdict::undetermined) off.push_back(pass.off_plane);
  }
  if (off.empty()) {
    outcome.remark = "attitude not recovered from the points: too few of them";
    return outcome;
  }
  outcome.off_plane = medianInPlace(off);
  if (const Pass* pass = objectingPass()) {
    outcome.linear = false;
    outcome.remark = "attitude not recovered: " + detail::objectionTo(*pass) +
                     ", so this is no linear scanner, or the trajectory is another flight's";
    return outcome;
  }
  outcome.found = true;
  outcome.size = rootMeanSquare(known_);
  char plane[80];
  std::snprintf(plane, sizeof plane, " (pulses in a plane to %.4f degrees)",
                outcome.off_plane / kRadiansPerDegree);
  outcome.remark =
      "from the points: " +
      AttitudeRecovery::describe(united(passes_, &Pass::pitch), united(passes_, &Pass::crab)) +
      plane;
  outcome.instants = std::move(instants_);
  if (!turned) return outcome;
  outcome.flight = std::make_shared<const Trajectory>(
      flight->withAttitude([this](double time) { return known_.at(time); }));
  outcome.attitude = std::move(known_);
  return outcome;
}

}  // namespace

void detail::PulseSums::add(const PulseSums& other) {
  n += other.n, time += other.time;
  sum += other.sum, products += other.products;
  leftmost = std::min(leftmost, other.leftmost);
  rightmost = std::max(rightmost, other.rightmost);
  angles += other.angles, seen += other.seen, recorded += other.recorded;
  seen_sq += other.seen_sq, seen_recorded += other.seen_recorded;
  recorded_sq += other.recorded_sq;
}

void detail::PulseSums::addAngle(double seen_angle, double recorded_angle) {
  angles += 1.0, seen += seen_angle, recorded += recorded_angle;
  seen_sq += seen_angle * seen_angle, seen_recorded += seen_angle * recorded_angle;
  recorded_sq += recorded_angle * recorded_angle;
}

AttitudeRecovery::AttitudeRecovery(std::shared_ptr<const Trajectory> flight)
    : flight_(std::move(flight)) {
  if (!flight_ || flight_->hasAttitude()) {
    throw UsageError("attitude recovery: needs a trajectory without attitude");
  }
}

void AttitudeRecovery::add(double time, const Eigen::Vector3d& point, double scan_angle) {
  SensorPose pose;
  if (!flight_->poseAt(time, pose, cursor_)) return;
  const Eigen::Vector3d d = pose.rotation.transpose() * (point - pose.position);
  if (!d.allFinite() || !(d.z() < 0.0)) return;
  const Eigen::Vector3d pulse = d.normalized();
  const double from_start = time - flight_->startTime();
  const double bin = std::floor(from_start / kAttitudeBin);
  const double across = d.x() / -d.z();
  PulseSums sums;
  sums.n = 1.0, sums.time = from_start - bin * kAttitudeBin;
  sums.sum = pulse, sums.products = pulse * pulse.transpose();
  sums.leftmost = sums.rightmost = across;
  if (std::isfinite(scan_angle)) sums.addAngle(std::atan(across), scan_angle);
  bins_[static_cast<std::int64_t>(bin)].add(sums);
}

void AttitudeRecovery::add(const PointColumns& points, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    add(points.time[i], {points.x[i], points.y[i], points.z[i]});
  }
}

void AttitudeRecovery::put(ByteWriter& out) const {
  out.put(bins_.bucket_count());
  out.putMap(bins_, [](ByteWriter& o, const detail::PulseSums& sums) { o.plain(sums); });
}

void AttitudeRecovery::get(ByteReader& in) {
  const auto buckets = in.take<std::size_t>();
  in.getHashed(bins_, buckets, [](ByteReader& i, detail::PulseSums& sums) { i.plain(sums); });
}

void AttitudeRecovery::merge(const AttitudeRecovery& other) {
  for (const auto& [bin, sums] : other.bins_) bins_[bin].add(sums);
}

AttitudeRecovery::Outcome AttitudeRecovery::assess() const {
  Recovered recovered(flight_->startTime());
  for (std::vector<PassBin>& bins : passesOf(bins_)) recovered.add(bins);
  return recovered.outcome(flight_, false);
}

AttitudeRecovery::Outcome AttitudeRecovery::recover() const {
  Recovered recovered(flight_->startTime());
  for (std::vector<PassBin>& bins : passesOf(bins_)) recovered.add(bins);
  return recovered.outcome(flight_, true);
}

std::string AttitudeRecovery::describe(const Range& pitch, const Range& crab) {
  char text[120];
  std::snprintf(text, sizeof text, "pitch %.2f ... %.2f, crab %.2f ... %.2f degrees",
                pitch.low / kRadiansPerDegree, pitch.high / kRadiansPerDegree,
                crab.low / kRadiansPerDegree, crab.high / kRadiansPerDegree);
  return text;
}

}  // namespace pcl_als
