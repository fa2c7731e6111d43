// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/progress.h>
#include <pcl_als/common/raster.h>
#include <pcl_als/io/trajectory_io.h>
#include <pcl_als/trajectory/coverage_count.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/// Options of correctPointFile().
struct FileCorrectionOptions {
  bool strip_corrections = false;  ///< also correct the estimated errors of the trajectory
  bool invert = false;             ///< apply the biases instead of removing them
  /// Keep points without trajectory unchanged. False: InputError if they are more than 1 %.
  bool keep_uncovered = false;
  /// Refuse a trajectory that cannot belong to the points.
  bool check_trajectory = true;
  /// Continue with warnings if this check fails, if the verdict of the calibration is not "usable",
  /// if it has no strip corrections for a strip of the file, or if the file has already been
  /// corrected with the same biases. A scanner that is not linear and has no attitude is then
  /// assumed to be level.
  bool force = false;
  bool record = true;           ///< record the correction in the output (AppliedCorrection)
  std::string calibration_id;   ///< calibrationId(); empty: computed
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  int threads = 0;              ///< 0: all cores; the result does not depend on it

  /// Add the standard deviations of every point (PointUncertainty) to a .las or .laz file, as the
  /// extra bytes sigma_horizontal and sigma_vertical (float, metres; NaN: not known). The extra
  /// bytes range_std of decomposed waveforms, if the file has them, replace the standard deviation
  /// of ranges of the calibration where they exceed it.
  bool uncertainty = false;
  /// Standard deviations of the trajectory at times without strip corrections
  /// (CalibrationCovariance); may be empty.
  std::vector<TrajectoryAccuracy> trajectory_accuracy;
  /// With \a uncertainty: side of the cells of FileCorrectionResult::deviation_raster, metres; 0:
  /// no raster.
  double deviation_cell = 0.0;
};

/// Summary of the standard deviations of the points of a file.
struct DeviationSummary {
  std::uint64_t points = 0;                 ///< points with standard deviations
  std::uint64_t on_surface = 0;             ///< points among them whose slope is known
  std::uint64_t unknown = 0;                ///< points without trajectory, which have none
  double horizontal = 0.0, vertical = 0.0;  ///< root mean squares, metres

  std::string describe() const;  ///< a sentence for the user; empty without points
};

/// Result of correctPointFile(). Remarks are single lines and may be empty.
struct FileCorrectionResult {
  std::uint64_t points = 0;
  CoverageCount coverage;  ///< points that were not corrected, by reason
  /// How point times were reconciled with those of the trajectory.
  std::string time_remark;
  /// A remark if the calibration is of another flight (SystemCorrection::flightRemark()).
  std::string flight_remark;
  Warnings warnings;  ///< from the check of the trajectory
  /// Result of the recovery of attitude from this file, if the calibration has none for its times.
  std::string attitude_remark;
  DeviationSummary deviations;  ///< with FileCorrectionOptions::uncertainty
  /// Root mean squares of the standard deviations in cells (bands sigma_horizontal, sigma_vertical,
  /// metres), without CRS.
  std::optional<Raster> deviation_raster;
  /// Faults of the input, and other files that were copied (LasRewriteResult).
  std::vector<std::string> copy_remarks;
  /// All remarks for the user, including those above.
  std::vector<std::string> remarks;
};

/// "boresight_roll -90 arcsec, range_bias 0.12 m": the biases that are not zero, of all systems.
std::string describeBiases(const CalibrationResult& calibration);

/** \brief Applies a calibration to a point file.
 *
 * The raw integers of .las and .laz files are corrected in constant memory, and every other byte is
 * kept; .pcd files are corrected by SystemBiasCorrection. The output appears only when it is
 * complete.
 *
 * If the calibration recovered the attitude from the points, the attitude that it contains is used,
 * so that a strip and its tiles are corrected alike. For times without it (another flight, a
 * calibration of an earlier version) pitch and crab are recovered from the points of this file.
 * Only the instrument part is applied to another flight than the calibration flight
 * (isOfAnotherFlight()).
 *
 * With standard deviations, local surfaces are determined from the points within a radius that
 * contains 16 of them on average (LocalSurfaces), window by window; memory is that of some windows
 * of 131,072 points.
 *
 * \param flight the trajectory as delivered (loadTrajectory() with trajectoryLoadingOptions())
 *
 * UsageError if input and output are of different kinds or the same file, for a calibration that
 * should not be applied, and for standard deviations of a .pcd file or of inverted corrections.
 * InputError for files that cannot be used, and with strip corrections if more than a hundredth of
 * the points belong to strips without them. Cancelled.
 * \code
 * const auto calibration = pcl_als::readCalibration("calibration.json");
 * const auto loading = pcl_als::trajectoryLoadingOptions(calibration);
 * const auto flight = pcl_als::loadTrajectory("trajectory.csv", loading).trajectory;
 * pcl_als::correctPointFile("strip1.laz", "corrected1.laz", calibration, flight);
 * \endcode
 */
FileCorrectionResult correctPointFile(const std::filesystem::path& input,
                                      const std::filesystem::path& output,
                                      const CalibrationResult& calibration,
                                      std::shared_ptr<const Trajectory> flight,
                                      const FileCorrectionOptions& options = {},
                                      const ProgressCallback& progress = {});

}  // namespace pcl_als
