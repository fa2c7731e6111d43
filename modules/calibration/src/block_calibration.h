// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/shared_vectors.h>
#include <pcl_als/common/shared_work.h>
#include <pcl_als/survey/area_index.h>

#include "block.h"
#include "shared_errors.h"

namespace pcl_als {

class AreaMatcher;

/// What the coordinates of points are corrected for.
struct Corrections {
  SystemVector biases = SystemVector::Zero();  ///< of the first system
  std::vector<SystemUnknowns> differences;     ///< of the systems to the first one
  ErrorSourceVector sources = ErrorSourceVector::Zero();

  bool isZero() const;
  bool operator==(const Corrections& other) const {
    return biases == other.biases && differences == other.differences && sources == other.sources;
  }
};

/** \brief The points of the chosen areas with the TINs of every strip in each of them: the result
 * of the second pass over all points.
 *
 * Points of different strips may be added from several threads, then distribute() (with several
 * processes) and prepare() are called once. Memory: about 200 bytes per point in an area.
 */
class AreaSample {
 public:
  /// \param block must exist as long as this object.
  explicit AreaSample(const SurveyBlock& block);
  ~AreaSample();
  AreaSample(const AreaSample&) = delete;
  AreaSample& operator=(const AreaSample&) = delete;

  /// Points of a strip, ground frame; those outside the areas are ignored.
  /// \a range_std: by point, as of AreaMatcher::add(), NaN: none; null: none of any point.
  void add(int strip, const LidarReturn* points, std::size_t count,
           const double* range_std = nullptr);
  /// Collective: gives each process the points of its share of the areas. \a strips: which process
  /// added which strips.
  void distribute(Communicator* processes, const SharedItems& strips);
  std::size_t pointCount() const;  ///< of all processes
  /// Points with a standard deviation of their range that were added in this process.
  std::size_t pointsWithRangeStd() const { return with_range_std_; }

  /// Builds the TINs and chooses the points for which patches are searched. Returns warnings on
  /// rounded coordinates.
  Warnings prepare();
  /// Points for which patches are searched.
  struct Candidates {
    std::size_t per_strip = 0;  ///< in an area
    std::size_t pairs = 0;      ///< that all of them may form
  };
  Candidates candidates() const;  ///< collective

  /// Lets the points be those corrected for these values.
  void correct(const Corrections& corrections);
  /// From now on pairs have the effects of all error sources.
  void considerSources(const ErrorSourceScale& scale);

  const SurveyBlock& block() const { return block_; }
  const AreaMatcher& area(std::size_t index) const;
  AreaMatcher& area(std::size_t index);
  /// Does the work for the areas of this process, in parallel.
  void forAreas(const std::function<void(std::size_t area)>& work) const;
  /// Collective: for each area the vector to which \a work(area, vector) appends, in all processes.
  template <typename T, typename Work>
  std::vector<std::vector<T>> collect(const Work& work) const {
    std::vector<std::vector<T>> found(block_.areas.size());
    forAreas([&](std::size_t area) { work(area, found[area]); });
    share(found);
    return found;
  }
  /// Collective: gives all processes the vectors of all areas.
  template <typename T>
  void share(std::vector<std::vector<T>>& of_areas) const {
    shareVectors(processes_, shares_, of_areas);
  }

 private:
  Warnings distributeRounded();

  const SurveyBlock& block_;
  AreaIndex index_;
  std::vector<AreaMatcher> matchers_;
  Corrections corrected_;  ///< of the points
  Communicator* processes_ = nullptr;
  SharedItems shares_;             ///< which processes form the pairs of an area
  std::size_t loaded_points_ = 0;  ///< of all processes
  std::atomic<std::size_t> with_range_std_{0};
};

/// Times at which each strip was measured in the areas, a span for every crossing. Collective.
std::vector<std::vector<TimeSpan>> measuredTimes(const AreaSample& sample);

/// A strip as measured.
struct StripTrajectory {
  std::string id;
  TimeSpan span;  ///< first and last firing time, seconds
  std::size_t points = 0;
  /// Of its pairs: median height of the sensor above the patches, metres, zero without pairs;
  /// largest angle of a patch from the vertical, radians.
  double height = 0.0, half_angle = 0.0;
};

/// The last adjustment of a calibration, for further adjustments of the same block.
struct AdjustedSurvey {
  std::vector<StripTrajectory> strips;  ///< by the index that observations use
  WeightedObservations sample;          ///< about kRepresentative observations that represent all
  VarianceFactors levels;               ///< as estimated
};

struct BlockCalibration {
  /// result.verdict states whether to apply it, with the reason. result.observability is left
  /// empty: see describeObservability().
  CalibrationResult result;
  /// Share of each area in the information about the parameters, sum 1.
  std::vector<double> information;
  AdjustedSurvey adjusted;
};

/** \brief Geometric calibration of a LiDAR system from the points of a block (Habib et al. 2011,
 * section 2).
 *
 * Estimates biases (assumed - true) of the system parameters from point-to-patch pairs in
 * overlapping strips (Eq. (11), both directions) and vertical control (Eq. (12)) by modified least
 * squares. In every iteration the points are reconstructed with Eq. (13) and pairs are formed anew,
 * until convergence.
 *
 * The points are read twice, in any order, so that memory depends on the chosen areas and not on
 * the size of the survey:
 * \code
 * BlockIndex index(trajectory, south_west_corner);
 * const int strip = index.addStrip("1");   // for every strip
 * index.add(strip, points, count);         // first pass, all points
 * const SurveyBlock block = chooseAreas(std::move(index), request);
 * AreaSample sample(block);
 * sample.add(strip, points, count);        // second pass, all points again
 * const BlockCalibration calibration = calibrate(sample);
 * \endcode
 * The scan angle is that in the plane of the pulse (ScanPlanes). Memory: 288 bytes per pair,
 * besides the index and the sample. For point files there is calibrateSurvey().
 *
 * \param sample is prepared and corrected. Collective where it is distributed
 * \param progress called after every iteration
 */
BlockCalibration calibrate(AreaSample& sample,
                           const std::function<void(const CalibrationIteration&)>& progress = {});

/// Collective: gives all processes the indices of all strips, which each has of its own ones.
void shareIndex(Communicator* processes, const SharedItems& strips, BlockIndex& index);

}  // namespace pcl_als
