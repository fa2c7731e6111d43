// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/io/point_reader.h>
#include <pcl_als/survey/surveyed_file.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::test {

/// Place of the aircraft at a time.
using Path = std::function<Eigen::Vector2d(double)>;

inline Path straight(const Eigen::Vector2d& start, double course_degrees, double begins,
                     double speed = 60.0) {
  const double course = course_degrees * 3.14159265358979 / 180.0;
  const Eigen::Vector2d velocity = speed * Eigen::Vector2d(std::sin(course), std::cos(course));
  return [=](double time) { return Eigen::Vector2d(start + (time - begins) * velocity); };
}

inline void addPoint(PointChunk& chunk, std::uint16_t id, double time, const Eigen::Vector2d& at) {
  const std::size_t i = chunk.size();
  chunk.resize(i + 1);
  chunk.point_source_id[i] = id;
  chunk.gps_time[i] = time;
  chunk.x[i] = at.x();
  chunk.y[i] = at.y();
}

/// Points of a scanner of 40 lines a second and 300 m of swath: 50 points a line, from both ends in
/// turn, from one time until before another.
inline void scan(PointChunk& chunk, std::uint16_t id, const Path& path, double from, double until) {
  constexpr double kStep = 1.0 / 2000.0;
  const auto steps = static_cast<std::size_t>((until - from) / kStep);
  for (std::size_t i = 0; i < steps; ++i) {
    const double time = from + kStep * static_cast<double>(i);
    const Eigen::Vector2d flight = path(time + 0.05) - path(time - 0.05);
    const Eigen::Vector2d right = Eigen::Vector2d(flight.y(), -flight.x()).normalized();
    const double phase = std::fmod(40.0 * time, 2.0);
    const double aside = 300.0 * ((phase < 1.0 ? phase : 2.0 - phase) - 0.5);
    addPoint(chunk, id, time, path(time) + aside * right);
  }
}

inline SurveyedFile surveyed(const std::string& path, const PointChunk& chunk) {
  SurveyedFile file;
  file.sources.info.path = path;
  file.sources.info.point_count = chunk.size();
  file.sources.info.time_kind = TimeKind::week_seconds;
  std::map<std::uint16_t, PointSource> sources;
  for (std::size_t i = 0; i < chunk.size(); ++i) {
    const double time = chunk.gps_time[i];
    const Eigen::Vector3d at(chunk.x[i], chunk.y[i], chunk.z[i]);
    const std::uint16_t id = chunk.point_source_id[i];
    const PointSource one{id, 1, time, time, at, at, time == 0.0 ? 1U : 0U};
    const auto [known, added] = sources.try_emplace(id, one);
    if (!added) known->second.merge(one);
    file.tracks[id].add(chunk, i, i + 1);
  }
  for (const auto& entry : sources) file.sources.sources.push_back(entry.second);
  return file;
}

inline Trajectory flown(const Path& path, double from, double to, double step = 0.1) {
  std::vector<TrajectorySample> samples;
  const auto count = static_cast<std::size_t>(std::lround((to - from) / step));
  for (std::size_t i = 0; i <= count; ++i) {
    TrajectorySample sample;
    sample.time = from + step * static_cast<double>(i);
    sample.position << path(sample.time), 1000.0;
    samples.push_back(sample);
  }
  return Trajectory(std::move(samples));
}

}  // namespace pcl_als::test
