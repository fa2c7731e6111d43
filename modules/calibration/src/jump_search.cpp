// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "jump_search.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <pcl_als/common/statistics.h>

#include "error_diagnosis.h"
#include "strip_covariance.h"

namespace pcl_als {
namespace {

constexpr double kSlab = 0.1;      // metres: standard deviation of a jump
constexpr double kPresent = 0.1;   // prior probability of a jump in a block
constexpr double kInformed = 0.1;  // information of the observations over that of the prior
// metres: standard deviation of a change without a jump that is examined
constexpr double kLargest = SharedErrorModel::kDetermined * kSlab;
constexpr int kAxes = 3;
// Knots: errors are linear between them, so that a jump takes one or two intervals.
constexpr std::size_t kMinimumKnotDistance = 2;

/// A change of position between two neighbouring knots.
struct Change {
  int strip = 0, axis = 0;      ///< of the list of strips; 0 east, 1 north, 2 up
  double from = 0.0, to = 0.0;  ///< seconds
  double value = 0.0;           ///< by the observations alone, metres
  double variance = 0.0;        ///< of value where there is no jump, m^2

  double deviation() const { return value / std::sqrt(variance); }
};

/// A priori variance of a change over some seconds, m^2.
double priorVariance(const SharedErrorModel& model, const VarianceFactors& levels, double seconds) {
  const double position = model.position * model.position;
  const double markov =
      (1.0 - model.smooth_share - model.constant_share) * position * levels.gauss_markov.position;
  const double smooth = model.smooth_share * position * levels.smooth.position;
  // The smooth component: splines whose coefficients are a quarter of the correlation time apart
  // have nearly the autocorrelation exp(-3/4 (t / distance)^2).
  const double nodes = seconds / (0.25 * model.correlation_time);
  return -2.0 * markov * std::expm1(-seconds / model.correlation_time) -
         2.0 * smooth * std::expm1(-0.75 * nodes * nodes);
}

/// The knots among the times of a strip.
std::vector<SharedErrors::Expectation> knotsOf(const SharedErrors& errors, int strip) {
  std::vector<SharedErrors::Expectation> knots;
  for (SharedErrors::Expectation& at : errors.expectationsOf(strip)) {
    if (at.blocks.size() == 1 && at.gauss_markov_left == 0.0) knots.push_back(std::move(at));
  }
  return knots;
}

void addChanges(const SharedErrors& errors, const Adjustment& adjustment,
                const StripCovariance& covariance, const AdjustmentSolution& solution, int place,
                int strip, std::vector<Change>& changes) {
  const auto knots = knotsOf(errors, strip);
  for (std::size_t i = kMinimumKnotDistance; i < knots.size(); ++i) {
    const std::size_t first = i - kMinimumKnotDistance;
    const int before = knots[first].blocks.front().first, after = knots[i].blocks.front().first;
    SharedErrors::Expectation difference;
    difference.blocks = {{before, -1.0}, {after, 1.0}};
    const auto found = covariance.at(strip, difference);
    const double prior =
        priorVariance(errors.model(), adjustment.levels(), knots[i].time - knots[first].time);
    for (int axis = 0; axis < kAxes; ++axis) {
      const double variance = found.errors(axis, axis);
      const double information = 1.0 / variance - 1.0 / prior;
      if (!(variance > 0.0) || !(information * prior > kInformed)) continue;
      if (prior + 1.0 / information > kLargest * kLargest) continue;
      const double mean = solution.shared[after * SharedErrors::kPerKnot + axis] -
                          solution.shared[before * SharedErrors::kPerKnot + axis];
      changes.push_back({place, axis, knots[first].time, knots[i].time,
                         mean / (variance * information), prior + 1.0 / information});
    }
  }
}

/// Logarithm of the likelihood with a jump over that without.
double logRatio(const Change& change) {
  const double with = change.variance + kSlab * kSlab;
  const double square = change.value * change.value;
  return 0.5 * (std::log(change.variance / with) + square / change.variance - square / with);
}

ErrorFinding emptyFinding() {
  ErrorFinding finding;
  finding.source = "trajectory_jump";
  finding.title = "jump of the trajectory within a strip";
  finding.unit = "m";
  finding.std = kSlab;
  finding.hint =
      "check the GNSS solution at this time (ambiguities, change of the base station) and process "
      "the trajectory again; or leave the strip out";
  finding.evidence = "the strips have too few surfaces in common";
  return finding;
}

}  // namespace

JumpSearch::JumpSearch(const Adjustment& adjustment, const AdjustmentSolution& solution,
                       const std::vector<Strip>& strips)
    : finding_(emptyFinding()) {
  const auto covariance = adjustment.stripCovariance(solution);
  if (!covariance) return;
  std::vector<Change> changes;
  for (std::size_t i = 0; i < strips.size(); ++i)
    addChanges(adjustment.errors(), adjustment, *covariance, solution, static_cast<int>(i),
               strips[i].index, changes);
  if (changes.empty()) return;
  std::vector<double> deviations;
  for (const Change& change : changes) deviations.push_back(change.deviation());
  const double scatter = std::max(1.0, robustSigma(deviations));
  double odds = 0.0, largest = 0.0;
  const double prior = kPresent / (1.0 - kPresent) / static_cast<double>(changes.size());
  const Change* best = nullptr;
  for (Change& change : changes) {
    change.variance *= scatter * scatter;
    const double own = prior * std::exp(std::min(600.0, logRatio(change)));
    odds += own;
    if (own <= largest) continue;
    largest = own;
    best = &change;
  }
  const double share = kSlab * kSlab / (kSlab * kSlab + best->variance);
  finding_.probability = odds / (1.0 + odds);
  finding_.value = share * best->value;
  finding_.std = std::sqrt(share * best->variance);
  finding_.effect = std::abs(finding_.value);
  finding_.determined = finding_.std < SharedErrorModel::kDetermined * kSlab;
  constexpr const char* kNames[kAxes] = {"east", "north", "up"};
  char place[120];
  std::snprintf(place, sizeof place, "; largest in strip %s, %s, between %.1f and %.1f s",
                strips[static_cast<std::size_t>(best->strip)].id.c_str(), kNames[best->axis],
                best->from, best->to);
  finding_.evidence = evidenceOf(finding_) + place;
  if (finding_.determined && finding_.probability > kSupported)
    place_ = Place{strips[static_cast<std::size_t>(best->strip)].id,
                   static_cast<std::size_t>(best->axis), best->from, best->to, finding_.value};
}

}  // namespace pcl_als
