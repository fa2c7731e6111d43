// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "correction_excursions.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/distributions.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

constexpr double kLevel = 0.01;      // probability of an excursion in a block without any
constexpr double kPartOfPeak = 0.5;  // to which an excursion reaches
// Correlation times after which errors count as independent: the distance of the nodes of their
// smooth component.
constexpr double kIndependent = 0.25;
constexpr double kLongestPiece = 10.0;  // seconds between neighbouring knots

bool hasCovariance(const StripErrors& strip) {
  return !strip.knots.empty() &&
         std::all_of(strip.knots.begin(), strip.knots.end(),
                     [](const TrajectoryErrorKnot& knot) { return knot.hasStd(); });
}

/// Robust standard deviation about zero of the estimates at the knots that are determined better
/// than the median: the others are near zero whatever the errors are.
double blockStd(const std::vector<StripErrors>& strips, std::size_t axis,
                const std::set<CorrectionCurve>& apart) {
  std::vector<const TrajectoryErrorKnot*> knots;
  std::vector<double> deviations, values;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (apart.count({i, axis}) != 0 || !hasCovariance(strips[i])) continue;
    for (const TrajectoryErrorKnot& knot : strips[i].knots) {
      knots.push_back(&knot);
      deviations.push_back(stdOf(knot, axis));
    }
  }
  if (knots.empty()) return 0.0;
  const double median = medianInPlace(deviations);
  for (const TrajectoryErrorKnot* knot : knots)
    if (stdOf(*knot, axis) <= median) values.push_back(errorOf(*knot, axis));
  return robustSigmaAboutZero(std::move(values));
}

std::array<double, kTrajectoryAxes.size()> priorsOf(const SharedErrorModel& model) {
  return {model.position,   model.position,   model.position,
          model.roll_pitch, model.roll_pitch, model.heading};
}

/// The knots of a strip as a curve in one axis, of positive values where \a sign is that of errors.
struct SignedCurve {
  const std::vector<TrajectoryErrorKnot>& knots;
  std::size_t axis;
  double sign;

  double at(std::size_t i) const { return sign * errorOf(knots[i], axis); }
  bool joined(std::size_t i, std::size_t next) const {
    return knots[next].time - knots[i].time <= kLongestPiece;
  }
  /// Where it falls to \a level on the way from knot \a i in steps of 1 or -1.
  double fallsTo(double level, std::size_t i, int step) const {
    while (true) {
      const bool last = step > 0 ? i + 1 == knots.size() : i == 0;
      const std::size_t next = last ? i : step > 0 ? i + 1 : i - 1;
      if (last || !joined(std::min(i, next), std::max(i, next))) return knots[i].time;
      if (at(next) < level) {
        const double part = (at(i) - level) / (at(i) - at(next));
        return knots[i].time + part * (knots[next].time - knots[i].time);
      }
      i = next;
    }
  }
};

}  // namespace

double errorOf(const TrajectoryErrorKnot& knot, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  return i < 3 ? knot.position[i] : knot.angles[i - 3];
}

double stdOf(const TrajectoryErrorKnot& knot, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  return i < 3 ? knot.position_std[i] : knot.angles_std[i - 3];
}

OrdinaryErrors::OrdinaryErrors(const std::vector<StripErrors>& strips,
                               const SharedErrorModel& model,
                               const std::set<CorrectionCurve>& apart) {
  double knots = 0.0, freedom = 0.0;
  for (const StripErrors& strip : strips) {
    if (!hasCovariance(strip)) continue;
    knots += static_cast<double>(strip.knots.size());
    freedom += 1.0 + (strip.knots.back().time - strip.knots.front().time) /
                         (kIndependent * model.correlation_time);
  }
  if (knots == 0.0) return;
  const double tail = 0.5 * kLevel / (knots * static_cast<double>(kTrajectoryAxes.size()));
  significant_ = normalCritical(tail);
  const double of_block = studentCritical(tail, freedom);
  const auto priors = priorsOf(model);
  for (std::size_t axis = 0; axis < std_.size(); ++axis) {
    const double block = blockStd(strips, axis, apart);
    std_[axis] = std::max(priors[axis], block);
    limit_[axis] = std::max(significant_ * priors[axis], of_block * block);
  }
}

namespace {

/// The excursion about the largest error of a run of knots, \a first to \a last.
CorrectionExcursion excursionOf(const SignedCurve& curve, std::size_t first, std::size_t last) {
  std::size_t peak = first;
  for (std::size_t i = first; i <= last; ++i)
    if (curve.at(i) > curve.at(peak)) peak = i;
  CorrectionExcursion found;
  found.time = curve.knots[peak].time;
  found.value = errorOf(curve.knots[peak], curve.axis);
  found.std = stdOf(curve.knots[peak], curve.axis);
  const double level = kPartOfPeak * curve.at(peak);
  found.from = curve.fallsTo(level, peak, -1);
  found.to = curve.fallsTo(level, peak, 1);
  return found;
}

void addExcursions(const SignedCurve& curve, const CorrectionCurve& name,
                   const OrdinaryErrors& ordinary, std::vector<CorrectionExcursion>& found) {
  const double limit = ordinary.limit(name.second);
  const auto exceeds = [&](std::size_t i) {
    return curve.at(i) > limit &&
           curve.at(i) > ordinary.significant() * stdOf(curve.knots[i], curve.axis);
  };
  for (std::size_t first = 0; first < curve.knots.size(); ++first) {
    if (!exceeds(first)) continue;
    std::size_t last = first;
    while (last + 1 < curve.knots.size() && exceeds(last + 1) && curve.joined(last, last + 1))
      ++last;
    CorrectionExcursion excursion = excursionOf(curve, first, last);
    first = last;
    excursion.curve = name;
    excursion.ordinary = ordinary.std(name.second);
    excursion.evidence = std::abs(excursion.value) / limit;
    // Runs that a short return below the limit divides.
    if (!found.empty() && found.back().curve == name &&
        excursion.value * found.back().value > 0.0 &&
        (excursion.time < found.back().to || found.back().time > excursion.from)) {
      if (excursion.evidence > found.back().evidence) found.back() = excursion;
      continue;
    }
    found.push_back(excursion);
  }
}

}  // namespace

std::vector<CorrectionExcursion> findExcursions(const std::vector<StripErrors>& strips,
                                                const OrdinaryErrors& ordinary) {
  std::vector<CorrectionExcursion> found;
  for (std::size_t i = 0; i < strips.size(); ++i) {
    if (!hasCovariance(strips[i])) continue;
    for (std::size_t axis = 0; axis < kTrajectoryAxes.size(); ++axis)
      for (const double sign : {1.0, -1.0})
        addExcursions({strips[i].knots, axis, sign}, {i, axis}, ordinary, found);
  }
  return found;
}

}  // namespace pcl_als
