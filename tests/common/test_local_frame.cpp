// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/local_frame.h>

namespace pcl_als {
namespace {

// As pcl::PCDWriter keeps the VIEWPOINT of a header: a float, printed by an ostream's default six
// digits, read back as a float.
double throughViewpoint(double value) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.6g", static_cast<double>(static_cast<float>(value)));
  return static_cast<double>(std::strtof(text, nullptr));
}

TEST(LocalFrame, OriginIsTheNearestMultipleOfTenMetres) {
  const LocalFrame frame = LocalFrame::around({583394.4, 5283105.1, -498.2}, "EPSG:25832");
  EXPECT_EQ(frame.origin, Eigen::Vector3d(583390.0, 5283110.0, -500.0));
  EXPECT_EQ(frame.crs, "EPSG:25832");
}

TEST(LocalFrame, MultiplesOfTenMetresSurviveAPcdHeader) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-9999990.0, 9999990.0);
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d ground(coordinate(random), coordinate(random), coordinate(random));
    const LocalFrame frame = LocalFrame::around(ground);
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(throughViewpoint(frame.origin[axis]), frame.origin[axis]);
  }
}

TEST(LocalFrame, OtherOriginsWouldNotSurvive) {
  EXPECT_NE(throughViewpoint(5283105.0), 5283105.0);
  EXPECT_NE(throughViewpoint(12345670.0), 12345670.0);  // beyond 10 000 km: eight digits
}

TEST(LocalFrame, RoundTripWithinReachIsUnderAQuarterMillimetre) {
  const LocalFrame frame = LocalFrame::around({583394.0, 5283100.0, 498.0});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> offset(-LocalFrame::kMaximumExtent,
                                                LocalFrame::kMaximumExtent);
  for (int i = 0; i < 10000; ++i) {
    const Eigen::Vector3d ground =
        frame.origin + Eigen::Vector3d(offset(random), offset(random), offset(random));
    const Eigen::Vector3d error = frame.toGround(frame.toLocal(ground)) - ground;
    // Half a float step at 2048 … 4096 m is 0.12 mm.
    ASSERT_LE(error.cwiseAbs().maxCoeff(), 0.000125);
  }
}

TEST(LocalFrame, RawFloatsWouldBeHalfAMetreOff) {
  const double northing = 5283100.2;
  EXPECT_GT(std::abs(static_cast<double>(static_cast<float>(northing)) - northing), 0.1);
}

}  // namespace
}  // namespace pcl_als
