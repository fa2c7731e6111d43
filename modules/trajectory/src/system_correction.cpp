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

/// Whether a flight is already used as a model asks for.
bool follows(const Trajectory& flight, const Trajectory::Options& model) {
  return !model.body_attitude && model.nominal_attitude == flight.attitudeIsNominal() &&
         model.nominal_attitude == flight.hasAttitude() &&
         model.line_fit_half_width == flight.lineFitHalfWidth() &&
         model.scan_planes == flight.scanPlanes();
}

/// The flight as a model asks for; the flight itself where it is used so already.
Flight withModel(Flight flight, Trajectory::Options model) {
  if (model.scan_planes.empty()) model.scan_planes = flight->scanPlanes();
  if (!model.use_attitude) {
    if (follows(*flight, model)) return flight;
    return std::make_shared<const Trajectory>(flight->rebuilt(std::move(model)));
  }
  if (!flight->hasAttitude() || flight->attitudeIsNominal())
    throw InputError(
        "the calibration was estimated with the roll, pitch and heading of the trajectory, this "
        "trajectory has none: give one that has");
  if (model.scan_planes == flight->scanPlanes()) return flight;
  return std::make_shared<const Trajectory>(flight->withScanPlanes(std::move(model.scan_planes)));
}

}  // namespace

void SystemCorrection::requireUsable(const CalibrationResult& calibration) {
  if (calibration.verdict.usable()) return;
  throw UsageError("this calibration should not be applied, " + calibration.verdict.text());
}

SystemCorrection::SystemCorrection(const CalibrationResult& calibration,
                                   std::vector<TrajectorySample> samples, const Options& options) {
  const auto ends = std::minmax_element(
      samples.begin(), samples.end(),
      [](const TrajectorySample& a, const TrajectorySample& b) { return a.time < b.time; });
  if (samples.empty()) throw InputError("correction: the trajectory has no samples");
  takeOptions(calibration, ends.first->time, ends.second->time, options);
  flight_ = std::make_shared<const Trajectory>(
      std::move(samples), modelOf(calibration, Trajectory::Options().line_fit_half_width));
  addEvaluators(calibration, options.strip_corrections);
}

SystemCorrection::SystemCorrection(const CalibrationResult& calibration, Flight flight,
                                   const Options& options) {
  if (!flight) throw UsageError("correction: no trajectory is set");
  takeOptions(calibration, flight->startTime(), flight->endTime(), options);
  const double half_width = flight->lineFitHalfWidth();
  flight_ = withModel(std::move(flight), modelOf(calibration, half_width));
  addEvaluators(calibration, options.strip_corrections);
}

void SystemCorrection::takeOptions(const CalibrationResult& calibration, double from, double to,
                                   const Options& options) {
  if (!options.force) requireUsable(calibration);
  invert_ = options.invert;
  needs_recovered_ = calibration.attitude == AttitudeSource::points;
  if (isOfAnotherFlight(calibration, from, to)) {
    flight_remark_ =
        "the calibration is of another flight: its instrument part is applied, without the strip "
        "corrections and the recovered attitude of that flight";
  } else {
    attitude_ = calibration.recovered_attitude;
  }
  attitude_.addPasses(options.fallback_attitude);
  if (needs_recovered_ && attitude_.empty())
    throw InputError(
        "the calibration was estimated with pitch and crab recovered from the points, and does not "
        "hold those of this flight (it is of another one, or of an earlier version): recover them "
        "from the points");
  if (!options.strip_corrections) return;
  if (calibration.strip_errors.empty())
    throw InputError("the calibration has no strip corrections");
  if (!flight_remark_.empty())
    throw InputError(
        "the calibration is of another flight and has no strip corrections for this one");
}

Trajectory::Options SystemCorrection::modelOf(const CalibrationResult& calibration,
                                              double half_width) const {
  Trajectory::Options model;
  model.line_fit_half_width =
      calibration.line_fit_half_width > 0.0 ? calibration.line_fit_half_width : half_width;
  model.use_attitude = calibration.attitude == AttitudeSource::trajectory;
  model.nominal_attitude = calibration.attitude == AttitudeSource::nominal;
  if (needs_recovered_) model.body_attitude = [this](double time) { return attitude_.at(time); };
  model.scan_planes = calibration.scan_planes;
  return model;
}

void SystemCorrection::addEvaluators(const CalibrationResult& calibration, bool strip_corrections) {
  const auto errors = strip_corrections
                          ? std::make_shared<const TrajectoryErrors>(calibration.strip_errors)
                          : nullptr;
  const auto add = [&](const SystemVector& biases, const Eigen::Vector3d& offset) {
    evaluators_.push_back({std::make_shared<const BiasEvaluator>(flight_, biases, errors), offset});
  };
  if (calibration.systems.empty()) add(calibration.biases(), Eigen::Vector3d::Zero());
  for (const SystemEstimate& system : calibration.systems)
    add(system.values().head<kSystemParameterCount>(), system.offset);
  systems_ = SystemLookup(calibration);
  if (calibration.sources.isZero(0.0)) return;
  sources_ = std::make_shared<const detail::SourceCorrection>(flight_, calibration.sources,
                                                              calibration.source_scale);
}

