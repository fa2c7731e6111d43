// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/point_types.h>
#include <pcl_als/common/strip.h>
#include <pcl_als/processing/check_delivery.h>
#include <pcl_als/survey/cloud_job.h>

namespace pcl_als {

/** \brief Measures the agreement of strips that are clouds in memory with each other and with
 * control.
 *
 * The same computation as checkDelivery() and pcl_als_check; points in the same order give the same
 * result, from PCD files to the last bit. Each cloud is relative to its own LocalFrame; the effect
 * of the rounding of floats is described with SystemCalibration.
 *
 * The point type needs x, y and z (float). gps_time, return_number and number_of_returns,
 * classification, flags (bits of PointFlag) and scan_angle are used where the type has them. A
 * trajectory is optional; it gives finer scan angles than those of the points. Without either,
 * trends with the scan angle are not computed. For other types than PointLidar include
 * impl/delivery_check.hpp.
 *
 * UsageError for wrong arguments, InputError for data that cannot be used, Cancelled.
 * \code
 * pcl_als::DeliveryCheck<pcl_als::PointLidar> check;
 * for (const auto& strip : strips) check.addInputStrip(strip.cloud, strip.frame, strip.id);
 * check.setControl(pcl_als::readControl("control.csv"));
 * check.check();
 * for (const pcl_als::CheckedPair& pair : check.getResult().pairs)
 *   std::cout << pair.a << ':' << pair.b << ' ' << pair.assessment.vertical.rms << " m\n";
 * \endcode
 */
template <typename PointT>
class DeliveryCheck : public CloudJob<PointT> {
 public:
  using Ptr = std::shared_ptr<DeliveryCheck<PointT>>;
  using ConstPtr = std::shared_ptr<const DeliveryCheck<PointT>>;

  DeliveryCheck() : CloudJob<PointT>("DeliveryCheck") {}

  /// Control points, which are used vertically (CheckSettings::control); default: none.
  void setControl(std::vector<ControlPoint> control) {
    options_.settings.control = std::move(control);
  }
  const std::vector<ControlPoint>& getControl() const { return options_.settings.control; }

  /// All settings, including the control points.
  void setSettings(const CheckSettings& settings) { options_.settings = settings; }
  const CheckSettings& getSettings() const { return options_.settings; }

  /// Areas of comparison, such as those of an earlier check of the same block; empty (default):
  /// they are chosen.
  void setAreas(std::vector<SurveyArea> areas) { options_.areas = std::move(areas); }
  /// Areas of the last check(); UsageError if there is no result.
  const std::vector<SurveyArea>& getAreas() const { return requireCheck().areas; }

  /// Computes the result. If an exception is thrown, there is no result.
  void check();
  /// Result of the last check(); UsageError if there is none.
  const CheckedBlock& getResult() const { return requireCheck().block; }

 private:
  const DeliveryCheckResult& requireCheck() const;

  DeliveryCheckOptions options_;
  std::optional<DeliveryCheckResult> check_;
};

extern template class DeliveryCheck<PointLidar>;

}  // namespace pcl_als
