// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "system_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <pcl_als/common/errors.h>

namespace pcl_als {
namespace {

constexpr double kOffsetLimit = 0.1;  // metres, each axis

/// The group of a strip: by its id, else by that of its pass; -1: none.
int groupOf(const std::vector<StripGroup>& groups, const std::string& id) {
  for (const std::string& name : {id, passOfStrip(id)}) {
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const std::vector<std::string>& strips = groups[i].strips;
      if (std::find(strips.begin(), strips.end(), name) != strips.end()) return static_cast<int>(i);
    }
  }
  return -1;
}

void checkGroups(const std::vector<StripGroup>& groups, const std::vector<std::string>& ids) {
  std::set<std::string> names, known(ids.begin(), ids.end());
  for (const std::string& id : ids) known.insert(passOfStrip(id));
  std::map<std::string, std::string> owner;
  for (const StripGroup& group : groups) {
    if (!names.insert(group.name).second)
      throw UsageError("two systems have the name " + group.name);
    if (group.strips.empty()) throw UsageError("system " + group.name + " has no strip");
    for (const std::string& strip : group.strips) {
      if (known.count(strip) == 0)
        throw UsageError("system " + group.name + ": there is no strip " + strip);
      const auto [at, is_new] = owner.try_emplace(strip, group.name);
      if (!is_new)
        throw UsageError("strip " + strip + " belongs to the systems " + at->second + " and " +
                         group.name);
    }
  }
}

/// Whether half of the shorter of two spans, or more, belongs to the other as well.
bool areSimultaneous(const TimeSpan& a, const TimeSpan& b) {
  const double common = std::min(a.second, b.second) - std::max(a.first, b.first);
  const double shorter = std::min(a.second - a.first, b.second - b.first);
  return shorter > 0.0 && common >= 0.5 * shorter;
}

double limitOf(int unknown, const DeterminationLimits& limits) {
  return unknown < kSystemParameterCount ? limits.of(static_cast<SystemParameter>(unknown))
                                         : kOffsetLimit;
}

}  // namespace

std::vector<int> passesOf(const std::vector<std::string>& ids, const std::vector<TimeSpan>& flown) {
  std::vector<int> passes;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    std::size_t first = 0;
    while (first < i && passOfStrip(ids[i]) != passOfStrip(ids[first]) &&
           !areSimultaneous(flown[i], flown[first]))
      ++first;
    passes.push_back(first < i ? passes[first] : static_cast<int>(i));
  }
  return passes;
}

StripSystems stripSystems(const std::vector<StripGroup>& groups, const PerSystemParameters& own,
                          const std::vector<std::string>& ids, std::vector<int> pass) {
  checkGroups(groups, ids);
  StripSystems systems;
  systems.own = own;
  systems.count = std::max(1, static_cast<int>(groups.size()));
  systems.pass = std::move(pass);
  for (const std::string& id : ids) systems.system.push_back(std::max(0, groupOf(groups, id)));
  return systems;
}

std::vector<SystemUnknowns> systemDifferences(const SharedErrors& errors,
                                              const Eigen::VectorXd& shared) {
  std::vector<SystemUnknowns> differences(static_cast<std::size_t>(errors.systems().count),
                                          SystemUnknowns::Zero());
  for (std::size_t i = 1; i < differences.size(); ++i) {
    const Eigen::Index at =
        Eigen::Index{errors.systemBlock(static_cast<int>(i))} * SharedErrors::kPerKnot;
    differences[i] = shared.segment<kSystemUnknownCount>(at);
  }
  return differences;
}

double effectOfSystems(const StripSystems& systems, const std::vector<SystemUnknowns>& differences,
                       const PairObservation& o) {
  if (differences.size() < 2) return 0.0;
  const auto of = [&](int strip) -> const SystemUnknowns& {
    return differences[static_cast<std::size_t>(systems.of(strip))];
  };
  const double at_patch = -o.effectAtPatch(of(o.b));
  return o.a == PairObservation::kControl ? at_patch : at_patch + o.effectAtPoint(of(o.a));
}

bool shareUndetermined(const Adjustment& adjustment, const ParameterChoice& choice,
                       const DeterminationLimits& limits, SharedErrors& errors) {
  bool found = false;
  for (int system = 1; system < errors.systems().count; ++system) {
    const Adjustment::SystemSolution solution =
        adjustment.systemSolution(system, choice.estimate, choice.solution);
    int worst = -1;
    double excess = 1.0;
    for (int i = 0; i < kSystemUnknownCount; ++i) {
      const double ratio = solution.difference_std[i] / limitOf(i, limits);
      if (!errors.isOwn(system, i) || ratio <= excess) continue;
      worst = i;
      excess = ratio;
    }
    if (worst < 0) continue;
    errors.share(system, worst);
    found = true;
  }
  return found;
}

void addSystems(const Adjustment& adjustment, const SharedErrors& errors,
                const ParameterChoice& choice, const std::vector<StripGroup>& groups,
                const std::vector<std::string>& ids, CalibrationResult& result) {
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const int system = static_cast<int>(k);
    SystemEstimate& estimate = result.systems.emplace_back();
    estimate.group.name = groups[k].name;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (errors.systems().of(static_cast<int>(i)) == system)
        estimate.group.strips.push_back(ids[i]);
    }
    estimate.parameters = result.parameters;
    if (system == 0) continue;
    const Adjustment::SystemSolution solution =
        adjustment.systemSolution(system, choice.estimate, choice.solution);
    for (const SystemParameterInfo& info : systemParameters()) {
      const int i = indexOf(info.parameter);
      if (!errors.isOwn(system, i)) continue;
      ParameterEstimate& p = estimate.parameters[static_cast<std::size_t>(i)];
      const bool relative = p.status != ParameterStatus::estimated;
      p.bias += solution.difference[i];
      p.std = solution.std[i];
      estimate.difference_std[i] = solution.difference_std[i];
      p.std_formal = 0.0;
      p.status = ParameterStatus::estimated;
      p.reason = relative ? "relative to system " + groups.front().name : "";
    }
    for (int axis = 0; axis < 3; ++axis) {
      const int i = kSystemParameterCount + axis;
      if (!errors.isOwn(system, i)) continue;
      estimate.offset[axis] = solution.difference[i];
      estimate.offset_std[axis] = solution.std[i];
    }
  }
}

std::vector<SystemUnknowns> statedDifferences(const CalibrationResult& result,
                                              const StripSystems& systems,
                                              std::vector<SystemUnknowns> solved) {
  for (std::size_t k = 0; k < systems.held.size(); ++k)
    if (systems.held[k].flown) solved[static_cast<std::size_t>(systems.heldSystem(k))].setZero();
  for (std::size_t i = 1; i < result.systems.size(); ++i)
    solved[i] = result.systems[i].values() - result.systems.front().values();
  return solved;
}

}  // namespace pcl_als