SystemCorrection::SystemCorrection(const SystemVector& biases, Flight flight, bool invert)
    : flight_(std::move(flight)), invert_(invert) {
  if (!flight_) throw UsageError("correction: no trajectory is set");
  evaluators_.push_back(
      {std::make_shared<const BiasEvaluator>(flight_, biases), Eigen::Vector3d::Zero()});
}

bool SystemCorrection::knowsAttitude(double flight_time) const {
  return !needs_recovered_ || attitude_.covers(flight_time);
}

namespace {

/// The columns of chosen points.
class Gathered {
 public:
  Gathered(const PointColumns& from, const std::vector<std::size_t>& chosen) : from_(from) {
    const double* const columns[4] = {from.time, from.x, from.y, from.z};
    for (int c = 0; c < 4; ++c) {
      for (const std::size_t i : chosen) columns_[c].push_back(columns[c][i]);
    }
    for (const std::size_t i : chosen) {
      if (from.intensity != nullptr) intensity_.push_back(from.intensity[i]);
      if (from.scan_direction != nullptr) scan_directions_.push_back(from.scan_direction[i]);
    }
    for (std::vector<double>& change : changes_) change.resize(chosen.size());
  }
  PointColumns points() const {
    return {columns_[0].data(),
            columns_[1].data(),
            columns_[2].data(),
            columns_[3].data(),
            from_.intensity != nullptr ? intensity_.data() : nullptr,
            from_.scan_direction != nullptr ? scan_directions_.data() : nullptr};
  }
  EffectColumns change() { return {changes_[0].data(), changes_[1].data(), changes_[2].data()}; }

 private:
  const PointColumns& from_;
  std::vector<double> columns_[4], changes_[3];
  std::vector<float> intensity_;
  std::vector<std::int8_t> scan_directions_;
};

}  // namespace

void SystemCorrection::change(const PointColumns& points, std::size_t count,
                              const EffectColumns& change, CoverageCount& coverage) const {
  if (systems_.single()) {
    changeOf(evaluators_.front(), points, count, change, coverage);
  } else {
    changeBySystem(points, count, change, coverage);
  }
}

std::vector<std::vector<std::size_t>> SystemCorrection::bySystem(const PointColumns& points,
                                                                 std::size_t count) const {
  const std::string objection =
      systems_.objection(points.source != nullptr, points.channel != nullptr);
  if (!objection.empty()) throw UsageError(objection);
  std::vector<std::vector<std::size_t>> chosen(evaluators_.size() + 1);
  std::uint16_t source = 0;
  std::uint8_t channel = 0, system = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t of_point = points.source != nullptr ? points.source[i] : 0;
    const std::uint8_t of_scanner = points.channel != nullptr ? points.channel[i] : 0;
    if (i == 0 || of_point != source || of_scanner != channel) {
      source = of_point, channel = of_scanner;
      system = systems_.of(source, channel);
    }
    chosen[system].push_back(i);
  }
  return chosen;
}

void SystemCorrection::changeBySystem(const PointColumns& points, std::size_t count,
                                      const EffectColumns& change, CoverageCount& coverage) const {
  // The columns may be the same: all are gathered before the first one is written.
  const std::vector<std::vector<std::size_t>> chosen = bySystem(points, count);
  std::vector<Gathered> parts;
  for (const std::vector<std::size_t>& indices : chosen) parts.emplace_back(points, indices);
  for (std::size_t s = 0; s < parts.size(); ++s) {
    const EffectColumns part = parts[s].change();  // zero
    if (s == systems_.fixed())
      coverage.points += chosen[s].size();
    else
      changeOf(evaluators_[s], parts[s].points(), chosen[s].size(), part, coverage);
    for (std::size_t k = 0; k < chosen[s].size(); ++k) {
      change.x[chosen[s][k]] = part.x[k];
      change.y[chosen[s][k]] = part.y[k];
      change.z[chosen[s][k]] = part.z[k];
    }
  }
}

void SystemCorrection::changeOf(const System& system, const PointColumns& points, std::size_t count,
                                const EffectColumns& change, CoverageCount& coverage) const {
  // Before the columns of the points may be overwritten.
  std::vector<double> by_sources[3];
  if (sources_ != nullptr) {
    for (std::vector<double>& axis : by_sources) axis.assign(count, 0.0);
    sources_->add(points, count, invert_,
                  {by_sources[0].data(), by_sources[1].data(), by_sources[2].data()});
  }
  if (invert_) {
    system.evaluator->inverseEffect(points, count, change, coverage);
  } else {
    system.evaluator->effect(points, count, change, coverage);
    for (double* column : {change.x, change.y, change.z}) {
      for (std::size_t i = 0; i < count; ++i) column[i] = -column[i];
    }
  }
  double* const columns[3] = {change.x, change.y, change.z};
  for (int axis = 0; axis < 3 && sources_ != nullptr; ++axis) {
    for (std::size_t i = 0; i < count; ++i) columns[axis][i] += by_sources[axis][i];
  }
  // Without the offset, which is not in proportion to the range and may be that of few points.
  for (std::size_t i = 0; i < count; ++i)
    coverage.sizes.add(change.x[i], change.y[i], change.z[i], points.time[i]);
  for (std::size_t i = 0; i < count && !system.offset.isZero(0.0); ++i) {
    if (flight_->coverage(points.time[i]) != Trajectory::Coverage::covered) continue;
    for (int axis = 0; axis < 3; ++axis)
      columns[axis][i] += invert_ ? system.offset[axis] : -system.offset[axis];
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
