// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include "plan_predicates.h"

namespace pcl_als::tin {

/** \brief The distinct plan positions in Morton (Z) order: neighbours in plan are mostly neighbours
 * in memory, and the codes are a quadtree that the triangulation divides along. */
struct SpatialOrder {
  std::vector<std::uint64_t> code;  ///< ascending and distinct; even bits from x, odd bits from y
  std::vector<std::int32_t> point;  ///< input index of each; the first of those that coincide
};

SpatialOrder spatialOrder(const std::vector<PlanPoint>& points);

/// The position that a Morton code stands for.
PlanPoint planPointOf(std::uint64_t code);

}  // namespace pcl_als::tin
