// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/radiometry/reference_targets.h>

namespace pcl_als {
namespace {

TEST(ReferenceCalibration, ConstantByHand) {
  // Medians 1000 and 2400 over reflectances 0.1 and 0.25: 10000 and 9600, equally certain:
  // geometric mean 9797.96, off by 2.06 and -2.02 %.
  ReferenceCalibration calibration(
      {{"dark", 10.0, 10.0, 0.1, 0.0}, {"bright", 50.0, 10.0, 0.25, 0.0}}, 2.0);
  for (const double value : {990.0, 1000.0, 1010.0}) calibration.add(10.5, 9.5, value);
  for (const double value : {2376.0, 2400.0, 2424.0}) calibration.add(50.0, 11.5, value);
  calibration.add(30.0, 10.0, 77777.0);  // belongs to none
  const ReferenceResult result = calibration.solve();
  EXPECT_NEAR(result.constant, 9797.96, 0.01);
  EXPECT_NEAR(result.targets[0].measured, 1000.0 / 9797.96, 1e-6);
  EXPECT_NEAR(result.relative_rms, 0.0204, 1e-4);
  EXPECT_EQ(result.targets[1].points, 3U);
}

TEST(ReferenceCalibration, StandardDeviationCovers) {
  // Targets whose stated reflectance is off by 3 % (and says so): 200 draws of 4 targets.
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 1.0);
  double squares = 0.0;
  for (int draw = 0; draw < 200; ++draw) {
    std::vector<ReferenceTarget> targets;
    for (int i = 0; i < 4; ++i) {
      const double truth = 0.1 + 0.1 * i;
      targets.push_back({"t", 10.0 * i, 0.0, truth * (1.0 + 0.03 * normal(random)), 0.03 * truth});
    }
    ReferenceCalibration calibration(targets, 1.0);
    for (int i = 0; i < 4; ++i)
      for (int k = 0; k < 20; ++k)
        calibration.add(10.0 * i, 0.0, 5000.0 * (0.1 + 0.1 * i) * (1.0 + 0.05 * normal(random)));
    const ReferenceResult result = calibration.solve();
    squares += std::pow((result.constant / 5000.0 - 1.0) / result.relative_std, 2);
  }
  // RMS of 200 normalised errors: 1 +- 0.05; the inflation for excess scatter lowers it somewhat.
  EXPECT_NEAR(std::sqrt(squares / 200.0), 0.95, 0.2);
}

TEST(ReferenceCalibration, TooFewPointsAndASingleTargetAreSaid) {
  ReferenceCalibration calibration({{"a", 0.0, 0.0, 0.2, 0.0}, {"b", 9.0, 0.0, 0.2, 0.0}}, 1.0);
  for (int i = 0; i < 3; ++i) calibration.add(0.0, 0.0, 100.0 + i);
  calibration.add(9.0, 0.0, 5000.0);
  const ReferenceResult result = calibration.solve();
  EXPECT_NEAR(result.constant, 505.0, 1e-9);
  EXPECT_FALSE(result.targets[1].used);
  EXPECT_EQ(result.warnings.size(), 2U);
  EXPECT_EQ(ReferenceCalibration({{"a", 0.0, 0.0, 0.2, 0.0}}, 1.0).solve().constant, 0.0);
}

TEST(ReferenceCalibration, RefusesWhatIsNoReflectance) {
  EXPECT_THROW(ReferenceCalibration({}, 1.0), UsageError);
  EXPECT_THROW(ReferenceCalibration({{"a", 0.0, 0.0, 0.0, 0.0}}, 1.0), UsageError);
  EXPECT_THROW(ReferenceCalibration({{"a", 0.0, 0.0, 25.0, 0.0}}, 1.0), UsageError);
  EXPECT_THROW(ReferenceCalibration({{"a", 0.0, 0.0, 0.5, 0.0}}, 0.0), UsageError);
}

}  // namespace
}  // namespace pcl_als
