// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/radiometric_model.h>

#include "range_kernel.h"

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
  double value = 1.0, logarithm = 2.0 * extinction_per_km * (range - reference_range) / 1000.0;
  // The plain radar equation is by far the most frequent: it needs no logarithms.
  if (range_exponent == 2.0)
    value = ratio * ratio;
  else if (range_exponent != 0.0)
    logarithm += range_exponent * std::log(ratio);
  if (!std::isnan(cosine)) {
    if (incidence_exponent == 1.0)
      value /= cosine;
    else if (incidence_exponent != 0.0)
      logarithm -= incidence_exponent * std::log(cosine);
  }
  return logarithm == 0.0 ? value : value * std::exp(logarithm);
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

PointRadiometry RadiometricEvaluator::evaluate(const LidarReturn& point,
                                               const LocalSurface& surface,
                                               RadiometryCursor& cursor) const {
  PointRadiometry result;
  if (!point.position.allFinite()) return result;
  result.status = RadiometryStatus::uncovered;
  if (!cursor.span.holds(point.time) && !trajectory_->pathAt(point.time, cursor.span, cursor.node))
    return result;
  const Eigen::Vector3d beam = point.position - cursor.span.at(point.time);
  result.status = RadiometryStatus::above_sensor;
  if (!(beam.z() < 0.0)) return result;
  const double range = beam.norm();
  result.range = static_cast<float>(range);
  const double per_range = 1.0 / range;
  result.beam = (per_range * beam).cast<float>();
  double cosine = std::numeric_limits<double>::quiet_NaN();
  if (point.return_number < point.number_of_returns) {
    result.status = RadiometryStatus::partial;
  } else if (!surface.found() || !surface.normal.allFinite()) {
    result.status = RadiometryStatus::no_surface;
  } else {
    result.status = RadiometryStatus::surface;
    cosine = std::abs(surface.normal.cast<double>().dot(beam)) * per_range;
    result.incidence = static_cast<float>(std::acos(std::min(1.0, cosine)));
    if (cosine < least_cosine_) {
      result.status = RadiometryStatus::limited;
      cosine = least_cosine_;
    }
  }
  result.factor = model_.factor(range, cosine);
  return result;
}

RangeCounts RadiometricEvaluator::evaluateRanges(const PointColumns& points, std::size_t count,
                                                 const RangeColumns& out,
                                                 RadiometryCursor& cursor) const {
  RangeCounts counts;
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    const double time = points.time[first];
    ++last;
    if (!cursor.span.holds(time) && !trajectory_->pathAt(time, cursor.span, cursor.node)) {
      out.range[first] = std::numeric_limits<double>::quiet_NaN();
      out.factor[first] = 1.0;
      ++counts.uncovered;
      continue;
    }
    while (last < count && cursor.span.holds(points.time[last])) ++last;
    counts.above_sensor += detail::rangeKernel(
        cursor.span, model_,
        {points.time + first, points.x + first, points.y + first, points.z + first}, last - first,
        {out.range + first, out.factor + first});
  }
  return counts;
}

}  // namespace pcl_als
