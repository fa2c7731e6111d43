// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flight_check.h"

#include <algorithm>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_sample.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als::detail {
namespace {

/// Whether the points can have been measured from the trajectory, by source id.
class FlightCheck {
 public:
  explicit FlightCheck(std::shared_ptr<const Trajectory> flight)
      : check_(std::move(flight), TrajectoryPlausibility::Attitude::needed) {}

  void add(std::uint16_t source, const LidarReturn& point) {
    check_.add(stripOf(source), point.time, point.position, point.scan_angle);
    addReturn(source, point);
  }
  /// Of a run of consecutive points.
  void addReturn(std::uint16_t source, const LidarReturn& point) {
    check_.addTime(stripOf(source), point.time);
    check_.addReturn(stripOf(source), point);
  }
  /// Warnings; a refusal is an InputError that names the file.
  Warnings result(const std::string& name, bool force) const {
    try {
      return check_.check(force);
    } catch (const InputError& error) {
      throw InputError(name + ": " + error.what(), error.hint());
    }
  }

 private:
  int stripOf(std::uint16_t source) {
    const auto [at, fresh] = strips_.try_emplace(source, 0);
    if (fresh) at->second = check_.addStrip(std::to_string(source));
    return at->second;
  }

  TrajectoryPlausibility check_;
  std::map<std::uint16_t, int> strips_;
};

}  // namespace

LidarReturn returnOf(const Strip<PointLidar>& strip, std::size_t row, double time) {
  const PointLidar& stored = (*strip.cloud)[row];
  LidarReturn point;
  point.position = strip.frame.origin + stored.getVector3fMap().cast<double>();
  point.time = time;
  point.scan_angle = stored.scan_angle;
  point.return_number = stored.return_number;
  point.number_of_returns = stored.number_of_returns;
  point.classification = stored.classification;
  point.flags = stored.flags;
  point.channel = static_cast<std::uint8_t>(stored.flags >> 6U);
  return point;
}

Warnings checkFlight(const LasFile& file, const TimeAlignment& alignment,
                     const std::shared_ptr<const Trajectory>& flight, bool force) {
  FlightCheck check(flight);
  const SampleSize size = flight->hasAttitude() ? SampleSize::forAttitude() : SampleSize();
  samplePoints(file, size, [&](const PointChunk& chunk) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      check.add(chunk.point_source_id[i], chunk.point(i, alignment(chunk.gps_time[i])));
    }
  });
  return check.result(file.path().string(), force);
}

Warnings checkFlight(const std::string& name, const Strip<PointLidar>& strip,
                     const TimeAlignment& alignment,
                     const std::shared_ptr<const Trajectory>& flight, bool force) {
  FlightCheck check(flight);
  const SampleSize size = flight->hasAttitude() ? SampleSize::forAttitude() : SampleSize();
  const std::size_t every = std::max<std::size_t>(1, strip.cloud->size() / size.points());
  for (std::size_t i = 0; i < strip.cloud->size(); ++i) {
    const PointLidar& stored = (*strip.cloud)[i];
    const LidarReturn point = returnOf(strip, i, alignment(stored.gps_time));
    if (i % every == 0)
      check.add(stored.point_source_id, point);
    else
      check.addReturn(stored.point_source_id, point);
  }
  return check.result(name, force);
}

}  // namespace pcl_als::detail
