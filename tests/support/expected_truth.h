// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <gtest/gtest.h>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als::test {

/// All estimates are within four standard deviations (a chance of 1e-4 each).
inline void expectTruth(const CalibrationResult& result, const SystemVector& truth) {
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& p = result[info.parameter];
    if (p.status != ParameterStatus::estimated) continue;
    EXPECT_NEAR(p.bias, truth[indexOf(info.parameter)], 4.0 * p.std) << info.name;
  }
}

}  // namespace pcl_als::test
