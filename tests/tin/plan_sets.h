// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tin_verifier.h"

namespace pcl_als::test {

/// A named set of plan positions (whole millimetres) that has broken, or could break, a TIN.
struct PlanSet {
  std::string name;
  std::vector<LatticePoint> points;
};

/// Each small enough for the verifier (a few thousand points at most).
std::vector<PlanSet> nastyPlanSets();

std::vector<LatticePoint> randomPlan(int count, std::int64_t size, unsigned seed);
/// Lines of an oscillating mirror: \a lines zigzags of \a per_line points, almost collinear.
std::vector<LatticePoint> scanLines(int lines, int per_line, unsigned seed);
std::vector<LatticePoint> grid(int columns, int rows, std::int64_t spacing);

}  // namespace pcl_als::test
