// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/system_correction.h>

#include "source_correction.h"

namespace pcl_als {
namespace {

using Flight = std::shared_ptr<const Trajectory>;

std::shared_ptr<const TrajectoryErrors> errorsOf(const CalibrationResult& calibration,
                                                 bool wanted) {
  if (!wanted) return nullptr;
  if (calibration.strip_errors.empty()) {
    throw InputError("the calibration has no strip corrections");
  }
  return std::make_shared<const TrajectoryErrors>(calibration.strip_errors);
}

/// The flight with the attitude that the calibration was estimated with.
Flight flightFor(AttitudeSource source, Flight flight, const RecoveredAttitude& recovered) {
  const bool delivered = flight->hasAttitude() && !flight->attitudeIsNominal();
  switch (source) {
    case AttitudeSource::trajectory:
      if (delivered) return flight;
      throw InputError(
          "the calibration was estimated with the roll, pitch and heading of the trajectory, this "
          "trajectory has none: give one that has");
    case AttitudeSource::nominal:
      if (flight->attitudeIsNominal()) return flight;
      return std::make_shared<const Trajectory>(flight->withNominalAttitude());
    case AttitudeSource::none:
    case AttitudeSource::points:
      break;
  }
  if (flight->hasAttitude()) {
    flight = std::make_shared<const Trajectory>(flight->withoutAttitude());
  }
  if (source == AttitudeSource::none) return flight;
  if (recovered.empty()) {
    throw InputError(
        "the calibration was estimated with pitch and crab recovered from the points, and does not "
        "hold them (it is of an earlier version): recover them from the points");
  }
  return std::make_shared<const Trajectory>(
      flight->withAttitude([&](double time) { return recovered.at(time); }));
}

}  // namespace

void SystemCorrection::requireUsable(const CalibrationResult& calibration) {
  if (calibration.verdict.usable()) return;
  throw UsageError("this calibration should not be applied, " + calibration.verdict.text());
}

SystemCorrection::SystemCorrection(const CalibrationResult& calibration, Flight flight,
                                   const Options& options)
    : attitude_(calibration.recovered_attitude),
      needs_recovered_(calibration.attitude == AttitudeSource::points),
      invert_(options.invert) {
  if (!flight) throw UsageError("correction: no trajectory is set");
  if (!options.force) requireUsable(calibration);
  attitude_.addPasses(options.further_attitude);
  flight_ = flightFor(calibration.attitude, std::move(flight), attitude_);
  evaluator_ = std::make_shared<const BiasEvaluator>(
      flight_, calibration.biases(), errorsOf(calibration, options.strip_corrections));
  if (calibration.sources.isZero(0.0)) return;
  sources_ = std::make_shared<const detail::SourceCorrection>(flight_, calibration.sources,
                                                              calibration.source_scale);
}

SystemCorrection::SystemCorrection(const SystemVector& biases, Flight flight, bool invert)
    : flight_(std::move(flight)), invert_(invert) {
  if (!flight_) throw UsageError("correction: no trajectory is set");
  evaluator_ = std::make_shared<const BiasEvaluator>(flight_, biases);
}

bool SystemCorrection::knowsAttitude(double flight_time) const {
  return !needs_recovered_ || attitude_.covers(flight_time);
}

void SystemCorrection::change(const PointColumns& points, std::size_t count,
                              const EffectColumns& change, CoverageCount& coverage) const {
  // Before the columns of the points may be overwritten.
  std::vector<double> by_sources[3];
  if (sources_ != nullptr) {
    for (std::vector<double>& axis : by_sources) axis.assign(count, 0.0);
    sources_->add(points, count, invert_,
                  {by_sources[0].data(), by_sources[1].data(), by_sources[2].data()});
  }
  if (invert_) {
    evaluator_->inverseEffect(points, count, change, coverage);
  } else {
    evaluator_->effect(points, count, change, coverage);
    for (double* column : {change.x, change.y, change.z}) {
      for (std::size_t i = 0; i < count; ++i) column[i] = -column[i];
    }
  }
  double* const columns[3] = {change.x, change.y, change.z};
  for (int axis = 0; axis < 3 && sources_ != nullptr; ++axis) {
    for (std::size_t i = 0; i < count; ++i) columns[axis][i] += by_sources[axis][i];
  }
  if (needs_recovered_) keepUnknown(points, count, change, coverage);
}

void SystemCorrection::keepUnknown(const PointColumns& points, std::size_t count,
                                   const EffectColumns& change, CoverageCount& coverage) const {
  // Most points lie in the pass of the point before.
  double from = 0.0, to = -1.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double time = points.time[i];
    if (from <= time && time <= to) continue;
    if (!std::isfinite(time) || flight_->coverage(time) != Trajectory::Coverage::covered) continue;
    const RecoveredAttitude::Pass* pass = attitude_.passAt(time);
    if (pass != nullptr) {
      from = pass->front().time, to = pass->back().time;
      continue;
    }
    change.x[i] = change.y[i] = change.z[i] = 0.0;
    ++coverage.without_attitude;
    coverage.first_missed = std::min(coverage.first_missed, time);
    coverage.last_missed = std::max(coverage.last_missed, time);
  }
}

}  // namespace pcl_als
