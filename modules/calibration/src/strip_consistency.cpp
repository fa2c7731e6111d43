// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_consistency.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include <pcl_als/common/linear_solvers.h>

namespace pcl_als {
namespace {

constexpr double kLevel = 0.05;            // significance level of all comparisons together
constexpr double kPriorFreedom = 4.0;      // degrees of freedom that the prior contributes
constexpr double kSession = 3.0 * 3600.0;  // seconds without a strip between two sessions
constexpr double kOtherHeight = 1.1;       // ratio of flying heights
constexpr double kFewPairs = 200.0;        // number of pairs with which a mean has half its weight
constexpr double kLeast = 0.01;  // metres: smaller offsets are not reported, however significant
constexpr const char* kAdvice = ": calibrate without it or separately, or correct its trajectory";

/// Two-sided probability of a value of Student's t (approximation of Wallace 1959).
double probabilityOf(double t, double freedom) {
  const double z = (8.0 * freedom + 1.0) / (8.0 * freedom + 3.0) *
                   std::sqrt(freedom * std::log1p(t * t / freedom));
  return std::erfc(z / std::sqrt(2.0));
}

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// "0.068 m above" or "0.068 m below".
std::string heightAgainst(double difference) {
  return text("%.3f m", std::abs(difference)) + (difference < 0.0 ? " below" : " above");
}

std::string duration(double seconds) {
  const double hours = seconds / 3600.0;
  return hours < 48.0 ? text("%.1f hours", hours) : text("%.1f days", hours / 24.0);
}

}  // namespace

double StripErrorPrior::meanStd(double seconds) const {
  const double length = std::max(seconds, 1e-3) / correlation_time;
  const double share = 2.0 / length * (1.0 - (1.0 - std::exp(-length)) / length);
  return position * std::sqrt(std::min(1.0, share));
}

StripConsistency::StripConsistency(const std::vector<StripFacts>& strips,
                                   const std::vector<PairFit>& pairs, const StripErrorPrior& prior)
    : prior_(prior) {
  findOffsets(strips, pairs);
  if (offsets_.size() < 3) return;
  const double alpha = kLevel / (static_cast<double>(offsets_.size()) + 2.0);
  compareSessions(alpha);
  compareHeights(alpha);
  if (offsets_.size() > 3) compareStrips(alpha);
}

void StripConsistency::findOffsets(const std::vector<StripFacts>& strips,
                                   const std::vector<PairFit>& pairs) {
  const auto inPairs = [&](const StripFacts& strip) {
    return std::any_of(pairs.begin(), pairs.end(), [&](const PairFit& pair) {
      return pair.correspondences > 0 && (pair.a == strip.id || pair.b == strip.id);
    });
  };
  std::copy_if(strips.begin(), strips.end(), std::back_inserter(strips_), inPairs);
  const auto indexOfStrip = [&](const std::string& id) {
    return std::find_if(strips_.begin(), strips_.end(),
                        [&](const StripFacts& strip) { return strip.id == id; }) -
           strips_.begin();
  };
  const auto size = static_cast<Eigen::Index>(strips_.size());
  // The mean of all offsets is zero; a weak prior of zero regularises groups that no pair connects.
  Eigen::MatrixXd normal = Eigen::MatrixXd::Constant(size, size, 1.0);
  normal.diagonal().array() += 1e-6;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (const PairFit& pair : pairs) {
    const Eigen::Index a = indexOfStrip(pair.a), b = indexOfStrip(pair.b);
    if (pair.correspondences == 0 || a == size || b == size) continue;
    const auto count = static_cast<double>(pair.correspondences);
    const double weight = count / (count + kFewPairs);
    normal(a, a) += weight, normal(b, b) += weight;
    normal(a, b) -= weight, normal(b, a) -= weight;
    right[a] += weight * pair.mean_after, right[b] -= weight * pair.mean_after;
  }
  const Eigen::VectorXd offsets = solveSymmetric(normal, right);
  for (Eigen::Index i = 0; i < size; ++i) {
    const StripFacts& strip = strips_[static_cast<std::size_t>(i)];
    offsets_.push_back({strip.id, offsets[i], prior_.meanStd(strip.end - strip.start), true});
  }
}

StripConsistency::Comparison StripConsistency::compare(const std::vector<bool>& group) const {
  double count[2] = {0.0, 0.0}, sum[2] = {0.0, 0.0}, squares = 0.0, prior = 0.0;
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    const int side = group[i] ? 1 : 0;
    count[side] += 1.0, sum[side] += offsets_[i].offset;
    prior += std::pow(offsets_[i].expected_std, 2);
  }
  if (count[0] == 0.0 || count[1] == 0.0) return {};
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    const int side = group[i] ? 1 : 0;
    squares += std::pow(offsets_[i].offset - sum[side] / count[side], 2);
  }
  const double strips = count[0] + count[1];
  const double freedom = kPriorFreedom + strips - 2.0;
  const double variance = (kPriorFreedom * prior / strips + squares) / freedom;
  const double difference = sum[1] / count[1] - sum[0] / count[0];
  const double std = std::sqrt(variance * (1.0 / count[0] + 1.0 / count[1]));
  return {difference, std > 0.0 ? probabilityOf(difference / std, freedom) : 1.0};
}

