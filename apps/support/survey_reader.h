// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/calibration/calibration_point.h>
#include <pcl_als/io/strip_naming.h>
#include <pcl_als/io/time_reference.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::app {

/** \brief The point files of a survey as strips: read again and again, chunk by chunk.
 *
 * Strips are named by StripNaming. Files that share a strip are read one after the other in the
 * given order, others at the same time: what a strip sees does not depend on the number of threads.
 */
class SurveyReader {
 public:
  using Sink = std::function<void(int strip, const CalibrationPoint* points, std::size_t count)>;
  /// Points [from, to) of a chunk, all of one strip, with every field.
  struct Run {
    const PointChunk& chunk;
    std::size_t from, to;
    const TimeAlignment& time;  ///< to the trajectory's clock

    CalibrationPoint point(std::size_t row) const;
  };
  using RunSink = std::function<void(int strip, const Run& run)>;

  /// Looks at all files once (ids, times, extents). InputError for a file that cannot be read.
  SurveyReader(const std::vector<std::string>& paths, int threads);

  const std::vector<std::string>& strips() const { return naming_->names(); }
  std::uint64_t pointCount() const;
  /// CRS of the first file that has one; empty when none has.
  std::string crs() const;
  /// Box of all points in plan, metres; empty when there are none.
  Eigen::AlignedBox2d extent() const;
  /// South-west corner of all points, metres.
  Eigen::Vector2d corner() const;
  /// North-east corner of all points, metres.
  Eigen::Vector2d farCorner() const;
  /// Finest coordinate step of the files, metres.
  double resolution() const;

  const std::vector<PointFileSources>& files() const { return files_; }
  const StripNaming& naming() const { return *naming_; }

  /// Matches the files' times to the trajectory's; returns what was assumed, one line each.
  std::vector<std::string> alignTimes(const Trajectory& trajectory, std::optional<int> gps_week);

  /// Calls \a sink with all points, in runs of one strip; from several threads for different
  /// strips.
  void read(const Sink& sink) const;
  /// The same with all that the files know of the points.
  void readRuns(const RunSink& sink) const;

 private:
  void readFile(std::size_t file, const RunSink& sink) const;
  std::vector<std::vector<std::size_t>> groupsOfFiles() const;

  int threads_;
  std::vector<PointFileSources> files_;
  std::optional<StripNaming> naming_;
  std::vector<TimeAlignment> times_;
};

}  // namespace pcl_als::app
