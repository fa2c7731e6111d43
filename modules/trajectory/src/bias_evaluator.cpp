// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/bias_evaluator.h>

#include "bias_kernel.h"

namespace pcl_als {
namespace {

/// Points of one tile of the inverse: their columns stay in the first-level cache.
constexpr std::size_t kTile = 512;
using Tile = std::array<double, kTile>;

constexpr int kMostIterations = 60;
constexpr double kConverged = 1e-7;  ///< metres, change of the effect
constexpr double kSolved = 1e-6;     ///< metres

void checkBiases(const SystemVector& biases) {
  for (const SystemParameterInfo& info : systemParameters()) {
    const std::string refused = refusedBias(info.parameter, biases[indexOf(info.parameter)]);
    if (!refused.empty()) throw UsageError("bias of " + std::string(info.name) + ": " + refused);
  }
}

PointColumns from(const PointColumns& points, std::size_t first) {
  return {points.time + first, points.x + first, points.y + first, points.z + first};
}

EffectColumns from(const EffectColumns& effect, std::size_t first) {
  return {effect.x + first, effect.y + first, effect.z + first};
}

/// sum = base + change, element by element; the return value is the largest |change - last change|,
/// which replaces it. NaN points count as settled.
double step(const double* base, const double* change, double* last_change, double* sum,
            std::size_t count) {
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double update = std::abs(change[i] - last_change[i]);
    if (update > largest) largest = update;
    last_change[i] = change[i];
    sum[i] = base[i] + change[i];
  }
  return largest;
}

}  // namespace

void CoverageCount::merge(const CoverageCount& other) {
  points += other.points;
  before_start += other.before_start;
  after_end += other.after_end;
  in_gap += other.in_gap;
  without_time += other.without_time;
  without_attitude += other.without_attitude;
  unsolved += other.unsolved;
  without_strip_errors += other.without_strip_errors;
  first_missed = std::min(first_missed, other.first_missed);
  last_missed = std::max(last_missed, other.last_missed);
  sizes.merge(other.sizes);
}

std::string CoverageCount::describe(const Trajectory& trajectory) const {
  std::string text;
  const auto add = [&text](std::size_t count, const char* what) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + std::to_string(count) + what;
  };
  add(before_start, " before its start");
  add(after_end, " after its end");
  add(in_gap, " in its gaps");
  add(without_time, " without a time");
  add(without_attitude, " at times whose pitch and crab are not known");
  const std::string of = " of " + std::to_string(points) + " points ";
  if (missed() > 0)
    text = std::to_string(missed()) + of +
           (missed() == without_attitude ? "are not covered: " : "have no trajectory: ") + text;
  if (first_missed <= last_missed) {
    char times[200];
    std::snprintf(times, sizeof times,
                  " (their times %.3f to %.3f s, the trajectory %.3f to %.3f s)", first_missed,
                  last_missed, trajectory.startTime(), trajectory.endTime());
    text += times;
  }
  if (unsolved > 0) {
    text += (text.empty() ? "" : "; ") + std::to_string(unsolved) + of +
            "have no biased position to 1e-6 m for these biases";
  }
  return text;
}

BiasEvaluator::BiasEvaluator(std::shared_ptr<const Trajectory> trajectory,
                             const SystemVector& biases,
                             std::shared_ptr<const TrajectoryErrors> errors)
    : trajectory_(std::move(trajectory)), biases_(biases), errors_(std::move(errors)) {
  if (!trajectory_) throw UsageError("bias evaluation: no trajectory is set");
  checkBiases(biases_);
}

void BiasEvaluator::countMissed(double time, CoverageCount& coverage) const {
  if (!std::isfinite(time)) {
    ++coverage.without_time;
    return;
  }
  coverage.first_missed = std::min(coverage.first_missed, time);
  coverage.last_missed = std::max(coverage.last_missed, time);
  switch (trajectory_->coverage(time)) {
    case Trajectory::Coverage::before_start:
      ++coverage.before_start;
      break;
    case Trajectory::Coverage::after_end:
      ++coverage.after_end;
      break;
    case Trajectory::Coverage::in_gap:
    case Trajectory::Coverage::covered:
      ++coverage.in_gap;
      break;
  }
}

