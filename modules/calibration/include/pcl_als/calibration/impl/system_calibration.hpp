// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/calibration/system_calibration.h>
#include <pcl_als/common/errors.h>

namespace pcl_als {

template <typename PointT>
void SystemCalibration<PointT>::calibrate() {
  static_assert(HasGpsTime<PointT>::value,
                "SystemCalibration needs a point type with x, y, z and gps_time (double)");
  calibration_.reset();
  this->requireStrips();
  if (!this->trajectory_) throw UsageError(this->name_ + ": no trajectory is set");
  SurveyReader survey = this->survey(options_.settings.threads);
  calibration_ = calibrateSurvey(survey, this->trajectory_, options_, this->progress_);
}

template <typename PointT>
const SurveyCalibration& SystemCalibration<PointT>::getSurveyCalibration() const {
  if (!calibration_) throw UsageError(this->name_ + ": calibrate() has given no result yet");
  return *calibration_;
}

template <typename PointT>
const CalibrationResult& SystemCalibration<PointT>::getResult() const {
  return getSurveyCalibration().result;
}

}  // namespace pcl_als
