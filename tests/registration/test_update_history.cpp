// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include "update_history.h"

namespace pcl_als {
namespace {

using registration::UpdateHistory;

TEST(UpdateHistory, SteadyConvergenceIsNeverStalled) {
  UpdateHistory history;
  for (double update = 1.0; update > 1e-9; update *= 0.69) EXPECT_FALSE(history.stalled(update));
}

/// 2026-11-22: a cycle of three updates of some millimetres ended no stage of ICPatch and no
/// iteration: 27 of 106 real pairs did not converge.
TEST(UpdateHistory, ACycleIsStalledAtItsThirdUpdateWithoutProgress) {
  const double cycle[] = {0.009, 0.007, 0.011};
  UpdateHistory history;
  int updates = 0;
  while (!history.stalled(cycle[updates % 3])) ASSERT_LT(++updates, 10);
  EXPECT_EQ(updates, 3);  // the first is the best so far, three more are no progress
}

TEST(UpdateHistory, ProgressStartsTheCountAgain) {
  UpdateHistory history;
  EXPECT_FALSE(history.stalled(1.0));
  EXPECT_FALSE(history.stalled(0.9));
  EXPECT_FALSE(history.stalled(0.8));
  EXPECT_FALSE(history.stalled(0.5));  // less than 0.7 of the smallest
  EXPECT_FALSE(history.stalled(0.5));
  EXPECT_FALSE(history.stalled(0.5));
  EXPECT_TRUE(history.stalled(0.5));
}

/// Whatever the pairs do, the damped iteration ends: each stalled update halves the step.
TEST(UpdateHistory, ACycleNeverCountsAsProgress) {
  UpdateHistory history;
  int stalled = 0;
  for (int i = 0; i < 50; ++i) stalled += history.stalled(0.01 * (1.0 + 0.3 * std::sin(i))) ? 1 : 0;
  EXPECT_GE(stalled, 45);
}

}  // namespace
}  // namespace pcl_als
