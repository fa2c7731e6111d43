// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/calibration/calibration_settings.h>
#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/point_file_info.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/io/trajectory_io.h>
#include <pcl_als/survey/survey_reader.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// A reference surface for calibrateSurvey(), from a file.
struct ReferenceSource {
  using Sink = std::function<void(const LidarReturn* points, std::size_t count)>;

  ReferenceSurface surface;
  PointFileInfo info;  ///< path, CRS and units, which must be those of the survey
  /// Passes on all points inside a box in plan (metres, ground frame), part by part.
  std::function<void(const Eigen::AlignedBox2d& box, const Sink& sink)> read;
};

/** \brief What calibrateSurvey() and SystemCalibration estimate, and from what. The defaults use
 * all strips, and estimate what these determine.
 */
struct CalibrationOptions {
  CalibrationSettings settings;
  std::string system_name;  ///< of the instrument; empty: as the point files state it
  StripChoice strips;       ///< strips that are used; default all
  std::vector<std::pair<std::string, std::string>> pairs;  ///< of strips; empty: all that overlap
  std::vector<ControlPoint> control;
  std::vector<ReferenceSource> references;  ///< surfaces that strips are compared with
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  SurveyObserver observer;      ///< called during the first reading
  /// Standard deviations of the trajectory over time: their root mean squares over the times of the
  /// strips replace those of settings.shared_errors, except those that are kept. InputError where
  /// they cover none of the strips.
  std::vector<TrajectoryAccuracy> accuracy;
  /// The trajectory is one of reconstructTrajectory(): its heights add to the standard deviations.
  bool reconstructed = false;
  /// Of a reconstructed trajectory: standard deviations of its own, which are not those of the
  /// errors that the points have.
  std::vector<TrajectoryAccuracy> path_accuracy;
  bool keep_position = false, keep_roll_pitch = false, keep_heading = false;
  /// Points of files with the extra bytes range_std (metres, of echoes of decomposed waveforms)
  /// have this standard deviation of their ranges in addition to settings.noise.range.
  bool use_range_std = true;
};

struct SurveyCalibration {
  CalibrationResult result;  ///< result.verdict states whether it may be applied
  std::vector<SurveyArea> areas;
  /// by area: share of the information about the parameters, sum 1
  std::vector<double> information;
  std::shared_ptr<const Trajectory> flight;  ///< with the attitude that was used
};

/** \brief Calibrates the LiDAR system of a survey from its point files (Habib et al. 2011).
 *
 * Reads the files twice; memory depends on the areas chosen and not on the survey.
 *
 * \param flight as delivered; the model is the rigorous one where it has attitude
 *
 * UsageError for unknown strips or impossible settings, InputError for unusable input, Cancelled. A
 * calibration that does not converge or gives no improvement returns a result with a verdict.
 */
SurveyCalibration calibrateSurvey(SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& flight,
                                  const CalibrationOptions& options = {},
                                  const ProgressCallback& progress = {});

}  // namespace pcl_als
