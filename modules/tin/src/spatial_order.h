// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include "plan_predicates.h"

namespace pcl_als::tin {

/// Position along the Morton (Z) curve: even bits from x, odd bits from y.
std::uint64_t mortonCode(PlanPoint p);
PlanPoint planPointOf(std::uint64_t code);  ///< the inverse

/** \brief The distinct plan positions in Morton order: neighbours in plan are mostly neighbours in
 * memory, and the codes are a quadtree that the triangulation divides along. */
struct SpatialOrder {
  std::vector<std::uint64_t> code;  ///< ascending and distinct
  std::vector<std::int32_t> point;  ///< input index of each; the first of those that coincide
};

/// \param codes Morton codes in input order. Linear time; working memory 16 bytes per point.
SpatialOrder spatialOrder(const std::vector<std::uint64_t>& codes);

}  // namespace pcl_als::tin
