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

/// A reference surface for calibrateSurvey(). openReference() of module processing opens files.
struct ReferenceSource {
  using Sink = std::function<void(const LidarReturn* points, std::size_t count)>;

  ReferenceSurface surface;
  PointFileInfo info;  ///< path, CRS and units; the CRS must be that of the block
  /// Passes all points inside a box in plan (metres, ground frame) to \a sink, part by part.
  std::function<void(const Eigen::AlignedBox2d& box, const Sink& sink)> read;
};

/** \brief Options of calibrateSurvey() and SystemCalibration.
 *
 * By default all strips are used, and all parameters that they determine are estimated.
 */
struct CalibrationOptions {
  CalibrationSettings settings;
  std::string system_name;  ///< name of the instrument; empty: that in the point files
  StripChoice strips;       ///< strips that are used; default: all
  std::vector<std::pair<std::string, std::string>> pairs;  ///< of strips; empty: all that overlap
  std::vector<ControlPoint> control;
  std::vector<ReferenceSource> references;  ///< surfaces with which strips are compared
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  SurveyObserver observer;      ///< receives the points of the first of the two readings
  /// Standard deviations of the trajectory over time. Their root mean squares over the times of the
  /// strips replace the values of settings.shared_errors, except those that are kept (keep_…).
  /// InputError if they cover none of the strips.
  std::vector<TrajectoryAccuracy> accuracy;
  /// Whether the trajectory is one of reconstructTrajectory(). The uncertainty of its heights is
  /// then included in the standard deviations.
  bool reconstructed = false;
  /// Standard deviations of a reconstructed trajectory, which are not those of the trajectory from
  /// which the points were computed.
  std::vector<TrajectoryAccuracy> path_accuracy;
  bool keep_position = false, keep_roll_pitch = false, keep_heading = false;
  /// Whether the extra bytes range_std of the files (metres, of echoes of decomposed waveforms) are
  /// used as standard deviations of ranges in addition to settings.noise.range.
  bool use_range_std = true;
};

/// Result of calibrateSurvey().
struct SurveyCalibration {
  CalibrationResult result;       ///< result.verdict states whether it may be applied
  std::vector<SurveyArea> areas;  ///< the areas that were used
  /// Share of each area in the information about the parameters; the sum is 1.
  std::vector<double> information;
  std::shared_ptr<const Trajectory> flight;  ///< with the attitude that was used
};

/** \brief Calibrates the LiDAR system of a survey from its point files (Habib et al. 2011).
 *
 * Reads the files twice; memory depends on the chosen areas and not on the number of points.
 *
 * \param flight the trajectory as delivered; if it has attitude, the model is the rigorous one
 *
 * UsageError for unknown strips or impossible settings, InputError for unusable input, Cancelled.
 * If the calibration does not converge or gives no improvement, the verdict is not usable.
 * \code
 * pcl_als::SurveyReader survey({"strip1.las", "strip2.las"});
 * pcl_als::CalibrationOptions options;
 * options.control = pcl_als::readControl("control.csv");
 * const auto calibration = pcl_als::calibrateSurvey(survey, flight, options);
 * std::cout << calibration.result.briefReport() << '\n';
 * \endcode
 */
SurveyCalibration calibrateSurvey(SurveyReader& survey,
                                  const std::shared_ptr<const Trajectory>& flight,
                                  const CalibrationOptions& options = {},
                                  const ProgressCallback& progress = {});

}  // namespace pcl_als
