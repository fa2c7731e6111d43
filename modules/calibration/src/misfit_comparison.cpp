// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "misfit_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include <pcl_als/common/statistics.h>

namespace pcl_als {
namespace {

constexpr double kLimit = 4.5;  // robust standard deviations, as PairWeights rejects

using Distances = std::vector<std::pair<double, double>>;  // before and after, metres

double robustSize(const std::vector<Distances>& areas, bool after) {
  std::vector<double> sizes;
  for (const Distances& area : areas) {
    for (const auto& [first, second] : area) sizes.push_back(std::abs(after ? second : first));
  }
  return sizes.empty() ? 0.0 : 1.4826 * medianInPlace(sizes);
}

/// Sums of truncated squares over one area, square metres.
struct AreaSum {
  double count = 0.0, before = 0.0, after = 0.0;
};

AreaSum sumOf(const Distances& distances, double limit) {
  AreaSum sum;
  for (const auto& [before, after] : distances) {
    sum.count += 1.0;
    sum.before += std::pow(std::min(std::abs(before), limit), 2);
    sum.after += std::pow(std::min(std::abs(after), limit), 2);
  }
  return sum;
}

/// Standard deviation of the mean change of the squares, with areas as clusters; unknown for one
/// area.
double changeStd(const std::vector<AreaSum>& areas, const AreaSum& all) {
  const double mean = (all.after - all.before) / all.count;
  double squares = 0.0, clusters = 0.0;
  for (const AreaSum& area : areas) {
    if (area.count == 0.0) continue;
    squares += std::pow(area.after - area.before - area.count * mean, 2);
    clusters += 1.0;
  }
  if (clusters < 2.0) return std::numeric_limits<double>::quiet_NaN();
  return std::sqrt(clusters / (clusters - 1.0) * squares) / all.count;
}

}  // namespace

bool MisfitComparison::Distance::operator<(const Distance& other) const {
  return std::tie(a, b, point) < std::tie(other.a, other.b, other.point);
}

MisfitComparison::MisfitComparison(const std::vector<AreaObservations>& delivered) {
  for (const AreaObservations& area : delivered) {
    std::vector<Distance>& distances = delivered_.emplace_back();
    for (const PairObservation& o : area) {
      if (o.a == PairObservation::kControl) continue;
      const double distance = o.distance(SystemVector::Zero());
      distances.push_back({o.surfaceA(), o.surfaceB(), o.point, static_cast<float>(distance)});
    }
    std::sort(distances.begin(), distances.end());
  }
}

MisfitChange MisfitComparison::change(const std::vector<AreaObservations>& calibrated,
                                      const SystemVector& biases) const {
  std::vector<Distances> common(calibrated.size());
  for (std::size_t area = 0; area < calibrated.size() && area < delivered_.size(); ++area) {
    for (const PairObservation& o : calibrated[area]) {
      if (o.a == PairObservation::kControl) continue;
      const Distance key{o.surfaceA(), o.surfaceB(), o.point, 0.0F};
      const auto& before = delivered_[area];
      const auto found = std::lower_bound(before.begin(), before.end(), key);
      if (found == before.end() || key < *found) continue;
      common[area].emplace_back(found->before, o.distance(biases));
    }
  }
  MisfitChange change;
  change.limit = kLimit * std::max(robustSize(common, false), robustSize(common, true));
  std::vector<AreaSum> sums;
  AreaSum all;
  for (const Distances& area : common) {
    const AreaSum& sum = sums.emplace_back(sumOf(area, change.limit));
    all.count += sum.count, all.before += sum.before, all.after += sum.after;
    change.points += area.size();
    change.areas += area.empty() ? 0 : 1;
  }
  if (change.points == 0) return change;
  change.rms_before = std::sqrt(all.before / all.count);
  change.rms_after = std::sqrt(all.after / all.count);
  const double both = change.rms_before + change.rms_after;
  if (both > 0.0) change.change_std = changeStd(sums, all) / both;
  return change;
}

}  // namespace pcl_als