std::string StripConsistency::names(const std::vector<bool>& group) const {
  std::string list;
  for (std::size_t i = 0; i < strips_.size(); ++i) {
    if (group[i]) list += (list.empty() ? "" : ", ") + strips_[i].id;
  }
  return list;
}

void StripConsistency::compareSessions(double alpha) {
  std::vector<std::size_t> order(strips_.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return strips_[a].start < strips_[b].start; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    double last = strips_[order[0]].end;
    for (std::size_t i = 0; i < k; ++i) last = std::max(last, strips_[order[i]].end);
    const double gap = strips_[order[k]].start - last;
    if (gap < kSession) continue;
    std::vector<bool> later(strips_.size(), false);
    for (std::size_t i = k; i < order.size(); ++i) later[order[i]] = true;
    const Comparison found = compare(later);
    const bool differs = found.probability < alpha && std::abs(found.difference) > kLeast;
    std::string warning = "strips " + names(later) + " were measured " + duration(gap) +
                          " after the others, in another session";
    warning += differs ? ", and lie " + heightAgainst(found.difference) +
                             " them after the calibration: calibrate the sessions separately"
                       : "; their heights agree with the others to " +
                             text("%.3f m", std::abs(found.difference)) +
                             ", but the mounting may have changed";
    warnings_.push_back({warning, Hint::strips});
  }
}

void StripConsistency::compareHeights(double alpha) {
  std::vector<double> heights;
  for (const StripFacts& strip : strips_) heights.push_back(strip.height);
  std::sort(heights.begin(), heights.end());
  if (heights.front() <= 0.0) return;
  for (std::size_t k = 1; k < heights.size(); ++k) {
    if (heights[k] < kOtherHeight * heights[k - 1]) continue;
    std::vector<bool> higher;
    for (const StripFacts& strip : strips_) higher.push_back(strip.height >= heights[k]);
    const Comparison found = compare(higher);
    if (found.probability >= alpha || std::abs(found.difference) <= kLeast) continue;
    warnings_.push_back(
        {"strips " + names(higher) + ", flown at " + text("%.0f m", heights[k]) +
             " and more, lie " + heightAgainst(found.difference) + " the others, flown at " +
             text("%.0f m", heights[k - 1]) +
             " and less, after the calibration: a range bias or scale, or another session; control "
             "at "
             "both heights or a separate calibration of these strips separates these causes",
         Hint::strips});
  }
}

void StripConsistency::compareStrips(double alpha) {
  for (std::size_t i = 0; i < offsets_.size(); ++i) {
    std::vector<bool> alone(offsets_.size(), false);
    alone[i] = true;
    const Comparison found = compare(alone);
    if (found.probability >= alpha || std::abs(found.difference) <= kLeast) continue;
    offsets_[i].consistent = false;
    warnings_.push_back({"strip " + offsets_[i].strip + " lies " + heightAgainst(found.difference) +
                             " the others after the calibration, more than the scatter of the "
                             "strips explains" +
                             kAdvice,
                         Hint::strips});
  }
}

}  // namespace pcl_als
