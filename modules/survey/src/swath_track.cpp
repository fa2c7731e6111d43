// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/survey/swath_track.h>

namespace pcl_als {
namespace {

constexpr double kCentimetres = 100.0;  // in a metre
// Metres: larger values are no places on Earth. Sums of 9e8 such coordinates fit into 64 bits.
constexpr double kFarthest = 1e8;
constexpr double kLatest = 1e12;  // seconds: larger values are not valid

}  // namespace

Eigen::Vector2d SwathTrack::Bin::mean() const {
  const double count = kCentimetres * static_cast<double>(std::max<std::uint64_t>(placed, 1));
  return {static_cast<double>(x_sum) / count, static_cast<double>(y_sum) / count};
}

void SwathTrack::Bin::merge(const Bin& other) {
  if (other.points == 0) return;
  first = points == 0 ? other.first : std::min(first, other.first);
  last = points == 0 ? other.last : std::max(last, other.last);
  points += other.points;
  placed += other.placed;
  x_sum += other.x_sum;
  y_sum += other.y_sum;
}

std::int64_t SwathTrack::indexOf(double time) const {
  return static_cast<std::int64_t>(std::floor(time / width_));
}

void SwathTrack::add(const PointChunk& chunk, std::size_t from, std::size_t to) {
  Bin run;  // points of one bin that follow each other
  std::int64_t run_index = 0;
  for (std::size_t i = from; i < to; ++i) {
    const double time = chunk.gps_time[i];
    if (!(std::abs(time) < kLatest) || time == 0.0) continue;
    const std::int64_t index = indexOf(time);
    if (run.points == 0 || index != run_index) {
      if (run.points > 0) bins_[run_index].merge(run);
      run = {time, time, 0, 0, 0, 0};
      run_index = index;
    }
    run.first = std::min(run.first, time);
    run.last = std::max(run.last, time);
    ++run.points;
    if (!(std::abs(chunk.x[i]) < kFarthest && std::abs(chunk.y[i]) < kFarthest)) continue;
    ++run.placed;
    run.x_sum += std::llround(kCentimetres * chunk.x[i]);
    run.y_sum += std::llround(kCentimetres * chunk.y[i]);
  }
  if (run.points > 0) bins_[run_index].merge(run);
  limitMemory();
}

void SwathTrack::merge(const SwathTrack& other, const TimeAlignment& alignment) {
  while (width_ < other.width_) doubleWidth();
  for (const auto& [index, theirs] : other.bins_) {
    Bin bin = theirs;
    bin.first = alignment(theirs.first);
    bin.last = alignment(theirs.last);
    bins_[indexOf(bin.first)].merge(bin);
  }
  limitMemory();
}

std::uint64_t SwathTrack::pointCount() const {
  std::uint64_t count = 0;
  for (const auto& entry : bins_) count += entry.second.points;
  return count;
}

void SwathTrack::limitMemory() {
  while (bins_.size() > kMostBins) doubleWidth();
}

void SwathTrack::doubleWidth() {
  width_ *= 2.0;
  std::map<std::int64_t, Bin> wider;
  for (const auto& entry : bins_) wider[indexOf(entry.second.first)].merge(entry.second);
  bins_ = std::move(wider);
}

}  // namespace pcl_als
