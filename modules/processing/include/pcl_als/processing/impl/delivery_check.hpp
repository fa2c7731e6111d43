// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/delivery_check.h>

namespace pcl_als {

template <typename PointT>
void DeliveryCheck<PointT>::check() {
  check_.reset();
  this->requireStrips();
  SurveyReader survey = this->survey(options_.settings.threads);
  check_ = checkDelivery(survey, this->trajectory_, options_, this->progress_);
}

template <typename PointT>
const DeliveryCheckResult& DeliveryCheck<PointT>::requireCheck() const {
  if (!check_) throw UsageError(this->name_ + ": check() has given no result yet");
  return *check_;
}

}  // namespace pcl_als
