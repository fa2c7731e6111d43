// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pair_selection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/tin/orientation_classes.h>

#include "pair_observation.h"

namespace pcl_als {

/// Pairs with nearly equal rows.
struct PairSelection::Group {
  struct Member {
    std::size_t index;
    Eigen::Vector3d normal;
    double stretch, weight, residual;  ///< of the first strip minus the second
    Eigen::Array2d times;              ///< of the first and the second strip
    double sign;
  };
  std::size_t area = 0;
  std::array<int, 2> strips{};
  std::vector<Member> members, taken;
  double influence = 0.0;            ///< RMS effect of the noise of a pair on the parameters
  double least = 0.0, number = 0.0;  ///< pairs of the even distribution; all pairs
};

namespace {

/// C W C: r' (C W C) r is the sum of the squared changes of the parameters, each over its standard
/// deviation, by one unit of a pair of row r.
SystemMatrix effectOfRows(const SystemMatrix& covariance) {
  SystemVector importance = SystemVector::Zero();
  for (int i = 0; i < kSystemParameterCount; ++i)
    if (covariance(i, i) > 0.0) importance[i] = 1.0 / covariance(i, i);
  return covariance * importance.asDiagonal() * covariance;
}

/// Coefficients of the displacement of the first of two strips against the second: a constant (3),
/// changes with the time of either strip (3 each), and the ranging share.
using Displacement = Eigen::Matrix<double, 10, 1>;

/// Normal equations of the displacement from pairs: N d = h.
struct DisplacementEquations {
  Eigen::Matrix<double, 10, 10> normal = Eigen::Matrix<double, 10, 10>::Zero();
  Displacement right = Displacement::Zero();

  void add(const Displacement& row, double weight, double residual) {
    normal += weight * row * row.transpose();
    right += weight * residual * row;
  }
};

/// The displacement that makes the residual sums of \a part equal to those of \a all.
Displacement displacementFor(const DisplacementEquations& all, DisplacementEquations part) {
  // Level ground does not determine horizontal displacements, which have no effect there. Changes
  // with time from few pairs are mostly noise and are damped.
  constexpr double kNothing = 1e-9, kLittle = 1e-3;
  const double trace = part.normal.topLeftCorner<3, 3>().trace();
  part.normal.diagonal().array() += kNothing * trace;
  part.normal.diagonal().segment<6>(3).array() += kLittle * trace;
  return solveSymmetric(part.normal, all.right - part.right);
}

}  // namespace

PairSelection::PairSelection(const std::vector<AreaObservations>& observations,
                             const std::vector<std::vector<double>>& weights,
                             const Adjustment& adjustment, const AdjustmentSolution& solution,
                             const PairSelectionSettings& settings)
    : settings_(settings), chosen_(observations.size()) {
  std::vector<Group> groups;
  for (std::size_t area = 0; area < observations.size(); ++area) {
    for (Group& group : groupsOf(area, observations[area], weights[area], adjustment, solution))
      groups.push_back(std::move(group));
  }
  spreadEvenly(groups);
  spendOnInfluence(groups);
  takeMembers(groups);
}

std::vector<PairSelection::Group> PairSelection::groupsOf(std::size_t area,
                                                          const AreaObservations& observations,
                                                          const std::vector<double>& weights,
                                                          const Adjustment& adjustment,
                                                          const AdjustmentSolution& solution) {
  const SystemMatrix worth = effectOfRows(solution.covariance);
  std::map<std::array<int, 3>, Group> here;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const PairObservation& o = observations[i];
    if (o.a == PairObservation::kControl) chosen_[area].push_back({i});
    if (o.a == PairObservation::kControl || weights[i] == 0.0) continue;
    const auto orientation = static_cast<int>(OrientationClasses::of(o.normal));
    Group& group = here[{std::min(o.surfaceA(), o.surfaceB()), std::max(o.surfaceA(), o.surfaceB()),
                         orientation}];
    const double weight = weights[i] / o.variance, sign = o.sign();
    const SystemRow row = adjustment.reducedRow(o);
    group.influence +=
        weight / o.variance_inflation * (row * worth * row.transpose()).value();  // w^2 v
    const Eigen::Array2d times(sign > 0.0 ? o.time_a : o.time_b, sign > 0.0 ? o.time_b : o.time_a);
    group.members.push_back({i, o.normal, sign * o.sources[indexOf(ErrorSource::slope_ranging)],
                             weight, sign * adjustment.residual(o, solution), times, sign});
  }
  std::vector<Group> groups;
  for (auto& [key, group] : here) {
    group.area = area;
    group.strips = {key[0], key[1]};
    group.influence = std::sqrt(group.influence / static_cast<double>(group.members.size()));
    groups.push_back(std::move(group));
  }
  return groups;
}

