// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {
namespace {

void require(double value, double low, double high, const char* what) {
  if (std::isfinite(value) && value >= low && value <= high) return;
  std::ostringstream text;
  text << "radiometric model: " << what << ' ' << value << " is outside [" << low << ", " << high
       << ']';
  throw UsageError(text.str());
}

}  // namespace

void RadiometricModel::check() const {
  require(range_exponent, 0.0, 6.0, "range exponent");
  require(incidence_exponent, 0.0, 4.0, "incidence exponent");
  require(extinction_per_km, 0.0, 50.0, "extinction (1/km)");
  require(reference_range, 1.0, 20000.0, "reference range (m)");
  require(largest_incidence, 1.0, 89.0, "largest incidence (degrees)");
}

double RadiometricModel::factor(double range, double cosine) const {
  const double ratio = range / reference_range;
  // The plain radar equation is by far the most frequent: pow() costs more than all the rest.
  double value = range_exponent == 2.0 ? ratio * ratio : std::pow(ratio, range_exponent);
  if (extinction_per_km != 0.0)
    value *= std::exp(2.0 * extinction_per_km * (range - reference_range) / 1000.0);
  if (std::isnan(cosine) || incidence_exponent == 0.0) return value;
  return incidence_exponent == 1.0 ? value / cosine : value / std::pow(cosine, incidence_exponent);
}

const char* nameOf(RadiometryStatus status) {
  switch (status) {
    case RadiometryStatus::surface:
      return "surface";
    case RadiometryStatus::limited:
      return "limited_incidence";
    case RadiometryStatus::no_surface:
      return "no_surface";
    case RadiometryStatus::partial:
      return "partial_return";
    case RadiometryStatus::uncovered:
      return "uncovered";
    case RadiometryStatus::above_sensor:
      return "above_sensor";
    case RadiometryStatus::not_finite:
      break;
  }
  return "not_finite";
}

RadiometricEvaluator::RadiometricEvaluator(std::shared_ptr<const Trajectory> trajectory,
                                           const RadiometricModel& model)
    : trajectory_(std::move(trajectory)),
      model_(model),
      least_cosine_(std::cos(model.largest_incidence * kRadiansPerDegree)) {
  if (!trajectory_) throw UsageError("radiometric correction: no trajectory is set");
  model.check();
}

PointRadiometry RadiometricEvaluator::evaluate(const RadiometryPoint& point,
                                               const LocalSurface& surface,
                                               std::size_t& cursor) const {
  PointRadiometry result;
  if (!point.position.allFinite()) return result;
  SensorPose pose;
  result.status = RadiometryStatus::uncovered;
  if (!trajectory_->poseAt(point.time, pose, cursor)) return result;
  const Eigen::Vector3d beam = point.position - pose.position;
  result.status = RadiometryStatus::above_sensor;
  if (!(beam.z() < 0.0)) return result;
  const double range = beam.norm();
  result.range = static_cast<float>(range);
  result.beam = (beam / range).cast<float>();
  double cosine = std::numeric_limits<double>::quiet_NaN();
  if (point.return_number < point.number_of_returns) {
    result.status = RadiometryStatus::partial;
  } else if (!surface.found() || !surface.normal.allFinite()) {
    result.status = RadiometryStatus::no_surface;
  } else {
    result.status = RadiometryStatus::surface;
    cosine = std::abs(surface.normal.cast<double>().dot(beam)) / range;
    result.incidence = static_cast<float>(std::acos(std::min(1.0, cosine)));
    if (cosine < least_cosine_) {
      result.status = RadiometryStatus::limited;
      cosine = least_cosine_;
    }
  }
  result.factor = model_.factor(range, cosine);
  return result;
}

}  // namespace pcl_als
