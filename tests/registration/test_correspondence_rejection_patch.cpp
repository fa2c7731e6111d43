// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <limits>

#include <gtest/gtest.h>
#include <pcl/conversions.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>
#include <pcl_als/registration/correspondence_rejection_patch.h>

#include "cloud_support.h"
#include "surface_sets.h"

namespace pcl_als {
namespace {

using Estimation = CorrespondenceEstimationPointToPatch<PointLidar, PointLidar>;
using Eigen::Vector3d;

pcl::PointCloud<PointLidar>::Ptr scene(int count, double noise, unsigned seed) {
  return test::cloudOf<PointLidar>(test::scenePoints(count, noise, seed));
}

/// One correspondence for each point.
pcl::Correspondences all(std::size_t count) {
  pcl::Correspondences result;
  for (std::size_t i = 0; i < count; ++i) result.emplace_back(static_cast<int>(i), 0, 0.0F);
  return result;
}

/// A rejector with every limit out of the way.
CorrespondenceRejectorPatch permissive() {
  const double endless = std::numeric_limits<double>::infinity();
  CorrespondenceRejectorPatch rejector;
  rejector.setMaximumNormalDistance(endless);
  rejector.setMaximumEdgeLength(endless);
  rejector.setMaximumSlope(1.5707);
  rejector.setMaximumRoughness(endless);
  rejector.setMaximumBend(1.5707);
  rejector.setRejectBorder(false);
  return rejector;
}

/// How many of the points stay on the target.
std::size_t kept(CorrespondenceRejectorPatch& rejector, const std::vector<Vector3d>& target,
                 const std::vector<Vector3d>& source) {
  rejector.setInputTarget(*test::cloudOf<PointLidar>(target));
  rejector.setInputSource(*test::cloudOf<PointLidar>(source));
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(all(source.size()), remaining);
  EXPECT_EQ(remaining.size(), rejector.getResult().kept);
  return remaining.size();
}

const std::vector<Vector3d> kPlane = test::planePoints(0.0, 0.75, 10.0, 1.0);  // 36.87 degrees
const std::vector<Vector3d> kOnIt{{5.3, 5.4, 4.05}};

TEST(CorrespondenceRejectorPatch, KeepsAGoodPatch) {
  CorrespondenceRejectorPatch rejector;
  EXPECT_EQ(kept(rejector, kPlane, kOnIt), 1U);
}

TEST(CorrespondenceRejectorPatch, EachLimitByHand) {
  CorrespondenceRejectorPatch rejector = permissive();
  const std::vector<Vector3d> above{{5.3, 5.4, 4.05 + 0.5}};  // 0.4 m along the normal
  rejector.setMaximumNormalDistance(0.39);
  EXPECT_EQ(kept(rejector, kPlane, above), 0U);
  EXPECT_EQ(rejector.getResult().too_far, 1U);
  rejector.setMaximumNormalDistance(0.41);
  EXPECT_EQ(kept(rejector, kPlane, above), 1U);
  rejector.setMaximumEdgeLength(1.6);  // the diagonal is sqrt(1 + 1.25^2) = 1.6008 m
  EXPECT_EQ(kept(rejector, kPlane, kOnIt), 0U);
  EXPECT_EQ(rejector.getResult().unfit_patch, 1U);
  rejector.setMaximumEdgeLength(1.601);
  EXPECT_EQ(kept(rejector, kPlane, kOnIt), 1U);
  rejector.setMaximumSlope(0.643);  // atan(0.75) = 0.6435
  EXPECT_EQ(kept(rejector, kPlane, kOnIt), 0U);
  rejector.setMaximumSlope(0.644);
  EXPECT_EQ(kept(rejector, kPlane, kOnIt), 1U);
}

TEST(CorrespondenceRejectorPatch, RoughnessBendAndBorder) {
  std::vector<Vector3d> bumpy = test::planePoints(0.0, 0.0, 10.0, 1.0);
  for (std::size_t i = 0; i < bumpy.size(); i += 2) bumpy[i].z() = 0.2;
  const std::vector<Vector3d> ridge = [] {
    std::vector<Vector3d> points = test::planePoints(0.0, 0.0, 10.0, 1.0);
    for (Vector3d& p : points) p.z() = -0.5 * std::abs(p.x() - 5.0);
    return points;
  }();
  CorrespondenceRejectorPatch rejector = permissive();
  EXPECT_EQ(kept(rejector, bumpy, {{5.3, 5.4, 0.1}}), 1U);
  rejector.setMaximumRoughness(0.05);
  EXPECT_EQ(kept(rejector, bumpy, {{5.3, 5.4, 0.1}}), 0U);
  rejector = permissive();
  rejector.setMaximumBend(0.1);
  EXPECT_EQ(kept(rejector, ridge, {{5.3, 5.4, -0.15}, {2.3, 5.4, -1.35}}), 1U);
  rejector = permissive();
  EXPECT_EQ(kept(rejector, kPlane, {{0.3, 0.4, 0.3}}), 1U);
  rejector.setRejectBorder(true);
  EXPECT_EQ(kept(rejector, kPlane, {{0.3, 0.4, 0.3}}), 0U);
}

TEST(CorrespondenceRejectorPatch, ProjectionOutside) {
  CorrespondenceRejectorPatch rejector = permissive();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(kept(rejector, kPlane, {{-0.5, 5.0, 3.75}, {5.0, 11.0, 8.0}, {nan, 5.0, 3.75}}), 0U);
  EXPECT_EQ(rejector.getResult().without_patch, 3U);
}

TEST(CorrespondenceRejectorPatch, ProviderAndOwnSearchAgree) {
  const auto source = scene(6000, 0.05, 1), target = scene(6000, 0.05, 2);
  pcl::shared_ptr<Estimation> estimation(new Estimation);
  estimation->setInputSource(source);
  estimation->setInputTarget(target);
  pcl::Correspondences found, provided, searched;
  estimation->determineCorrespondences(found);
  CorrespondenceRejectorPatch with_provider, alone;
  with_provider.setMatchProvider(estimation);
  EXPECT_FALSE(with_provider.requiresSourcePoints() || with_provider.requiresTargetPoints());
  with_provider.getRemainingCorrespondences(found, provided);
  EXPECT_TRUE(alone.requiresSourcePoints() && alone.requiresTargetPoints());
  pcl::PCLPointCloud2::Ptr source_blob(new pcl::PCLPointCloud2);
  pcl::PCLPointCloud2::Ptr target_blob(new pcl::PCLPointCloud2);
  pcl::toPCLPointCloud2(*source, *source_blob);
  pcl::toPCLPointCloud2(*target, *target_blob);
  alone.setSourcePoints(source_blob);
  alone.setTargetPoints(target_blob);
  alone.getRemainingCorrespondences(found, searched);
  ASSERT_EQ(provided.size(), searched.size());
  EXPECT_GT(provided.size(), 1000U);
  EXPECT_LT(provided.size(), found.size());
  for (std::size_t i = 0; i < provided.size(); ++i)
    EXPECT_EQ(provided[i].index_query, searched[i].index_query);
}

TEST(CorrespondenceRejectorPatch, DropsWhatLiesOnWalls) {
  // Of points all over the scene those kept have heights of roof or ground, none of a wall.
  const std::vector<Vector3d> points = test::scenePoints(40000, 0.01, 3);
  std::vector<Vector3d> probes;
  for (double z = 1.5; z < 4.5; z += 0.1)
    for (double y = 11.0; y < 29.0; y += 0.3) probes.emplace_back(15.0, y, z);
  CorrespondenceRejectorPatch limits, none = permissive();
  EXPECT_LT(kept(limits, points, probes), probes.size() / 100);
  EXPECT_GT(kept(none, points, probes), probes.size() / 4);
}

TEST(CorrespondenceRejectorPatch, ResultCountsAddUp) {
  const auto source = scene(4000, 0.3, 4), target = scene(4000, 0.05, 5);
  CorrespondenceRejectorPatch rejector;
  rejector.setMaximumNormalDistance(0.2);
  rejector.setInputSource(*source);
  rejector.setInputTarget(*target);
  pcl::Correspondences correspondences = all(source->size());
  rejector.getRemainingCorrespondences(correspondences, correspondences);  // in place
  const auto& r = rejector.getResult();
  EXPECT_EQ(r.kept, correspondences.size());
  EXPECT_EQ(r.kept + r.without_patch + r.too_far + r.unfit_patch, source->size());
  EXPECT_TRUE(r.kept > 0 && r.without_patch > 0 && r.too_far > 0 && r.unfit_patch > 0);
}

TEST(CorrespondenceRejectorPatch, RefusesWhatItCannotUse) {
  CorrespondenceRejectorPatch rejector;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {0.0, -1.0, nan}) {
    EXPECT_THROW(rejector.setMaximumNormalDistance(bad), UsageError);
    EXPECT_THROW(rejector.setMaximumEdgeLength(bad), UsageError);
    EXPECT_THROW(rejector.setMaximumSlope(bad), UsageError);
    EXPECT_THROW(rejector.setMaximumRoughness(bad), UsageError);
    EXPECT_THROW(rejector.setMaximumBend(bad), UsageError);
    EXPECT_THROW(rejector.setResolution(bad), UsageError);
  }
  EXPECT_THROW(rejector.setMaximumSlope(60.0), UsageError);  // degrees by mistake
  pcl::Correspondences remaining;
  EXPECT_THROW(rejector.getRemainingCorrespondences(all(1), remaining), UsageError);
  rejector.setInputTarget(*test::cloudOf<PointLidar>(kPlane));
  EXPECT_THROW(rejector.getRemainingCorrespondences(all(1), remaining), UsageError);
  rejector.setInputTarget(*test::cloudOf<PointLidar>({}));
  rejector.setInputSource(*test::cloudOf<PointLidar>(kOnIt));
  rejector.getRemainingCorrespondences(all(1), remaining);
  EXPECT_TRUE(remaining.empty());
}

}  // namespace
}  // namespace pcl_als