PairSelection::StripsInAreas PairSelection::stripsInAreas(const std::vector<Group>& groups) {
  StripsInAreas strips_in_areas;
  for (std::size_t g = 0; g < groups.size(); ++g)
    strips_in_areas[{groups[g].area, groups[g].strips}].push_back(g);
  return strips_in_areas;
}

void PairSelection::spreadEvenly(std::vector<Group>& groups) const {
  const StripsInAreas strips_in_areas = stripsInAreas(groups);
  const double each = settings_.spread * static_cast<double>(settings_.budget) /
                      std::max<double>(1.0, static_cast<double>(strips_in_areas.size()));
  for (const auto& [where, members] : strips_in_areas) {
    std::vector<double> sizes;
    for (const std::size_t g : members) {
      sizes.push_back(static_cast<double>(groups[g].members.size()));
    }
    const std::vector<double> shares = evenShares(sizes, each);
    for (std::size_t i = 0; i < members.size(); ++i)
      groups[members[i]].least = std::max(1.0, static_cast<double>(shares[i]));
  }
}

void PairSelection::spendOnInfluence(std::vector<Group>& groups) const {
  double available = 0.0;
  for (Group& group : groups) available += group.number = static_cast<double>(group.members.size());
  const auto budget = static_cast<double>(settings_.budget);
  if (available <= budget) return;
  const auto numberAt = [](const Group& group, double factor) {
    const auto size = static_cast<double>(group.members.size());
    return std::clamp(factor * size * group.influence, group.least, size);
  };
  double low = -80.0, high = 80.0;  // logarithm of the factor
  constexpr int kHalvings = 60;
  for (int halving = 0; halving < kHalvings; ++halving) {
    const double middle = 0.5 * (low + high);
    double total = 0.0;
    for (const Group& group : groups) total += numberAt(group, std::exp(middle));
    (total > budget ? high : low) = middle;
  }
  for (Group& group : groups) group.number = numberAt(group, std::exp(low));
}

void PairSelection::takeMembers(std::vector<Group>& groups) {
  double carried = 0.0;  // fractions of pairs, carried from group to group to keep the sum
  for (Group& group : groups) {
    const std::size_t size = group.members.size();
    const double wanted = std::max(1.0, group.number + carried);
    const auto taken = std::min(size, static_cast<std::size_t>(wanted));
    carried = std::clamp(group.number + carried - static_cast<double>(taken), -1.0, 1.0);
    for (std::size_t k = 0; k < taken; ++k) group.taken.push_back(group.members[k * size / taken]);
  }
  for (const auto& [where, members] : stripsInAreas(groups)) {
    std::vector<const Group*> groups_of_strips;
    for (const std::size_t g : members) groups_of_strips.push_back(&groups[g]);
    setOffsets(groups_of_strips);
  }
  for (auto& pairs : chosen_) {
    std::sort(pairs.begin(), pairs.end(),
              [](const ChosenPair& a, const ChosenPair& b) { return a.index < b.index; });
  }
}

void PairSelection::setOffsets(const std::vector<const Group*>& groups_of_strips) {
  const Eigen::Array2d start = groups_of_strips.front()->members.front().times;
  const auto rowOf = [&start](const Group::Member& member) {
    const Eigen::Array2d time = member.times - start;
    Displacement row;
    row << member.normal, time[0] * member.normal, time[1] * member.normal, member.stretch;
    return row;
  };
  DisplacementEquations all, part;
  std::vector<double> factors;
  for (const Group* group : groups_of_strips) {
    double whole = 0.0, taken = 0.0;
    for (const Group::Member& member : group->members) {
      all.add(rowOf(member), member.weight, member.residual);
      whole += member.weight;
    }
    for (const Group::Member& member : group->taken) taken += member.weight;
    factors.push_back(whole / taken);
    for (const Group::Member& member : group->taken)
      part.add(rowOf(member), factors.back() * member.weight, member.residual);
  }
  const Displacement move = displacementFor(all, part);
  for (std::size_t g = 0; g < groups_of_strips.size(); ++g) {
    for (const Group::Member& member : groups_of_strips[g]->taken)
      chosen_[groups_of_strips[g]->area].push_back(
          {member.index, factors[g], member.sign * rowOf(member).dot(move)});
  }
}

std::size_t PairSelection::chosenCount() const {
  std::size_t count = 0;
  for (const auto& pairs : chosen_) count += pairs.size();
  return count;
}

}  // namespace pcl_als
