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

struct FileCorrectionOptions {
  bool strip_corrections = false;  ///< correct the estimated errors of the trajectory as well
  bool invert = false;             ///< apply the biases instead of removing them
  bool keep_uncovered = false;  ///< points without trajectory stay unchanged; otherwise at most 1 %
  /// Refuse a trajectory that cannot belong to the points.
  bool check_trajectory = true;
  /// Continue with warnings where this check fails, the verdict of the calibration is not "usable",
  /// it has no strip corrections for a strip of the file, or the file was corrected with the same
  /// biases before; and with a level sensor where the scanner is not linear and has no attitude.
  bool force = false;
  bool record = true;           ///< record the correction in the output (AppliedCorrection)
  std::string calibration_id;   ///< calibrationId(); empty: computed
  std::optional<int> gps_week;  ///< of times that are seconds of the week; default: from the data
  int threads = 0;              ///< 0: all cores; the result does not depend on it

  /// Add the standard deviations of every point (PointUncertainty) to a .las or .laz file, as the
  /// extra bytes sigma_horizontal and sigma_vertical (float, metres; NaN: not known). The extra
  /// bytes range_std of decomposed waveforms, if the file has them, are the standard deviations of
  /// ranges that exceed the level of the calibration.
  bool uncertainty = false;
  /// Standard deviations of the trajectory at times without strip corrections
  /// (CalibrationCovariance); may be empty.
  std::vector<TrajectoryAccuracy> trajectory_accuracy;
  /// With standard deviations: side of the cells of FileCorrectionResult::deviation_raster, metres;
  /// 0: none.
  double deviation_cell = 0.0;
};

/// Number, mean squares and share with a known surface of points with standard deviations.
struct DeviationSummary {
  std::uint64_t points = 0;
  std::uint64_t on_surface = 0;  ///< points whose slope is known
  std::uint64_t unknown = 0;     ///< further points, without trajectory: no standard deviations
  double horizontal = 0.0, vertical = 0.0;  ///< root mean squares, metres

  std::string describe() const;  ///< a sentence for the user; empty without points
};

struct FileCorrectionResult {
  std::uint64_t points = 0;
  CoverageCount coverage;
  /// how point times were reconciled with those of the flight; may be empty
  std::string time_remark;
  /// That the calibration is of another flight (SystemCorrection::flightRemark()); may be empty.
  std::string flight_remark;
  Warnings warnings;  ///< from the check of the trajectory
  /// Result of the recovery of attitude from this file, where the calibration has none for its
  /// times; otherwise empty.
  std::string attitude_remark;
  DeviationSummary deviations;             ///< with FileCorrectionOptions::uncertainty
  std::optional<Raster> deviation_raster;  ///< DeviationCells, without CRS
  /// What of the input was wrong, and what was copied besides (LasRewriteResult).
  std::vector<std::string> copy_remarks;
  /// All that a user should know, with the above.
  std::vector<std::string> remarks;
};

/// "boresight_roll -90 arcsec, range_bias 0.12 m": the biases that are not zero, of all systems.
std::string describeBiases(const CalibrationResult& calibration);

/** \brief Applies a calibration to a point file: .las and .laz in constant memory on the raw
 * integers, with every other byte kept, .pcd through SystemBiasCorrection.
 *
 * Where the calibration recovered the attitude from the points, the attitude it contains is used,
 * so that a strip and its tiles are corrected alike. For times without it (another flight, a
 * calibration of an earlier version) pitch and crab are recovered from the points of this file.
 * To another flight than that of the calibration (isOfAnotherFlight()) its instrument part is
 * applied.
 *
 * \param flight as delivered (trajectoryLoadingOptions())
 *
 * With standard deviations, local surfaces are found from the points within a radius that holds 16
 * of them (LocalSurfaces), window by window; memory is that of some windows of 131,072 points.
 *
 * With strip corrections, InputError for a file of which more than a hundredth of the points belong
 * to strips that have none.
 *
 * UsageError for input and output of different kinds or the same file, and for a calibration that
 * should not be applied, for standard deviations of a .pcd file or of inverted corrections;
 * InputError for files that cannot be used; Cancelled. The output appears
 * only when it is complete.
 */
FileCorrectionResult correctPointFile(const std::filesystem::path& input,
                                      const std::filesystem::path& output,
                                      const CalibrationResult& calibration,
                                      std::shared_ptr<const Trajectory> flight,
                                      const FileCorrectionOptions& options = {},
                                      const ProgressCallback& progress = {});

}  // namespace pcl_als
