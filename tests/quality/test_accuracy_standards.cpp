// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/quality/accuracy_standards.h>

namespace pcl_als {
namespace {

// Table 2 of the specification: RMSDz of 4, 8, 8, 16 cm for QL0, 1, 2, 3; the limit itself passes.
TEST(AccuracyStandards, SwathsAreJudgedByTable2) {
  EXPECT_EQ(swathQualityLevel(0.04), 0);
  EXPECT_EQ(swathQualityLevel(0.0401), 1);
  EXPECT_EQ(swathQualityLevel(0.08), 1);
  EXPECT_EQ(swathQualityLevel(0.0801), 3);
  EXPECT_EQ(swathQualityLevel(0.16), 3);
  EXPECT_FALSE(swathQualityLevel(0.1601));
  EXPECT_FALSE(swathQualityLevel(std::numeric_limits<double>::quiet_NaN()));
}

// Table 4: RMSEz of 5, 10, 10, 20 cm.
TEST(AccuracyStandards, HeightsAreJudgedByTable4) {
  EXPECT_EQ(absoluteQualityLevel(0.05), 0);
  EXPECT_EQ(absoluteQualityLevel(0.09), 1);
  EXPECT_EQ(absoluteQualityLevel(0.19), 3);
  EXPECT_FALSE(absoluteQualityLevel(0.21));
}

TEST(AccuracyStandards, SurveyErrorIsPartOfEdition2) {
  const VerticalAccuracy accuracy = verticalAccuracy(0.06, 0.025, 30);
  EXPECT_NEAR(accuracy.rmse_v, 0.065, 1e-12);   // sqrt(36 + 6.25) cm
  EXPECT_EQ(accuracy.class_cm, 7.0);            // the next whole centimetre
  EXPECT_NEAR(accuracy.nva_95, 0.1176, 1e-12);  // 1.96 * 6 cm, without it
  EXPECT_TRUE(accuracy.enough_points);
  EXPECT_FALSE(verticalAccuracy(0.06, 0.025, 29).enough_points);
  EXPECT_EQ(verticalAccuracy(0.05, 0.0, 30).class_cm, 5.0);  // 5 cm exactly is class 5
}

TEST(AccuracyStandards, ImagesHaveTwiceTheCellOfTheElevationModel) {
  for (const QualityLevelLimits& level : qualityLevels())
    EXPECT_EQ(level.separation_image_cell, level.level < 2 ? 1.0 : level.level == 2 ? 2.0 : 4.0);
}

}  // namespace
}  // namespace pcl_als
