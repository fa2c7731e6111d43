// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/registration/patch_alignment.h>

#include "swath_scenes.h"

namespace pcl_als {
namespace {

using test::Flight;
using test::fly;
using test::kOrigin;
using test::village;

TEST(StripAlignment, MovesAOntoB) {
  Flight first, other;
  first.noise = other.noise = 0.01;
  other.seed = 2;
  other.shift = {0.30, -0.20, 0.10};
  const auto a = fly(village, first, kOrigin), b = fly(village, other, kOrigin);
  std::vector<AreaOffsets> areas;
  for (const double x : {0.0, 30.0}) {
    areas.emplace_back(SurveyArea{kOrigin.head<2>() + Eigen::Vector2d(x, 0.0), 30.0, 5.0},
                       std::size_t{2});
    areas.emplace_back(SurveyArea{kOrigin.head<2>() + Eigen::Vector2d(x, 30.0), 30.0, 5.0},
                       std::size_t{2});
  }
  for (AreaOffsets& area : areas) {
    for (const LidarReturn& point : a) area.add(0, point);
    for (const LidarReturn& point : b) area.add(1, point);
  }
  const PatchAlignmentResult found = registerStrips(areas, 0, 1, {});
  ASSERT_TRUE(found.hasConverged()) << found.message;
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(found.parameters[static_cast<std::size_t>(i)].determined) << i;
    EXPECT_NEAR(found.motion.shift[i], other.shift[i], 5.0 * found.standardDeviation(i) + 0.002)
        << i;
  }
  EXPECT_NEAR(found.motion.centroid.x(), kOrigin.x() + 30.0, 12.0);
}

TEST(StripAlignment, NothingInCommonIsAStatus) {
  std::vector<AreaOffsets> areas;
  areas.emplace_back(SurveyArea{kOrigin.head<2>(), 50.0, 5.0}, std::size_t{2});
  for (const LidarReturn& point : fly(village, {}, kOrigin)) areas[0].add(0, point);
  EXPECT_FALSE(registerStrips(areas, 0, 1, {}).hasConverged());
  // Two sparse strips of 1900 m2 in common were said not to overlap.
  EXPECT_NE(registerStrips(areas, 0, 1, {}).message.find("enough points of both strips"),
            std::string::npos);
  EXPECT_FALSE(registerStrips({}, 0, 1, {}).hasConverged());
}

PairMotion motion(const std::string& a, const std::string& b, const Eigen::Vector3d& shift,
                  const Eigen::Vector3d& rotation, const Eigen::Vector3d& centroid) {
  PairMotion pair{a, b, {}};
  pair.result.status = PatchAlignmentResult::Status::converged;
  for (auto& parameter : pair.result.parameters) parameter.determined = true;
  pair.result.motion.shift = shift;
  pair.result.motion.rotation = rotation;
  pair.result.motion.centroid = centroid;
  pair.result.covariance.diagonal() << 1e-6, 1e-6, 1e-6, 1e-12, 1e-12, 1e-12;
  return pair;
}

// a -> b tilts about the north axis by 1e-4 about x = 0: at x = 200 it is 2 cm lower there.
TEST(StripAlignment, MotionsCloseAtACommonPlace) {
  const Eigen::Vector3d far(600.0, 0.0, 0.0), zero = Eigen::Vector3d::Zero();
  const auto closed = closeMotions({motion("1", "2", zero, {0.0, 1e-4, 0.0}, zero),
                                    motion("2", "3", {0.0, 0.0, 0.01}, zero, far),
                                    motion("3", "1", {0.0, 0.0, 0.01}, zero, zero)});
  ASSERT_EQ(closed.size(), 1U);
  // Middle of the centroids: x = 200; -0.02 + 0.01 + 0.01.
  EXPECT_NEAR(closed[0].closure.z(), 0.0, 1e-6);
  // 1 mm each; rotations of 1e-6 over 200, 400 and 200 m add 0.2, 0.4 and 0.2 mm.
  EXPECT_NEAR(closed[0].std.z(), 1e-3 * std::sqrt(3.0 + 0.04 + 0.16 + 0.04), 1e-6);
  auto undetermined = motion("3", "1", zero, zero, zero);
  undetermined.result.parameters[5].determined = false;
  EXPECT_TRUE(closeMotions({motion("1", "2", zero, zero, zero), motion("2", "3", zero, zero, zero),
                            undetermined})
                  .empty());
}

}  // namespace
}  // namespace pcl_als
