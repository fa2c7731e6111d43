// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <limits>
#include <map>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/processing/intensity_input.h>

namespace pcl_als {

/// Points of one strip, one after the other in the file.
struct PointRun {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::uint16_t source = 0;
  std::uint64_t points = 0, zeros = 0;
  double largest = 0.0;    ///< intensity
  TimeRange times;         ///< without zeros
  bool zero_time = false;  ///< there are points of time 0
  Eigen::Vector3d minimum = Eigen::Vector3d::Constant(kInfinity), maximum = -minimum;
};

/// Collects statistics of the points of a survey.
class SurveyStatistics {
 public:
  void add(const PointRun& run);
  /// Adds some points of a strip to its track.
  void addPlaces(std::uint16_t source, const PointChunk& points) {
    tracks_[source].add(points, 0, points.size());
  }
  void merge(const SurveyStatistics& other);
  void store(IntensitySurvey& survey) const;

 private:
  void add(const PointSource& source);

  std::map<std::uint16_t, PointSource> sources_;
  std::map<std::uint16_t, SwathTrack> tracks_;
  TimeRange times_, zero_times_;
  std::uint64_t zeros_ = 0;
  double largest_ = 0.0;
};

}  // namespace pcl_als
