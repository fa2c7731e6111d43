// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include "block_estimate.h"

namespace pcl_als {
namespace {

/// Calls \a visit with observations of the whole block, of which these are enough for its extent.
template <class Visit>
void visitSome(const PairSet& pairs, const Visit& visit) {
  constexpr std::size_t kSampledPairs = 20'000;
  std::size_t first = 0;
  const std::size_t every = std::max<std::size_t>(1, pairs.count() / kSampledPairs);
  for (const AreaObservations& area : pairs.observations) {
    for (; first < area.size(); first += every) visit(area[first]);
    first -= area.size();
  }
}

/// Upper bound of the movement of a ground point by a change of the biases, metres: the sum of the
/// effects of all parameters.
double largestEffect(const PairSet& pairs, const SystemVector& change) {
  double x = 0.0, z = 0.0;
  visitSome(pairs, [&](const PairObservation& o) {
    x = std::max<double>(x, o.lateral);
    z = std::max<double>(z, o.height);
  });
  ScanGeometry geometry;
  geometry.x = x;
  geometry.z = -z;
  geometry.beta = -std::atan2(x, z);
  return (designBlock(geometry).cwiseAbs() * change.cwiseAbs()).maxCoeff();
}

/// Movement of a ground point by a change of the biases, metres: the largest of the points that
/// were observed, on either side of the flight line. Changes that compensate each other move no
/// point.
double largestMovement(const PairSet& pairs, const SystemVector& change) {
  double largest = 0.0;
  visitSome(pairs, [&](const PairObservation& o) {
    for (const double x : {double{o.lateral}, -double{o.lateral}}) {
      ScanGeometry geometry;
      geometry.x = x;
      geometry.z = -o.height;
      geometry.beta = -std::atan2(x, o.height);
      largest = std::max(largest, (designBlock(geometry) * change).norm());
    }
  });
  return largest;
}

/// Change of the distances by a change of the error sources, metres.
double largestEffectOfSources(const PairSet& pairs, const ErrorSourceVector& change) {
  double largest = 0.0;
  if (change.isZero(0.0)) return largest;
  for (const AreaObservations& area : pairs.observations)
    for (const PairObservation& o : area)
      largest = std::max(largest, std::abs(o.effectOfSources(change)));
  return largest;
}

/// The same of a change of the differences between systems.
double largestEffectOfSystems(const PairSet& pairs, const std::vector<SystemUnknowns>& before,
                              const std::vector<SystemUnknowns>& after) {
  double largest = 0.0;
  for (std::size_t i = 1; i < after.size(); ++i) {
    const SystemUnknowns change = after[i] - before[i];
    largest = std::max(largest, largestMovement(pairs, change.head<kSystemParameterCount>()) +
                                    change.tail<3>().norm());
  }
  return largest;
}

}  // namespace

IterationMovement movementOf(const PairSet& pairs, const Corrections& before,
                             const Corrections& after) {
  IterationMovement movement;
  movement.of_systems = largestEffectOfSystems(pairs, before.differences, after.differences);
  movement.effect = largestEffect(pairs, after.biases - before.biases) + movement.of_systems;
  movement.largest =
      std::max({largestMovement(pairs, after.biases - before.biases), movement.of_systems,
                largestEffectOfSources(pairs, after.sources - before.sources)});
  return movement;
}

}  // namespace pcl_als
