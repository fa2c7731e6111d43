// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include <pcl_als/calibration/survey_calibration.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/common/strip.h>
#include <pcl_als/survey/cloud_job.h>

namespace pcl_als {

/** \brief Calibrates a LiDAR system from strips that are clouds in memory (Habib et al. 2011).
 *
 * The same computation as calibrateSurvey() and pcl_als_calibrate: point-to-patch pairs of
 * overlapping strips (Eq. (11)) and vertical control (Eq. (12)), iterated until convergence. Points
 * in the same order give the same result, from PCD files to the last bit.
 *
 * A trajectory is needed, as delivered. With Trajectory::Options::use_attitude the model is the
 * rigorous one of Eq. (1), otherwise the quasi-rigorous one (README of module calibration).
 *
 * Each cloud is relative to its own LocalFrame; trajectory and control are in the ground frame
 * (east, north, up; metres). The coordinates of a cloud are floats: within 1 km of the frame's
 * origin they have steps of at most 0.06 mm, within 4 km (LocalFrame::kMaximumExtent) of 0.25 mm.
 * No pair changes by more, but the choice of candidates changes: estimates from LAS files and from
 * clouds loaded from them differ by up to a few tenths of a standard deviation (0.3 in a small
 * block). InputError if the steps exceed 2 mm.
 *
 * The point type needs x, y, z (float) and gps_time (double). return_number and number_of_returns,
 * classification, and flags (bits of PointFlag) are used where the type has them; without them
 * every return is assumed to be single, unclassified and valid, and vegetation is excluded by the
 * criterion of surfaces alone. For other types than PointLidar include impl/system_calibration.hpp.
 *
 * UsageError for wrong arguments, InputError for unusable data, Cancelled. If the calibration does
 * not converge, the verdict is not usable. Memory: that of calibrateSurvey(); the clouds
 * are not copied.
 * \code
 * pcl_als::SystemCalibration<pcl_als::PointLidar> calibration;
 * for (const auto& strip : pcl_als::loadStrips({"strip1.las", "strip2.las"}))
 *   calibration.addInputStrip(strip.cloud, strip.frame, strip.id);
 * calibration.setTrajectory(trajectory);  // std::shared_ptr<const pcl_als::Trajectory>
 * pcl_als::CalibrationOptions options;
 * options.control = pcl_als::readControl("control.csv");
 * calibration.setOptions(options);
 * calibration.calibrate();
 * if (calibration.getResult().verdict.usable())
 *   pcl_als::writeCalibration("calibration.json", calibration.getResult());
 * \endcode
 */
template <typename PointT>
class SystemCalibration : public CloudJob<PointT> {
 public:
  using Ptr = std::shared_ptr<SystemCalibration<PointT>>;
  using ConstPtr = std::shared_ptr<const SystemCalibration<PointT>>;

  SystemCalibration() : CloudJob<PointT>("SystemCalibration") {}

  /// Settings, control, pairs of strips and all other options of calibrateSurvey(). The strips and
  /// the step of their coordinates are those of the clouds.
  void setOptions(CalibrationOptions options) { options_ = std::move(options); }
  const CalibrationOptions& getOptions() const { return options_; }

  /// Estimates the parameters. If an exception is thrown, there is no result.
  void calibrate();
  /// Result of the last calibrate(); getResult().verdict states whether it may be applied.
  /// UsageError if there is no result.
  const CalibrationResult& getResult() const;
  /// Whether there is a result whose iteration has converged.
  bool hasConverged() const { return calibration_ && calibration_->result.converged; }
  /// The result with the areas that were used and the attitude that was recovered.
  const SurveyCalibration& getSurveyCalibration() const;

 private:
  CalibrationOptions options_;
  std::optional<SurveyCalibration> calibration_;
};

extern template class SystemCalibration<PointLidar>;

}  // namespace pcl_als