/// Errors of the trajectory change by some tenths of a millimetre in a tenth of a second: their
/// angles are those of its middle. The cells are counted from zero, so that the order of points
/// changes no bit.
void BiasEvaluator::spanEffect(const FlightSpan& span, const PointColumns& points,
                               std::size_t count, const EffectColumns& effect,
                               CoverageCount& coverage) const {
  constexpr double kCell = 0.1;  // seconds
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    const double cell = std::floor(points.time[first] / kCell);
    const double from_time = cell * kCell, to_time = (cell + 1.0) * kCell;
    for (++last; last < count && std::floor(points.time[last] / kCell) == cell;) ++last;
    TrajectoryErrorKnot start, middle, end;
    if (!errors_->at(0.5 * (from_time + to_time), middle))
      coverage.without_strip_errors += last - first;
    errors_->at(from_time, start);
    errors_->at(to_time, end);
    SystemVector biases = biases_;
    biases.segment<3>(indexOf(SystemParameter::boresight_pitch)) += middle.angles;
    // The columns may be the points' own: the errors are kept aside until the kernel is done.
    std::array<Eigen::Vector3d, kTile> shifts;
    for (std::size_t tile = first; tile < last; tile += kTile) {
      const std::size_t size = std::min(kTile, last - tile);
      for (std::size_t i = 0; i < size; ++i) {
        const double share = (points.time[tile + i] - from_time) / kCell;
        shifts[i] = start.position + share * (end.position - start.position);
      }
      const EffectColumns out = from(effect, tile);
      detail::biasKernel(span, detail::MountingBias(biases), from(points, tile), size, out);
      for (std::size_t i = 0; i < size; ++i) {
        out.x[i] += shifts[i].x(), out.y[i] += shifts[i].y(), out.z[i] += shifts[i].z();
      }
    }
  }
}

void BiasEvaluator::effect(const PointColumns& points, std::size_t count,
                           const EffectColumns& effect, CoverageCount& coverage) const {
  coverage.points += count;
  const detail::MountingBias mounting(biases_);
  FlightSpan span;
  std::size_t cursor = 0;
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    const double time = points.time[first];
    ++last;
    if (!trajectory_->spanAt(time, span, cursor)) {
      countMissed(time, coverage);
      effect.x[first] = effect.y[first] = effect.z[first] = 0.0;
      continue;
    }
    // A time at span.to belongs to the next span, so that the order of points changes no bit.
    while (last < count && points.time[last] >= span.from && points.time[last] < span.to) ++last;
    if (errors_ != nullptr) {
      spanEffect(span, from(points, first), last - first, from(effect, first), coverage);
    } else {
      detail::biasKernel(span, mounting, from(points, first), last - first, from(effect, first));
    }
  }
}

void BiasEvaluator::inverseEffect(const PointColumns& points, std::size_t count,
                                  const EffectColumns& effect, CoverageCount& coverage) const {
  Tile last_x, last_y, last_z, biased_x, biased_y, biased_z, x, y, z;
  for (std::size_t first = 0; first < count; first += kTile) {
    const std::size_t size = std::min(kTile, count - first);
    const PointColumns corrected = from(points, first);
    const EffectColumns result = from(effect, first);
    const PointColumns biased{corrected.time, biased_x.data(), biased_y.data(), biased_z.data()};
    const EffectColumns next{x.data(), y.data(), z.data()};
    CoverageCount tile_coverage;
    this->effect(corrected, size, next, tile_coverage);
    double change = std::numeric_limits<double>::infinity();
    last_x.fill(0.0), last_y.fill(0.0), last_z.fill(0.0);
    for (int i = 0; i < kMostIterations; ++i) {
      change = std::max({step(corrected.x, next.x, last_x.data(), biased_x.data(), size),
                         step(corrected.y, next.y, last_y.data(), biased_y.data(), size),
                         step(corrected.z, next.z, last_z.data(), biased_z.data(), size)});
      if (change < kConverged) break;
      CoverageCount ignored;
      this->effect(biased, size, next, ignored);
    }
    if (change >= kSolved) tile_coverage.unsolved = size;
    std::copy_n(last_x.data(), size, result.x);
    std::copy_n(last_y.data(), size, result.y);
    std::copy_n(last_z.data(), size, result.z);
    coverage.merge(tile_coverage);
  }
}

}  // namespace pcl_als
