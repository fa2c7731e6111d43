// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Correspondences and rejector inside pcl::IterativeClosestPoint, two clouds of roofs and terrain
// with a known motion between them.
#include <gtest/gtest.h>
#include <pcl/common/transforms.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_point_to_plane_lls.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/registration/iterative_closest_patch.h>
#include <pcl_als/registration/point_to_patch.h>

#include "cloud_support.h"
#include "surface_sets.h"

namespace pcl_als {
namespace {

using PointT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointT>;
using Icp = pcl::IterativeClosestPoint<PointT, PointT, double>;
using PatchEstimation = CorrespondenceEstimationPointToPatch<PointT, PointT, double>;

/// The scene, with at each point the mean normal of the triangles around it.
Cloud::Ptr sceneWithNormals(int count, double noise, unsigned seed) {
  const PatchSurface surface(Tin(test::scenePoints(count, noise, seed)));
  const Cloud::Ptr cloud = test::cloudOf<PointT>(surface.tin().points());
  for (std::size_t t = 0; t < surface.tin().triangles().size(); ++t)
    for (const std::int32_t v : surface.tin().triangles()[t].vertex)
      (*cloud)[v].getNormalVector3fMap() +=
          surface.normal(static_cast<std::int32_t>(t)).cast<float>();
  for (PointT& p : *cloud) p.getNormalVector3fMap().normalize();
  return cloud;
}

/// 0.2, -0.3 and 0.4 degrees about the axes through the scene's centre, then 0.4, -0.3, 0.2 m.
Eigen::Matrix4d knownMotion() {
  const double degree = 0.017453292519943295;
  const Eigen::Vector3d centre(30.0, 30.0, 3.0);
  Eigen::Affine3d motion = Eigen::Affine3d::Identity();
  motion.translate(centre + Eigen::Vector3d(0.4, -0.3, 0.2));
  motion.rotate(Eigen::AngleAxisd(0.4 * degree, Eigen::Vector3d::UnitZ()));
  motion.rotate(Eigen::AngleAxisd(-0.3 * degree, Eigen::Vector3d::UnitY()));
  motion.rotate(Eigen::AngleAxisd(0.2 * degree, Eigen::Vector3d::UnitX()));
  motion.translate(-centre);
  return motion.matrix();
}

/// Shift at the scene's centre (m) and rotation (rad) that remain of a motion.
struct Remainder {
  double shift, rotation;
};
Remainder remainder(const Eigen::Matrix4d& motion) {
  const Eigen::Vector4d centre(30.0, 30.0, 3.0, 1.0);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(motion.topLeftCorner<3, 3>()));
  return {(motion * centre - centre).head<3>().norm(), std::abs(turn.angle())};
}

/// With 5 mm of noise the remaining shift was 1.2 to 2.0 mm (almost all in plan) and the rotation
/// 0.1 to 0.6e-4 rad over three pairs of seeds. It grows to 13 mm at 2 cm of noise: PCL's
/// point-to-plane estimation takes the normal of one vertex, which is noisier than a patch.
constexpr double kNoise = 0.005, kShift = 0.003, kRotation = 1e-4;

class PatchIcp : public testing::Test {
 protected:
  PatchIcp() : target_(sceneWithNormals(20000, kNoise, 1)), source_(new Cloud) {
    pcl::transformPointCloudWithNormals(*sceneWithNormals(20000, kNoise, 2), *source_,
                                        Eigen::Matrix4d(knownMotion().inverse()));
    estimation_->setMaximumNormalDistance(2.0);
    estimation_->setPatchTransformationRequired(false);  // point to plane takes normal distances
    icp_.setCorrespondenceEstimation(estimation_);
    icp_.setTransformationEstimation(
        pcl::shared_ptr<
            pcl::registration::TransformationEstimationPointToPlaneLLS<PointT, PointT, double>>(
            new pcl::registration::TransformationEstimationPointToPlaneLLS<PointT, PointT,
                                                                           double>));
    prepare(icp_);
  }

  template <typename Registration>
  void prepare(Registration& icp) const {
    icp.setInputSource(source_);
    icp.setInputTarget(target_);
    icp.setMaximumIterations(40);
    icp.setTransformationEpsilon(1e-12);
  }

  Remainder align() { return align(icp_); }
  template <typename Registration>
  static Remainder align(Registration& icp) {
    Cloud aligned;
    icp.align(aligned);
    EXPECT_TRUE(icp.hasConverged());
    const Eigen::Matrix4d found = icp.getFinalTransformation().template cast<double>();
    return remainder(found * knownMotion().inverse());
  }

