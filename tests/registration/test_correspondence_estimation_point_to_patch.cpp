// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <limits>

#include <gtest/gtest.h>
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>

#include "cloud_support.h"
#include "surface_sets.h"

/// What a user of the library may bring: fields of his own, in his own namespace and order.
namespace survey {
struct EIGEN_ALIGN16 Echo {
  PCL_ADD_POINT4D;
  std::uint8_t quality = 0;
  double seconds = 0.0;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
}  // namespace survey
POINT_CLOUD_REGISTER_POINT_STRUCT(survey::Echo,
                                  (float, x, x)(float, y, y)(float, z, z)(std::uint8_t, quality,
                                                                          quality)(double, seconds,
                                                                                   seconds))

namespace pcl_als {
namespace {

using Eigen::Vector3d;

const float kNan = std::numeric_limits<float>::quiet_NaN();

template <typename PointT>
class PointToPatch : public testing::Test {
 public:
  using Estimation = CorrespondenceEstimationPointToPatch<PointT, PointT>;
  using Cloud = pcl::PointCloud<PointT>;

  /// The triangle z = x over (0,0), (4,0), (0,4) against the given points.
  static pcl::Correspondences find(Estimation& estimation, const std::vector<Vector3d>& points) {
    pcl::Correspondences found;
    estimation.setInputTarget(test::cloudOf<PointT>({{0, 0, 0}, {4, 0, 4}, {0, 4, 0}}));
    estimation.setInputSource(test::cloudOf<PointT>(points));
    estimation.determineCorrespondences(found);
    return found;
  }
};

using PointTypes = testing::Types<PointLidar, pcl::PointXYZ, pcl::PointXYZI, pcl::PointNormal,
                                  pcl::PointXYZINormal, survey::Echo>;
TYPED_TEST_SUITE(PointToPatch, PointTypes);

TYPED_TEST(PointToPatch, ByHand) {
  typename TestFixture::Estimation estimation;
  // The second projects beside the triangle, the third is 0.71 m above it along the normal.
  const auto found = this->find(estimation, {{1, 1, 1}, {0.1, 1, -0.9}, {2.5, 0.5, 3.5}});
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].index_query, 0);
  EXPECT_EQ(found[0].distance, 0.0F);
  EXPECT_EQ(found[1].index_query, 2);
  EXPECT_EQ(found[1].index_match, 1);  // projected to (3, 0.5, 3): the corner (4, 0, 4) is nearest
  EXPECT_NEAR(found[1].distance, 0.5F, 1e-6F);  // squared
  const PatchMatch& match = estimation.getMatches()[1];
  EXPECT_NEAR(match.signed_normal_distance, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR((match.foot - Vector3d(3.0, 0.5, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(match.triangle, 0);
}

TYPED_TEST(PointToPatch, BothLimitsAreOfTheNormalDistance) {
  typename TestFixture::Estimation estimation;
  estimation.setMaximumNormalDistance(0.7);
  EXPECT_EQ(this->find(estimation, {{2.5, 0.5, 3.5}}).size(), 0U);
  estimation.setMaximumNormalDistance(0.71);
  EXPECT_EQ(this->find(estimation, {{2.5, 0.5, 3.5}}).size(), 1U);
  pcl::Correspondences found;
  estimation.determineCorrespondences(found, 0.7);
  EXPECT_EQ(found.size(), 0U);
  estimation.determineCorrespondences(found, 0.0);
  EXPECT_EQ(found.size(), 0U);
}

TYPED_TEST(PointToPatch, PointsThatAreNotFiniteAreExcluded) {
  typename TestFixture::Estimation estimation;
  std::vector<Vector3d> target = test::scenePoints(500, 0.01, 1), source = target;
  target.insert(target.begin() + 7, Vector3d(kNan, 1, 1));
  source[3].z() = kNan;
  estimation.setInputTarget(test::cloudOf<TypeParam>(target));
  estimation.setInputSource(test::cloudOf<TypeParam>(source));
  pcl::Correspondences found;
  estimation.determineCorrespondences(found);
  ASSERT_GT(found.size(), 450U);  // a point is a vertex of its own patch; some lie under slivers
  for (const pcl::Correspondence& c : found) {
    EXPECT_NE(c.index_query, 3);
    EXPECT_EQ(c.index_match, c.index_query < 7 ? c.index_query : c.index_query + 1);
    EXPECT_NEAR(c.distance, 0.0F, 1e-10F);
  }
}

TYPED_TEST(PointToPatch, TargetsWithoutPatchesGiveNoCorrespondences) {
  const std::vector<std::vector<Vector3d>> targets{
      {{1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}, {{0, 0, 0}, {1, 1, 0}, {2, 2, 5}}, {{kNan, 0, 0}}};
  for (const auto& target : targets) {
    typename TestFixture::Estimation estimation;
    estimation.setInputTarget(test::cloudOf<TypeParam>(target));
    estimation.setInputSource(test::cloudOf<TypeParam>({{1, 1, 1}, {1, 0, 1}}));
    pcl::Correspondences found(5);
    estimation.determineCorrespondences(found);
    EXPECT_TRUE(found.empty());
    estimation.determineReciprocalCorrespondences(found);
    EXPECT_TRUE(found.empty());
  }
}

TYPED_TEST(PointToPatch, EmptyCloudsAndMissingClouds) {
  typename TestFixture::Estimation estimation;
  pcl::Correspondences found(5);
  EXPECT_THROW(estimation.determineCorrespondences(found), UsageError);
  estimation.setInputTarget(test::cloudOf<TypeParam>({{0, 0, 0}, {4, 0, 4}, {0, 4, 0}}));
  EXPECT_THROW(estimation.determineCorrespondences(found), UsageError);
  estimation.setInputSource(test::cloudOf<TypeParam>({}));
  estimation.determineCorrespondences(found);
  EXPECT_TRUE(found.empty());
  estimation.determineReciprocalCorrespondences(found);
  EXPECT_TRUE(found.empty());
}

TYPED_TEST(PointToPatch, Indices) {
  typename TestFixture::Estimation estimation;
  estimation.setInputTarget(
      test::cloudOf<TypeParam>({{2, 2, 9}, {0, 0, 0}, {4, 0, 4}, {1, 1, 9}, {0, 4, 0}}));
  estimation.setIndicesTarget(pcl::IndicesPtr(new pcl::Indices{1, 2, 4}));
  estimation.setInputSource(test::cloudOf<TypeParam>({{1, 1, 1}, {1, 1, 1}, {0.2, 0.1, 0.2}}));
  estimation.setIndicesSource(pcl::IndicesPtr(new pcl::Indices{2, 1}));
  pcl::Correspondences found;
  estimation.determineCorrespondences(found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].index_query, 2);
  EXPECT_EQ(found[0].index_match, 1);
  EXPECT_EQ(found[1].index_query, 1);
  EXPECT_EQ(estimation.findMatch(0), nullptr);
  EXPECT_EQ(estimation.findMatch(2), &estimation.getMatches()[0]);
  EXPECT_EQ(estimation.findMatch(99), nullptr);
  estimation.setIndicesTarget(pcl::IndicesPtr(new pcl::Indices{1, 2, 5}));
  EXPECT_THROW(estimation.determineCorrespondences(found), UsageError);
}

TEST(CorrespondenceEstimationPointToPatch, ReciprocalOnesHoldInBothDirections) {
  using Estimation = CorrespondenceEstimationPointToPatch<PointLidar, PointLidar>;
  const auto source = test::cloudOf<PointLidar>(test::scenePoints(3000, 0.02, 1));
  const auto target = test::cloudOf<PointLidar>(test::scenePoints(3000, 0.02, 2));
  Estimation there, back;
  pcl::Correspondences one_way, both, backward;
  there.setInputSource(source);
  there.setInputTarget(target);
  there.determineCorrespondences(one_way, 0.3);
  there.determineReciprocalCorrespondences(both, 0.3);
  back.setInputSource(target);
  back.setInputTarget(source);
  back.determineCorrespondences(backward, 0.3);
  EXPECT_LT(both.size(), one_way.size());
  EXPECT_GT(both.size(), one_way.size() / 10);
  ASSERT_EQ(both.size(), there.getMatches().size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    EXPECT_EQ(there.findMatch(both[i].index_query), &there.getMatches()[i]);
    const PatchMatch* match = back.findMatch(both[i].index_match);
    ASSERT_NE(match, nullptr);
    const auto& corners = back.getSurface()->surface.tin().triangles()[match->triangle].vertex;
    EXPECT_NE(std::find(corners.begin(), corners.end(), both[i].index_query), corners.end());
  }
}

TEST(CorrespondenceEstimationPointToPatch, ThreadsChangeNothing) {
  CorrespondenceEstimationPointToPatch<PointLidar, PointLidar> estimation;
  estimation.setInputSource(test::cloudOf<PointLidar>(test::scenePoints(20000, 0.05, 3)));
  estimation.setInputTarget(test::cloudOf<PointLidar>(test::scenePoints(20000, 0.05, 4)));
  pcl::Correspondences one, eight;
  estimation.setNumberOfThreads(1);
  estimation.determineCorrespondences(one);
  estimation.setNumberOfThreads(8);
  estimation.determineCorrespondences(eight);
  ASSERT_EQ(one.size(), eight.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].index_query, eight[i].index_query);
    EXPECT_EQ(one[i].index_match, eight[i].index_match);
    EXPECT_EQ(one[i].distance, eight[i].distance);
  }
}

TEST(CorrespondenceEstimationPointToPatch, TargetIsTriangulatedOnlyWhenSet) {
  CorrespondenceEstimationPointToPatch<PointLidar, PointLidar> estimation;
  const auto target = test::cloudOf<PointLidar>(test::scenePoints(500, 0.0, 5));
  estimation.setInputTarget(target);
  estimation.setInputSource(target);
  pcl::Correspondences found;
  estimation.determineCorrespondences(found);
  const CloudSurface::ConstPtr first = estimation.getSurface();
  estimation.setInputSource(test::cloudOf<PointLidar>(test::scenePoints(500, 0.0, 6)));
  estimation.determineCorrespondences(found);
  EXPECT_EQ(estimation.getSurface(), first);
  estimation.setInputTarget(target);
  estimation.determineCorrespondences(found);
  EXPECT_NE(estimation.getSurface(), first);
}

TEST(CorrespondenceEstimationPointToPatch, CloneFindsTheSame) {
  using Estimation = CorrespondenceEstimationPointToPatch<PointLidar, PointLidar>;
  Estimation estimation;
  estimation.setMaximumNormalDistance(0.2);
  estimation.setInputSource(test::cloudOf<PointLidar>(test::scenePoints(2000, 0.1, 7)));
  estimation.setInputTarget(test::cloudOf<PointLidar>(test::scenePoints(2000, 0.1, 8)));
  const Estimation::Base::Ptr copy = estimation.clone();
  pcl::Correspondences one, other;
  estimation.determineCorrespondences(one);
  copy->determineCorrespondences(other);
  ASSERT_EQ(one.size(), other.size());
  EXPECT_GT(one.size(), 500U);
  EXPECT_EQ(dynamic_cast<Estimation&>(*copy).getMaximumNormalDistance(), 0.2);
}

TEST(CorrespondenceEstimationPointToPatch, RefusesImpossibleSettings) {
  CorrespondenceEstimationPointToPatch<PointLidar, PointLidar> estimation;
  for (const double bad : {0.0, -1.0, static_cast<double>(kNan)}) {
    EXPECT_THROW(estimation.setMaximumNormalDistance(bad), UsageError);
    EXPECT_THROW(estimation.setResolution(bad), UsageError);
  }
  EXPECT_THROW(estimation.setNumberOfThreads(-1), UsageError);
  try {
    estimation.setMaximumNormalDistance(-2.0);
    FAIL();
  } catch (const UsageError& error) {  // names what, value and unit
    const std::string text = error.what();
    EXPECT_NE(text.find("maximum normal distance"), std::string::npos) << text;
    EXPECT_NE(text.find("-2.0"), std::string::npos) << text;
    EXPECT_NE(text.find(" m"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace pcl_als
