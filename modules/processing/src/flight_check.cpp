// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flight_check.h"

#include <algorithm>
#include <map>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/las/las_sample.h>
#include <pcl_als/trajectory/trajectory_plausibility.h>

namespace pcl_als::detail {
namespace {

/// Whether the points can have been measured from the trajectory, by source id.
class FlightCheck {
 public:
  explicit FlightCheck(std::shared_ptr<const Trajectory> flight) : check_(std::move(flight)) {}

  void add(std::uint16_t source, double time, const Eigen::Vector3d& point, float scan_angle) {
    check_.add(stripOf(source), time, point, scan_angle);
    addTime(source, time);
  }
  void addTime(std::uint16_t source, double time) { check_.addTime(stripOf(source), time); }
  /// Warnings; a refusal is an InputError that names the file. The model is that of the biases: a
  /// wrong attitude has no remedy here.
  Warnings result(const std::string& name, bool force) const {
    try {
      Warnings warnings = check_.check(force);
      for (Warning& warning : warnings) warning.remedy = Remedy::none;
      return warnings;
    } catch (const InputError& error) {
      throw InputError(name + ": " + error.what());
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

Warnings checkFlight(const LasFile& file, const TimeAlignment& alignment,
                     const std::shared_ptr<const Trajectory>& flight, bool force) {
  FlightCheck check(flight);
  const SampleSize size = flight->hasAttitude() ? SampleSize::forAttitude() : SampleSize();
  samplePoints(file, size, [&](const PointChunk& chunk) {
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      check.add(chunk.point_source_id[i], alignment(chunk.gps_time[i]),
                {chunk.x[i], chunk.y[i], chunk.z[i]}, chunk.scan_angle[i]);
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
    const PointLidar& point = (*strip.cloud)[i];
    if (i % every != 0) {
      check.addTime(point.point_source_id, alignment(point.gps_time));
      continue;
    }
    check.add(point.point_source_id, alignment(point.gps_time),
              strip.frame.origin + point.getVector3fMap().cast<double>(), point.scan_angle);
  }
  return check.result(name, force);
}

}  // namespace pcl_als::detail
