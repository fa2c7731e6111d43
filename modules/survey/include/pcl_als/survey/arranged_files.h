// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/io/survey_census.h>
#include <pcl_als/survey/strip_arrangement.h>

namespace pcl_als {

/// The strips of an arrangement for takeCensus() of the same files in the same order; adds the
/// points of each label to \a counts. Both must exist as long as the result.
CensusStrips censusStrips(const StripArrangement& arrangement, std::vector<std::uint64_t>& counts);

/** \brief Point files, read once, and the arrangement of their points into strips, for jobs that
 * use points by strip without a trajectory.
 *
 * Reading a file again gives each of its points a label through StripArrangement::Sorter.
 */
class ArrangedFiles {
 public:
  /// InputError for a file that cannot be read, or where no strip remains; UsageError for a strip
  /// that \a choice names and no file has. Strips are those of the points in \a window.
  ArrangedFiles(const std::vector<std::filesystem::path>& paths, const StripChoice& choice,
                const PointWindow& window = {});
  ArrangedFiles(const ArrangedFiles&) = delete;
  ArrangedFiles& operator=(const ArrangedFiles&) = delete;

  const std::vector<SurveyedFile>& files() const { return files_; }
  const StripArrangement& arrangement() const { return arrangement_; }

  /// Used points of all files, and points that are left out.
  struct Use {
    std::vector<std::uint64_t> points;       ///< by strip
    std::vector<Eigen::AlignedBox3d> boxes;  ///< of these, metres
    std::vector<LeftOutPoints> left_out;

    std::uint64_t pointCount() const;
    Eigen::AlignedBox3d box() const;
  };
  /// Reads all files again.
  Use use() const;

 private:
  PointWindow window_;
  std::vector<SurveyedFile> files_;
  StripArrangement arrangement_;
};

/// takeCensus() of files with their points arranged into the strips of \a choice, whose names are
/// listed instead of source ids; adds the points that are left out to \a left_out.
SurveyCensus takeCensus(const std::vector<std::filesystem::path>& files, double cell,
                        const std::function<void(double)>& progress, const StripChoice& choice,
                        const PointWindow& window, std::vector<LeftOutPoints>& left_out);

}  // namespace pcl_als
