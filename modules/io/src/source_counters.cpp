// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "source_counters.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <pcl_als/common/lidar_return.h>

#include "week_rollover.h"

namespace pcl_als::detail {
namespace {

constexpr double kFarthest = 1e9;      // metres
constexpr double kLargestTime = 1e12;  // seconds
constexpr double kLeastGap = 1e-9;     // rounding of times is no gap

std::uint64_t placesIn(const PointStatistics& s) {
  return s.points - s.invalid_coordinates;
}
std::uint64_t timesIn(const PointStatistics& s) {
  return s.points - s.invalid_times;
}

/// A range without values is no range.
void mergeRanges(PointStatistics& into, const PointStatistics& other) {
  if (placesIn(other) > 0) {
    const bool first = placesIn(into) == 0;
    into.minimum = first ? other.minimum : into.minimum.cwiseMin(other.minimum);
    into.maximum = first ? other.maximum : into.maximum.cwiseMax(other.maximum);
  }
  if (timesIn(other) > 0) {
    const bool first = timesIn(into) == 0;
    into.first_time = first ? other.first_time : std::min(into.first_time, other.first_time);
    into.last_time = first ? other.last_time : std::max(into.last_time, other.last_time);
  }
}

bool isPlace(double x, double y, double z) {
  // Also false for NaN.
  return std::abs(x) < kFarthest && std::abs(y) < kFarthest && std::abs(z) < kFarthest;
}

}  // namespace

void TimeBins::add(double time) {
  const auto key = static_cast<std::int64_t>(std::floor(time / kBin));
  if (!last_ || key != last_key_) {
    if (bins_.size() >= kMaximumTimes && bins_.count(key) == 0) return;
    last_ = &bins_.insert({key, {time, time}}).first->second;
    last_key_ = key;
  }
  last_->first = std::min(last_->first, time);
  last_->second = std::max(last_->second, time);
}

void TimeBins::add(const TimeBins& other) {
  for (const auto& bin : other.bins_) {
    add(bin.second.first);
    add(bin.second.second);
  }
}

std::vector<TimeGap> TimeBins::gaps(double longer_than) const {
  std::vector<TimeGap> gaps;
  const std::pair<double, double>* before = nullptr;
  for (const auto& bin : bins_) {
    if (before != nullptr && bin.second.first - before->second > longer_than + kLeastGap)
      gaps.push_back({before->second, bin.second.first});
    before = &bin.second;
  }
  return gaps;
}

std::vector<TimeRange> TimeBins::ranges() const {
  std::vector<TimeRange> ranges;
  for (const auto& bin : bins_) ranges.push_back({bin.second.first, bin.second.second});
  return ranges;
}

void SourceCounters::unwrap(double rollover) {
  if (!(statistics_.first_time < rollover)) return;
  TimeBins bins;
  TimeRange all;
  for (const TimeRange& range : times_.ranges()) {
    const double shift = range.first < rollover ? kSecondsPerWeek : 0.0;
    bins.add(range.first + shift);
    bins.add(range.last + shift);
    all.add(range.first + shift);
    all.add(range.last + shift);
  }
  times_ = std::move(bins);
  statistics_.first_time = all.first, statistics_.last_time = all.last;
}

void SourceCounters::add(const PointChunk& chunk, std::size_t first, std::size_t last,
                         double cell) {
  const double inverse_cell = 1.0 / cell;
  for (std::size_t i = first; i < last; ++i) {
    if (isPlace(chunk.x[i], chunk.y[i], chunk.z[i]))
      addPlace(chunk, i, inverse_cell);
    else
      ++statistics_.invalid_coordinates;
    addTime(chunk.gps_time[i]);
    addAttributes(chunk, i);
    ++statistics_.points;
  }
}

void SourceCounters::addPlace(const PointChunk& chunk, std::size_t i, double inverse_cell) {
  const Eigen::Vector3d place(chunk.x[i], chunk.y[i], chunk.z[i]);
  if (placesIn(statistics_) == 0) statistics_.minimum = statistics_.maximum = place;
  statistics_.minimum = statistics_.minimum.cwiseMin(place);
  statistics_.maximum = statistics_.maximum.cwiseMax(place);
  cells_.add(static_cast<std::int64_t>(std::floor(place.x() * inverse_cell)),
             static_cast<std::int64_t>(std::floor(place.y() * inverse_cell)));
}

void SourceCounters::addTime(double time) {
  if (!(std::abs(time) < kLargestTime)) {
    ++statistics_.invalid_times;
    return;
  }
  if (time == 0.0)
    ++statistics_.zero_times;
  else
    resolution_.add(time);
  if (timesIn(statistics_) == 0)
    statistics_.first_time = statistics_.last_time = previous_time_ = time;
  statistics_.first_time = std::min(statistics_.first_time, time);
  statistics_.last_time = std::max(statistics_.last_time, time);
  if (time < previous_time_ && !isWeekRollover(previous_time_, time)) ++statistics_.unsorted_times;
  previous_time_ = time;
  times_.add(time);
}

void SourceCounters::addAttributes(const PointChunk& chunk, std::size_t i) {
  const float angle = chunk.scan_angle[i], intensity = chunk.intensity[i];
  if (statistics_.points == 0) {
    statistics_.least_scan_angle = statistics_.largest_scan_angle = angle;
    statistics_.least_intensity = statistics_.largest_intensity = intensity;
  }
  statistics_.least_scan_angle = std::min(statistics_.least_scan_angle, angle);
  statistics_.largest_scan_angle = std::max(statistics_.largest_scan_angle, angle);
  statistics_.least_intensity = std::min(statistics_.least_intensity, intensity);
  statistics_.largest_intensity = std::max(statistics_.largest_intensity, intensity);
  const unsigned number = chunk.return_number[i], returns = chunk.number_of_returns[i];
  statistics_.first_returns += number == 1 ? 1 : 0;
  statistics_.single_returns += number == 1 && returns == 1 ? 1 : 0;
  statistics_.wrong_returns += number == 0 || number > returns ? 1 : 0;
  ++statistics_.returns[std::min(number, 15U)];
  ++statistics_.classes[chunk.classification[i]];
  statistics_.withheld += (chunk.flags[i] & kWithheld) != 0 ? 1 : 0;
  statistics_.synthetic += (chunk.flags[i] & kSynthetic) != 0 ? 1 : 0;
  statistics_.overlap_flags += (chunk.flags[i] & kOverlap) != 0 ? 1 : 0;
  ++statistics_.channels[chunk.flags[i] >> 6U];
}

void SourceCounters::add(const SourceCounters& other) {
  mergeStatistics(statistics_, other.statistics_);
  times_.add(other.times_);
  resolution_.add(other.resolution_);
  cells_.add(other.cells_);
}

void mergeStatistics(PointStatistics& into, const PointStatistics& other) {
  if (other.points == 0) return;
  if (into.points == 0) {
    into = other;
    return;
  }
  mergeRanges(into, other);
  into.least_scan_angle = std::min(into.least_scan_angle, other.least_scan_angle);
  into.largest_scan_angle = std::max(into.largest_scan_angle, other.largest_scan_angle);
  into.least_intensity = std::min(into.least_intensity, other.least_intensity);
  into.largest_intensity = std::max(into.largest_intensity, other.largest_intensity);
  for (auto count :
       {&PointStatistics::points, &PointStatistics::single_returns, &PointStatistics::first_returns,
        &PointStatistics::unsorted_times, &PointStatistics::zero_times,
        &PointStatistics::invalid_times, &PointStatistics::invalid_coordinates,
        &PointStatistics::wrong_returns, &PointStatistics::withheld, &PointStatistics::synthetic,
        &PointStatistics::overlap_flags})
    into.*count += other.*count;
  for (std::size_t i = 0; i < into.classes.size(); ++i) into.classes[i] += other.classes[i];
  for (std::size_t i = 0; i < into.returns.size(); ++i) into.returns[i] += other.returns[i];
  for (std::size_t i = 0; i < into.channels.size(); ++i) into.channels[i] += other.channels[i];
}

}  // namespace pcl_als::detail
