// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// Successive samples (in order of time) that contradict the samples on either side.
struct OutlierRun {
  std::vector<std::size_t> samples;  ///< indices, in order of time
  double from = 0.0, to = 0.0;       ///< times of the first and the last one, seconds
  double distance = 0.0;             ///< from the path of the others, metres
  double turn = 0.0;  ///< difference of roll, pitch or heading from the others, radians

  /// Whether the position is beside the path; otherwise the attitude is wrong.
  bool inPosition() const { return distance > 0.0; }
};

/** \brief Samples of a trajectory that contradict their neighbours.
 *
 * The result of screenTrajectory(). Single samples and short runs can be excluded, because the path
 * and the attitude between their neighbours follow from these. Longer runs, and more outliers than
 * a hundredth of the samples, cannot: objection() says why.
 */
struct TrajectoryScreening {
  /// Names a sample in messages, such as "line 12".
  using SampleName = std::function<std::string(std::size_t)>;

  std::size_t samples = 0;            ///< all that were screened
  std::vector<OutlierRun> outliers;   ///< in order of time; they can be excluded
  std::vector<OutlierRun> long_runs;  ///< in order of time; too long to be bridged
  /// The first sample of each step that no aircraft flies, with the outliers excluded.
  std::vector<std::size_t> jumps;
  double farthest_jump = 0.0;  ///< metres

  std::size_t outlierCount() const;
  bool empty() const { return outliers.empty() && long_runs.empty(); }
  /// Why the trajectory cannot be used, with the first samples concerned and the hint; empty
  /// where it can.
  std::string objection(const SampleName& name = &sampleNumber) const;
  /// "3 of 908 samples contradict their neighbours and are excluded: line 12 (401500.125 s):
  /// 1203 m beside the path, …"; empty without outliers.
  std::string describe(const SampleName& name = &sampleNumber) const;
  /// Indices of the outliers, ascending.
  std::vector<std::size_t> indices() const;

  static std::string sampleNumber(std::size_t index);
};

/** \brief Finds samples whose position, time or attitude contradicts their neighbours.
 *
 * A sample, or a run of at most ten that the gap threshold of Trajectory covers, is an outlier if a
 * cubic through the four samples before and the four behind agrees with all of these, but not with
 * its first and its last sample. The limit is the largest of six times the residuals of the
 * neighbours, of six times the residuals of most samples of the flight, and of what an aircraft can
 * move or turn within a step and back. The change must happen within one step. A wrong time is a
 * wrong position at that time. Rounded values, noise, turns, stops, spins, gaps, and paths that
 * consist of pieces are no outliers. At the end of a piece the step has to exceed the speed (rate
 * of turn) of the flight by a factor.
 *
 * Samples may be in any order; angles are in radians, positions in metres. Without attitude in a
 * sample, attitude is not compared there.
 */
TrajectoryScreening screenTrajectory(const std::vector<TrajectorySample>& samples);

/// Removes the elements of \a values at ascending \a indices.
template <typename T>
void removeAt(std::vector<T>& values, const std::vector<std::size_t>& indices) {
  std::size_t kept = 0, next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (next < indices.size() && indices[next] == i) {
      ++next;
      continue;
    }
    if (kept != i) values[kept] = std::move(values[i]);
    ++kept;
  }
  values.resize(kept);
}

}  // namespace pcl_als
