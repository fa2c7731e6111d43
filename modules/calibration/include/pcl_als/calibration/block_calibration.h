// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <pcl_als/calibration/area_sample.h>
#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// A strip as measured.
struct FlownStrip {
  std::string id;
  TimeSpan span;  ///< first and last firing time, seconds
  std::size_t points = 0;
  /// Of its pairs: median height of the sensor above the patches, metres, zero without pairs;
  /// largest angle of a patch from the vertical, radians.
  double height = 0.0, half_angle = 0.0;
};

/// The last adjustment of a calibration, for further adjustments of the same block (module
/// planning).
struct AdjustedSurvey {
  std::vector<FlownStrip> strips;  ///< by the index that observations use
  WeightedObservations sample;     ///< about kRepresentative observations that represent all
  SharedErrorLevels levels;        ///< as estimated
};

struct BlockCalibration {
  /// result.verdict states whether to apply it, with the reason. result.observability is left
  /// empty: see describeObservability() of module planning.
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
 * The scan angle is that in the plane of the pulse (ScanPlanes). Memory: 400 bytes per pair,
 * besides the index and the sample. For point files there is calibrateSurvey() in module
 * processing.
 *
 * \param sample is prepared and corrected. Collective where it is distributed
 * \param progress called after every iteration
 */
BlockCalibration calibrate(AreaSample& sample,
                           const std::function<void(const CalibrationIteration&)>& progress = {});

/// Collective: gives all processes the indices of all strips, which each has of its own ones.
void shareIndex(Communicator* processes, const SharedItems& strips, BlockIndex& index);

}  // namespace pcl_als