  Cloud::Ptr target_, source_;
  pcl::shared_ptr<PatchEstimation> estimation_{new PatchEstimation};
  pcl::shared_ptr<CorrespondenceRejectorPatch> rejector_{new CorrespondenceRejectorPatch};
  Icp icp_;
};

TEST_F(PatchIcp, StartIsFarOutsideTheTolerances) {
  const Remainder start = remainder(knownMotion().inverse());
  EXPECT_GT(start.shift, 100.0 * kShift);
  EXPECT_GT(start.rotation, 50.0 * kRotation);
}

TEST_F(PatchIcp, ConvergesWithTheEstimationsPatches) {
  rejector_->setMatchProvider(estimation_);
  icp_.addCorrespondenceRejector(rejector_);
  const Remainder left = align();
  EXPECT_LT(left.shift, kShift);
  EXPECT_LT(left.rotation, kRotation);
  EXPECT_GT(rejector_->getResult().kept, 15000U);
}

TEST_F(PatchIcp, ConvergesWithPatchesTheRejectorFinds) {
  icp_.addCorrespondenceRejector(rejector_);
  const Remainder left = align();
  EXPECT_LT(left.shift, kShift);
  EXPECT_LT(left.rotation, kRotation);
}

TEST_F(PatchIcp, ConvergesWithReciprocalCorrespondences) {
  rejector_->setMatchProvider(estimation_);
  icp_.addCorrespondenceRejector(rejector_);
  icp_.setUseReciprocalCorrespondences(true);
  const Remainder left = align();
  EXPECT_LT(left.shift, kShift);
  EXPECT_LT(left.rotation, kRotation);
}

TEST_F(PatchIcp, RejectorServesNearestNeighbourCorrespondences) {
  icp_.setCorrespondenceEstimation(
      pcl::shared_ptr<pcl::registration::CorrespondenceEstimation<PointT, PointT, double>>(
          new pcl::registration::CorrespondenceEstimation<PointT, PointT, double>));
  icp_.addCorrespondenceRejector(rejector_);
  const Remainder left = align();
  EXPECT_LT(left.shift, 2.0 * kShift);  // the nearest point need not be a corner of the patch
}

TEST_F(PatchIcp, TransformationEstimationTakesThePatchesNormals) {
  using Transformation = TransformationEstimationPatch<PointT, PointT, double>;
  const pcl::shared_ptr<Transformation> transformation(new Transformation);
  transformation->setMatchProvider(estimation_);
  rejector_->setMatchProvider(estimation_);
  icp_.addCorrespondenceRejector(rejector_);
  icp_.setTransformationEstimation(transformation);
  const Remainder left = align();
  EXPECT_LT(left.shift, kShift);
  EXPECT_LT(left.rotation, kRotation);
}

TEST_F(PatchIcp, TransformationEstimationFindsPatchesItself) {
  using Transformation = TransformationEstimationPatch<PointT, PointT, double>;
  icp_.addCorrespondenceRejector(rejector_);
  icp_.setTransformationEstimation(pcl::shared_ptr<Transformation>(new Transformation));
  EXPECT_LT(align().shift, kShift);
}

/// The three parts reach what ICPatch reaches on the same clouds, in single precision, too.
TEST_F(PatchIcp, HelperSetsTheThreePartsOfAnyRegistration) {
  pcl::IterativeClosestPoint<PointT, PointT> icp;
  pcl::IterativeClosestPointWithNormals<PointT, PointT, double> with_normals;
  IterativeClosestPatch<PointT, PointT, double> icpatch;
  const auto parts = usePointToPatch(icp);
  usePointToPatch(with_normals);
  prepare(icp), prepare(with_normals);
  icpatch.setInputSource(source_);
  icpatch.setInputTarget(target_);
  for (const Remainder& left : {align(icp), align(with_normals), align(icpatch)}) {
    EXPECT_LT(left.shift, kShift);
    EXPECT_LT(left.rotation, kRotation);
  }
  EXPECT_GT(parts.rejector->getResult().kept, 15000U);
  EXPECT_EQ(parts.correspondences->getMatches().size(),
            parts.rejector->getResult().kept + parts.rejector->getResult().unfit_patch);
}

/// Without the transformation estimation, PCL's point-to-point estimation leaves 0.50 m of 0.54 m.
TEST_F(PatchIcp, PointToPointTransformationIsRefused) {
  Icp icp;
  const pcl::shared_ptr<PatchEstimation> estimation(new PatchEstimation);
  rejector_->setMatchProvider(estimation);
  icp.setCorrespondenceEstimation(estimation);
  icp.addCorrespondenceRejector(rejector_);
  prepare(icp);
  Cloud aligned;
  try {
    icp.align(aligned);
    FAIL() << "point to point";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("usePointToPatch"), std::string::npos) << error.what();
  }
  estimation->setPatchTransformationRequired(false);
  EXPECT_GT(align(icp).shift, 10.0 * kShift);
}

/// Searches for several clouds, or for one that was not moved, are no iterations.
TEST_F(PatchIcp, SearchesWithoutMotionAreAllowed) {
  PatchEstimation estimation;
  pcl::Correspondences found;
  estimation.setInputTarget(target_);
  for (const Cloud::Ptr& cloud : {source_, source_, target_, Cloud::Ptr(new Cloud(*source_))}) {
    estimation.setInputSource(cloud);
    estimation.determineCorrespondences(found, 0.5);
    EXPECT_GT(found.size(), 10000U);
  }
  estimation.setInputSource(source_);
  estimation.determineCorrespondences(found);
  for (PointT& point : *source_) point.z += 0.1F;
  EXPECT_THROW(estimation.determineCorrespondences(found), UsageError);
  estimation.markTransformationEstimated();
  estimation.determineCorrespondences(found);
}

TEST_F(PatchIcp, WithoutTheRejectorTheAnswerIsWorse) {
  const Remainder without = align();
  rejector_->setMatchProvider(estimation_);
  icp_.addCorrespondenceRejector(rejector_);
  EXPECT_GT(without.shift, 2.0 * align().shift);  // 8 mm against 1.3 mm
}

}  // namespace
}  // namespace pcl_als
