// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <Eigen/Cholesky>

#include <pcl_als/calibration/pair_selection.h>
#include <pcl_als/tin/orientation_classes.h>

#include "pairing_rules.h"

namespace pcl_als {

/// Pairs that are much alike.
struct PairSelection::Group {
  std::size_t area = 0;
  std::array<int, 2> strips{};
  SystemRow row = SystemRow::Zero();  ///< mean
  double variance = 0.0;              ///< of one pair, m^2
  std::vector<std::size_t> members;
  double least = 0.0, number = 0.0;  ///< pairs for the spread alone; pairs in all

  /// Inverse variance of the group with so many pairs.
  double information(double shared) const {
    return number > 0.0 ? 1.0 / (shared + variance / number) : 0.0;
  }
};

namespace {

/// N^-1 with each parameter in units of its own information, what nothing shows left out.
template <typename Groups>
SystemMatrix inverseNormal(const Groups& groups, double shared) {
  SystemMatrix normal = SystemMatrix::Zero();
  for (const auto& group : groups) {
    normal += group.information(shared) * group.row.transpose() * group.row;
  }
  SystemVector scale = SystemVector::Zero();
  for (int i = 0; i < kSystemParameterCount; ++i) {
    if (normal(i, i) > 0.0) scale[i] = 1.0 / std::sqrt(normal(i, i));
  }
  // What the pairs cannot tell apart is not for them to decide: a little belief in each parameter.
  constexpr double kBelief = 1e-6;
  SystemMatrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
  scaled.diagonal().array() += kBelief;
  return scale.asDiagonal() * scaled.ldlt().solve(SystemMatrix::Identity()) * scale.asDiagonal();
}

}  // namespace

PairSelection::PairSelection(const std::vector<AreaObservations>& observations,
                             const std::vector<std::vector<double>>& weights,
                             const PairSelectionSettings& settings)
    : settings_(settings), chosen_(observations.size()) {
  std::vector<Group> groups = groupsOf(observations, weights);
  spreadEvenly(groups);
  spendOnInformation(groups);
  takeMembers(groups);
}

std::vector<PairSelection::Group> PairSelection::groupsOf(
    const std::vector<AreaObservations>& observations,
    const std::vector<std::vector<double>>& weights) {
  std::vector<Group> groups;
  for (std::size_t area = 0; area < observations.size(); ++area) {
    std::map<std::array<int, 3>, Group> here;
    for (std::size_t i = 0; i < observations[area].size(); ++i) {
      const PairObservation& o = observations[area][i];
      if (o.a == PairObservation::kControl) chosen_[area].push_back(i);
      if (o.a == PairObservation::kControl || weights[area][i] == 0.0) continue;
      const auto orientation = static_cast<int>(OrientationClasses::of(o.normal));
      Group& group = here[{std::min(o.a, o.b), std::max(o.a, o.b), orientation}];
      group.area = area;
      group.strips = {std::min(o.a, o.b), std::max(o.a, o.b)};
      group.row += (o.a < o.b ? 1.0 : -1.0) * o.row();  // of the first strip against the second
      group.variance += o.variance / (weights[area][i] * o.sharing);  // fewer share less
      group.members.push_back(i);
    }
    for (auto& [key, group] : here) {
      const auto count = static_cast<double>(group.members.size());
      group.row /= count;
      group.variance /= count;
      groups.push_back(std::move(group));
    }
  }
  return groups;
}

void PairSelection::spreadEvenly(std::vector<Group>& groups) const {
  std::map<std::pair<std::size_t, std::array<int, 2>>, std::vector<std::size_t>> meetings;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    meetings[{groups[g].area, groups[g].strips}].push_back(g);
  }
  const double each = settings_.spread * static_cast<double>(settings_.budget) /
                      std::max<double>(1.0, static_cast<double>(meetings.size()));
  for (const auto& [where, members] : meetings) {
    std::vector<double> sizes;
    for (const std::size_t g : members) {
      sizes.push_back(static_cast<double>(groups[g].members.size()));
    }
    const std::vector<double> shares = evenShares(sizes, each);
    for (std::size_t i = 0; i < members.size(); ++i) groups[members[i]].least = shares[i];
  }
}

void PairSelection::spendOnInformation(std::vector<Group>& groups) const {
  double available = 0.0;
  for (Group& group : groups) {
    group.number = static_cast<double>(group.members.size());
    available += group.number;
  }
  const auto budget = static_cast<double>(settings_.budget);
  if (available <= budget) return;
  for (Group& group : groups)
    group.number = std::max(group.least, group.number * budget / available);
  const double shared = settings_.shared_variance;
  constexpr int kRounds = 12, kHalvings = 50;
  for (int round = 0; round < kRounds; ++round) {
    const SystemMatrix inverse = inverseNormal(groups, shared);
    std::vector<double> gain;  // v_p r N^-1 r'
    for (const Group& group : groups) {
      gain.push_back(group.variance * (group.row * inverse * group.row.transpose()).value());
    }
    const auto numberAt = [&](std::size_t g, double lambda) {
      const Group& group = groups[g];
      const double number = (std::sqrt(gain[g] / lambda) - group.variance) / shared;
      return std::clamp(number, group.least, static_cast<double>(group.members.size()));
    };
    double low = -80.0, high = 80.0;  // ln lambda: fewer pairs with more
    for (int halving = 0; halving < kHalvings; ++halving) {
      const double middle = 0.5 * (low + high);
      double total = 0.0;
      for (std::size_t g = 0; g < groups.size(); ++g) total += numberAt(g, std::exp(middle));
      (total > budget ? low : high) = middle;
    }
    for (std::size_t g = 0; g < groups.size(); ++g) groups[g].number = numberAt(g, std::exp(high));
  }
}

void PairSelection::takeMembers(const std::vector<Group>& groups) {
  double owed = 0.0;  // fractions of pairs carried from group to group, so that the sum holds
  for (const Group& group : groups) {
    const std::size_t size = group.members.size();
    const double wanted = group.number + owed;
    const std::size_t taken =
        std::min(size, static_cast<std::size_t>(std::max(0.0, std::floor(wanted))));
    owed = std::min(1.0, wanted - static_cast<double>(taken));
    for (std::size_t k = 0; k < taken; ++k) {
      chosen_[group.area].push_back(group.members[k * size / taken]);
    }
  }
  for (auto& indices : chosen_) std::sort(indices.begin(), indices.end());
}

std::size_t PairSelection::chosenCount() const {
  std::size_t count = 0;
  for (const auto& indices : chosen_) count += indices.size();
  return count;
}

}  // namespace pcl_als
