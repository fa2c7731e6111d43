// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "file_times.h"

#include <algorithm>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als::detail {
namespace {

/// Times of points; zero, which means "none", is used only where there is no other time.
class TimeSpread {
 public:
  void add(double time) { (time == 0.0 ? zeros_ : range_).add(time); }
  TimeRange range() const { return range_.empty() ? zeros_ : range_; }

 private:
  TimeRange range_, zeros_;
};

TimeRange rangeOf(const Trajectory& trajectory) {
  return {trajectory.startTime(), trajectory.endTime()};
}

/// Times of \a probes runs of \a run points, spread over the file.
TimeRange probedTimes(const LasFile& file, std::uint64_t probes, std::uint64_t run) {
  const std::uint64_t count = file.header().point_count;
  const std::size_t length = file.header().record_length;
  std::vector<std::byte> records(std::min(run, count) * length);
  TimeSpread times;
  for (std::uint64_t probe = 0; probe < probes; ++probe) {
    const std::uint64_t first =
        probe + 1 == probes ? count - std::min(run, count) : count / probes * probe;
    const std::uint64_t size = std::min(run, count - first);
    file.readRecords(first, size, records.data());
    for (std::uint64_t i = 0; i < size; ++i) {
      times.add(file.layout().timeOf(&records[i * length]));
    }
  }
  return times.range();
}

}  // namespace

/// A few points of a file show its whole week; all are read only where few are missing.
TimeAlignment alignmentOf(const LasFile& file, const Trajectory& flight,
                          std::optional<int> gps_week) {
  if (file.header().point_count == 0) return {};
  constexpr std::uint64_t kBlock = std::uint64_t{1} << 16;
  const std::string name = file.path().string();
  const TimeRange trajectory = rangeOf(flight);
  const TimeKind kind = file.info().time_kind;
  // Each probe of a compressed file unpacks a chunk of it.
  const std::uint64_t probes = file.header().compressed ? 8 : 1000;
  try {
    const TimeRange few = probedTimes(file, std::min(probes, file.header().point_count), 1);
    return reconcileTimes(name, few, kind, trajectory, gps_week);
  } catch (const InputError&) {
    const std::uint64_t blocks = (file.header().point_count + kBlock - 1) / kBlock;
    const TimeRange all = probedTimes(file, blocks + 1, kBlock);
    return reconcileTimes(name, all, kind, trajectory, gps_week);
  }
}

TimeAlignment alignmentOf(const std::string& name, const Strip<PointLidar>& strip,
                          const Trajectory& flight, std::optional<int> gps_week) {
  if (strip.cloud->empty()) return {};
  TimeSpread times;
  for (const PointLidar& point : *strip.cloud) times.add(secondsOfTime(point.gps_time));
  return reconcileTimes(name, times.range(), TimeKind::none, rangeOf(flight), gps_week);
}

}  // namespace pcl_als::detail
