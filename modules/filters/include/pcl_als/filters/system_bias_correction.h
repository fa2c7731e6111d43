// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl/filters/filter.h>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/trajectory/bias_evaluator.h>

namespace pcl_als {

/** \brief Removes known system biases from a strip: corrected = biased - A(biased) delta.
 *
 * Habib, Kersting, Shaker, Yan 2011, Eq. (13), with A of Eq. (8) from the local flight line at each
 * point's time; with setInvert(true) the exact inverse, which puts the biases in.
 *
 * Points are relative to the LocalFrame, the trajectory is in the ground frame (east, north, up,
 * metres). Biases are assumed - true (m, rad, 1). Any point type with x, y, z (float) and gps_time
 * (double) will do; for one's own, include impl/system_bias_correction.hpp.
 *
 * Every other field keeps its bits, the input is not changed. A point that is not finite is passed
 * on as it is; with indices set, points outside them, too. A point without a trajectory is an
 * InputError with counts and times unless setKeepUncovered(true), which leaves it as it is;
 * getCoverage() tells afterwards.
 * \code
 * pcl_als::SystemBiasCorrection<pcl_als::PointLidar> correction;
 * correction.setTrajectory(trajectory);  // std::shared_ptr<const pcl_als::Trajectory>
 * correction.setCalibration(pcl_als::readCalibration("calibration.json"));
 * correction.setLocalFrame(strip.frame);
 * correction.setInputCloud(strip.cloud);
 * correction.filter(corrected);
 * \endcode
 */
template <typename PointT>
class SystemBiasCorrection : public pcl::Filter<PointT> {
 public:
  using Ptr = std::shared_ptr<SystemBiasCorrection<PointT>>;
  using ConstPtr = std::shared_ptr<const SystemBiasCorrection<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;

  SystemBiasCorrection() { this->filter_name_ = "SystemBiasCorrection"; }

  /// The flight; must have been made with the window of the calibration
  /// (CalibrationResult::line_fit_half_width).
  void setTrajectory(std::shared_ptr<const Trajectory> trajectory) {
    trajectory_ = std::move(trajectory);
  }
  std::shared_ptr<const Trajectory> getTrajectory() const { return trajectory_; }

  /// What the cloud's coordinates are relative to; default: the ground frame's origin.
  void setLocalFrame(const LocalFrame& frame) { frame_ = frame; }
  const LocalFrame& getLocalFrame() const { return frame_; }

  /// Biases, assumed - true: m, rad, 1. UsageError (in filter()) for values no scanner has.
  void setBiases(const SystemVector& biases) { biases_ = biases; }
  const SystemVector& getBiases() const { return biases_; }
  /// The biases of a calibration; its strip corrections only by setTrajectoryErrors(). UsageError
  /// unless its verdict is usable; setBiases(result.biases()) takes any.
  void setCalibration(const CalibrationResult& result) {
    if (!result.verdict.usable()) {
      throw UsageError("this calibration should not be applied, " + result.verdict.text());
    }
    setBiases(result.biases());
  }

  /// Strip corrections: what the calibration found wrong with the trajectory, taken out together
  /// with the biases; default none.
  void setTrajectoryErrors(std::shared_ptr<const TrajectoryErrors> errors) {
    trajectory_errors_ = std::move(errors);
  }
  std::shared_ptr<const TrajectoryErrors> getTrajectoryErrors() const { return trajectory_errors_; }

  /// Puts the biases in instead of taking them out; default false.
  void setInvert(bool invert) { invert_ = invert; }
  bool getInvert() const { return invert_; }

  /// How point times become the trajectory's; default: they are the same.
  void setTimeAlignment(const TimeAlignment& alignment) { alignment_ = alignment; }
  const TimeAlignment& getTimeAlignment() const { return alignment_; }
  /// An alignment that is a constant: seconds to add to point times.
  void setTimeOffset(double seconds) {
    alignment_ = TimeAlignment();
    alignment_.offset = seconds;
  }
  double getTimeOffset() const { return alignment_.offset; }

  /// Leaves points without a trajectory as they are instead of refusing the cloud; default false.
  void setKeepUncovered(bool keep) { keep_uncovered_ = keep; }
  bool getKeepUncovered() const { return keep_uncovered_; }

  /// 0: all cores. The result does not depend on it; default 1.
  void setNumberOfThreads(int threads) { threads_ = threads; }
  int getNumberOfThreads() const { return threads_; }

  /// Of the last filter(): how many points were looked at, and what became of those not served.
  const CoverageCount& getCoverage() const { return coverage_; }

 protected:
  void applyFilter(PointCloud& output) override;

 private:
  CoverageCount correctChunk(const BiasEvaluator& evaluator, std::size_t first, std::size_t last,
                             PointCloud& output) const;

  std::shared_ptr<const Trajectory> trajectory_;
  std::shared_ptr<const TrajectoryErrors> trajectory_errors_;
  LocalFrame frame_;
  SystemVector biases_ = SystemVector::Zero();
  TimeAlignment alignment_;
  bool invert_ = false, keep_uncovered_ = false;
  int threads_ = 1;
  CoverageCount coverage_;
};

extern template class SystemBiasCorrection<PointLidar>;

}  // namespace pcl_als
