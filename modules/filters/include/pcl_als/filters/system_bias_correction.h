// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl/filters/filter.h>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/trajectory/system_correction.h>

namespace pcl_als {

template <typename PointT>
class PointChannels;

/** \brief Removes known system biases from a strip: corrected = biased - A(biased) delta.
 *
 * Habib, Kersting, Shaker, Yan 2011, Eq. (13), with A of Eq. (8) from the local flight line at the
 * time of each point; with setInvert(true) the exact inverse, which applies the biases.
 *
 * Points are relative to the LocalFrame, the trajectory is in the ground frame (east, north, up,
 * metres). A calibration includes its model and attitude (SystemCorrection). Biases alone (assumed
 * - true; m, rad, 1) are used with the attitude of the trajectory. The point type needs x, y, z
 * (float) and gps_time (double); for other types than PointLidar include
 * impl/system_bias_correction.hpp. For a calibration with several systems or fixed strips, it also
 * needs point_source_id (or setStripId()). If that calibration divides strips by the channel of the
 * scanner, it needs the field with the channel (CalibrationResult::channel_field): flags (bits 6
 * and 7), user_data, another registered field, or setChannels().
 *
 * All other fields are kept bit for bit; the input is not changed. Points that are not finite, and
 * points outside given indices, stay unchanged. Points that the trajectory does not cover are an
 * InputError with counts and times, unless setKeepUncovered(true) keeps them unchanged;
 * getCoverage() counts them. A cloud most of whose points cannot have been measured from the
 * trajectory is an InputError unless setCheckTrajectory(false).
 * \code
 * const pcl_als::SystemCorrection biases(pcl_als::readCalibration("calibration.json"),
 *                                        pcl_als::readTrajectory("trajectory.csv"));
 * pcl_als::SystemBiasCorrection<pcl_als::PointLidar> correction;
 * correction.setCorrection(biases);  // or a trajectory and a calibration
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

  /// The trajectory as delivered, with attitude if the calibration was estimated with it.
  void setTrajectory(std::shared_ptr<const Trajectory> trajectory) {
    trajectory_ = std::move(trajectory);
  }
  std::shared_ptr<const Trajectory> getTrajectory() const { return trajectory_; }

  /// Frame of the cloud's coordinates, Strip::frame; default: the origin of the ground frame. If
  /// the frame is not set, the points usually lie far from the trajectory, which is an InputError.
  void setLocalFrame(const LocalFrame& frame) { frame_ = frame; }
  const LocalFrame& getLocalFrame() const { return frame_; }

  /// Biases (assumed - true; m, rad, 1) instead of a calibration. UsageError (in filter()) for
  /// implausible values.
  void setBiases(const SystemVector& biases) {
    biases_ = biases;
    calibration_.reset();
  }
  const SystemVector& getBiases() const { return biases_; }
  /// A calibration with its model and attitude. UsageError unless its verdict is usable; InputError
  /// (in filter()) if data that the correction needs are missing.
  void setCalibration(const CalibrationResult& result) {
    SystemCorrection::requireUsable(result);
    biases_ = result.biases();
    calibration_ = result;
  }

  /// Id of the strip of points without a point source id, for a calibration with several systems or
  /// fixed strips; default none.
  void setStripId(const std::string& id) { strip_id_ = id; }
  const std::string& getStripId() const { return strip_id_; }

  /// Scanner channel of each point of the input cloud, in place of a field of the point type;
  /// default (empty): the field. UsageError (in filter()) unless there is one channel per point.
  void setChannels(std::vector<std::uint8_t> channels) { channels_ = std::move(channels); }
  const std::vector<std::uint8_t>& getChannels() const { return channels_; }

  /// A correction that is used instead of the trajectory, calibration, attitude, inversion and time
  /// alignment of the other functions.
  void setCorrection(const SystemCorrection& correction) { correction_ = correction; }

  /// Also removes the trajectory errors that the calibration estimated; default false.
  void setStripCorrections(bool use) { strip_corrections_ = use; }
  bool getStripCorrections() const { return strip_corrections_; }

  /// Pitch and crab for times at which the calibration has none (AttitudeRecovery); default none.
  void setFallbackAttitude(const RecoveredAttitude& attitude) { fallback_attitude_ = attitude; }
  const RecoveredAttitude& getFallbackAttitude() const { return fallback_attitude_; }

  /// Applies the biases instead of removing them; default false.
  void setInvert(bool invert) { invert_ = invert; }
  bool getInvert() const { return invert_; }

  /// Conversion of point times to those of the trajectory; default: they are the same.
  void setTimeAlignment(const TimeAlignment& alignment) { alignment_ = alignment; }
  const TimeAlignment& getTimeAlignment() const { return alignment_; }
  /// A constant alignment: seconds to add to point times.
  void setTimeOffset(double seconds) {
    alignment_ = TimeAlignment();
    alignment_.offset = seconds;
  }
  double getTimeOffset() const { return alignment_.offset; }

  /// Keeps points without a trajectory unchanged instead of refusing the cloud; default false.
  void setKeepUncovered(bool keep) { keep_uncovered_ = keep; }
  bool getKeepUncovered() const { return keep_uncovered_; }

  /// Refuses a cloud most of whose points lie above the trajectory or beyond any possible scan
  /// angle (TrajectoryPlausibility), because its frame was not set or the trajectory is of another
  /// flight. Default true.
  void setCheckTrajectory(bool check) { check_trajectory_ = check; }
  bool getCheckTrajectory() const { return check_trajectory_; }

  /// 0: all cores; the result does not depend on it. Default 0.
  void setNumberOfThreads(int threads) { threads_ = requiredThreads(threads); }
  int getNumberOfThreads() const { return threads_; }

  /// Numbers of points that the last filter() corrected or did not correct, by reason.
  const CoverageCount& getCoverage() const { return coverage_; }

 protected:
  void applyFilter(PointCloud& output) override;

 private:
  SystemCorrection usedCorrection() const;
  CoverageCount correctChunk(const SystemCorrection& correction,
                             const PointChannels<PointT>& channels, std::size_t first,
                             std::size_t last, PointCloud& output) const;

  std::shared_ptr<const Trajectory> trajectory_;
  std::optional<CalibrationResult> calibration_;
  std::optional<SystemCorrection> correction_;
  RecoveredAttitude fallback_attitude_;
  LocalFrame frame_;
  SystemVector biases_ = SystemVector::Zero();
  TimeAlignment alignment_;
  bool invert_ = false, strip_corrections_ = false, keep_uncovered_ = false;
  bool check_trajectory_ = true;
  std::string strip_id_;
  std::vector<std::uint8_t> channels_;
  int threads_ = 0;
  CoverageCount coverage_;
};

extern template class SystemBiasCorrection<PointLidar>;

}  // namespace pcl_als
