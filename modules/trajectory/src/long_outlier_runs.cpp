// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Runs of wrong samples that are too long to be bridged, and steps that no aircraft flies.
#include <algorithm>
#include <limits>

#include "sample_screening.h"

namespace pcl_als::detail {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
constexpr double kLargeStep = 20.0;  // metres
constexpr double kLargeTurn = 30.0 * kRadiansPerDegree;
constexpr double kSpinning = 360.0 * kRadiansPerDegree;  // rad/s
constexpr double kFast = 25.0, kSound = 340.0;           // m/s

constexpr double kTimesFlown = 3.0, kTimesMisfit = 10.0, kAcceleration = 10.0;
constexpr double kLongestTurned = 10.0;  // seconds
constexpr std::size_t kPairs = 16;

double largestTurn(const SampleValues& difference) {
  const ChannelValues c = channelsOf(difference);
  return std::max({c[kChannelRoll], c[kChannelPitch], c[kChannelHeading]});
}

}  // namespace

Eigen::Vector3d SampleScreening::velocityBeside(std::size_t rank, bool earlier,
                                                const Piece& piece) const {
  std::size_t far = rank;
  for (int i = 0; i < 4; ++i) {
    const std::size_t next = earlier ? before(far, piece) : behind(far, piece);
    if (next == kNone) break;
    far = next;
  }
  const double step = at(rank).time - at(far).time;
  if (step == 0.0) return Eigen::Vector3d::Zero();
  return (at(rank).position - at(far).position) / step;
}

std::vector<SampleScreening::Step> SampleScreening::largeSteps(const Piece& piece) const {
  std::vector<Step> steps;
  std::size_t rank = piece.first;
  if (excluded_[rank]) rank = behind(rank, piece);
  for (std::size_t next; rank != kNone; rank = next) {
    next = behind(rank, piece);
    if (next == kNone) break;
    const double time = at(next).time - at(rank).time;
    const SampleValues moved = valuesRelativeTo(at(next), at(rank));
    const double distance = moved.head<3>().norm(), turn = largestTurn(moved);
    const bool jumps = distance > kLargeStep + kTimesFlown * scale_.speed * time;
    const bool turns = turn > kLargeTurn + kSpinning * time;
    if (jumps || turns) steps.push_back({rank, next, jumps ? distance : 0.0, turns ? turn : 0.0});
  }
  return steps;
}

/// The path away and back: it goes on where it left.
bool SampleScreening::returns(const Step& away, const Step& back, const Piece& piece,
                              OutlierRun& run) const {
  const TrajectorySample &p = at(away.from), &q = at(back.to);
  const double time = q.time - p.time;
  const Eigen::Vector3d left = velocityBeside(away.from, true, piece),
                        right = velocityBeside(back.to, false, piece);
  const double misfit = (p.position + 0.5 * time * (left + right) - q.position).norm();
  const double distance = std::min(away.distance, back.distance);
  if (distance > kLargeStep + kTimesMisfit * misfit + kAcceleration * time * time / 8.0)
    run.distance = distance;
  const double turn = std::min(away.turn, back.turn);
  if (turn > kLargeTurn + kTimesFlown * largestTurn(valuesRelativeTo(q, p)) &&
      time < kLongestTurned && std::min(left.norm(), right.norm()) > kFast &&
      !headingFollowsCourse({away.to, back.from, piece}, turn))
    run.turn = turn;
  return run.distance > 0.0 || run.turn > 0.0;
}

void SampleScreening::findLongRuns(const Piece& piece) {
  const std::vector<Step> steps = largeSteps(piece);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    for (std::size_t j = i + 1; j < std::min(steps.size(), i + kPairs); ++j) {
      OutlierRun run;
      if (!returns(steps[i], steps[j], piece, run)) continue;
      run.from = at(steps[i].to).time, run.to = at(steps[j].from).time;
      for (std::size_t rank = steps[i].to; rank <= steps[j].from; ++rank)
        run.samples.push_back(indexOf(rank));
      screening_.long_runs.push_back(std::move(run));
      i = j;
      break;
    }
  }
}

void SampleScreening::findJumps() {
  for (const Piece& piece : pieces_) {
    for (const Step& step : largeSteps(piece)) {
      const double time = at(step.to).time - at(step.from).time;
      if (step.distance <= kLargeStep + (kSound + kTimesFlown * scale_.speed) * time) continue;
      screening_.jumps.push_back(indexOf(step.to));
      screening_.farthest_jump = std::max(screening_.farthest_jump, step.distance);
    }
  }
}

}  // namespace pcl_als::detail
