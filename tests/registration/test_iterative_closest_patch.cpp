// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/iterative_closest_patch.h>

#include "cloud_support.h"
#include "strip_pairs.h"

namespace pcl_als {
namespace {

using Eigen::Vector3d;
using Icpatch = IterativeClosestPatch<PointLidar, PointLidar, double>;
using Points = std::vector<Vector3d>;

constexpr int kPoints = 50'000;  // two for each square metre

PatchAlignmentResult align(const Points& source, const Points& target, Icpatch& icpatch) {
  pcl::PointCloud<PointLidar> aligned;
  icpatch.setInputSource(test::cloudOf<PointLidar>(source));
  icpatch.setInputTarget(test::cloudOf<PointLidar>(target));
  icpatch.align(aligned);
  return icpatch.getResult();
}

/// Error of each parameter over its reported standard deviation.
Eigen::Matrix<double, 6, 1> deviations(const PatchAlignmentResult& result,
                                       const Eigen::Affine3d& truth) {
  const RigidMotion motion = RigidMotion::about(result.motion.centroid, truth);
  Eigen::Matrix<double, 6, 1> values;
  for (int p = 0; p < 3; ++p) {
    values[p] = (result.motion.shift - motion.shift)[p] / result.standardDeviation(p);
    values[p + 3] = (result.motion.rotation - motion.rotation)[p] / result.standardDeviation(p + 3);
  }
  return values;
}

/// 50 pairs of strips, each over a scene of its own, 0.02 to 5 m and up to 0.5 degrees apart. Of
/// 300 errors over their standard deviation 5 % may exceed 1.96; with a binomial bound of four
/// deviations 30 do. Too large an uncertainty would make them too small: their RMS is 1, to 0.04
/// with 300, and some leeway for the jackknife's own scatter.
TEST(IterativeClosestPatch, FindsKnownMotionsWithinItsUncertainty) {
  int beyond = 0;
  double squares = 0.0, worst = 0.0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const double shift = 0.02 * std::pow(250.0, seed / 49.0);
    const Eigen::Affine3d truth = test::randomMotion(shift, 0.5, seed);
    const Points target = test::stripPoints({}, seed, 1000 + seed, kPoints);
    const Points source =
        test::moved(test::stripPoints({}, seed, 2000 + seed, kPoints), truth.inverse());
    Icpatch icpatch;
    const PatchAlignmentResult result = align(source, target, icpatch);
    ASSERT_TRUE(icpatch.hasConverged()) << seed << result.message;
    ASSERT_TRUE(result.allDetermined()) << seed << result.message;
    const auto values = deviations(result, truth);
    PatchAlignmentResult start = result;
    start.motion = RigidMotion::about(result.motion.centroid, Eigen::Affine3d::Identity());
    EXPECT_GT(deviations(start, truth).norm(), 10.0) << seed;
    for (int p = 0; p < 6; ++p) beyond += std::abs(values[p]) > 1.96 ? 1 : 0;
    squares += values.squaredNorm();
    worst = std::max(worst, values.lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE(beyond, 30);
  EXPECT_NEAR(std::sqrt(squares / 300.0), 1.0, 0.2);
  EXPECT_LT(worst, 5.0);
}

}  // namespace
}  // namespace pcl_als
