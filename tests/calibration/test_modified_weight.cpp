// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "modified_weight.h"
#include "noise_model.h"

namespace pcl_als {
namespace {

const Eigen::Vector3d kRoof = Eigen::Vector3d(0.3, -0.4, 1.2).normalized();

Eigen::Matrix3d someWeight() {
  Eigen::Matrix3d root;
  root << 3.0, 0.2, -0.5, 0.0, 2.0, 0.7, 0.0, 0.0, 5.0;
  return root * root.transpose();
}

TEST(ModifiedWeight, OfAHorizontalPatchKeepsTheVerticalEntry) {
  Eigen::Matrix3d weight;
  weight << 4, 1, 2, 1, 5, 3, 2, 3, 6;
  const Eigen::Matrix3d modified = modifiedWeight(weight, Eigen::Vector3d::UnitZ());
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected(2, 2) = 6.0;
  EXPECT_LT((modified - expected).norm(), 1e-14);  // rounding
}

TEST(ModifiedWeight, IsTheNormalPrecisionTimesTheNormalDyad) {
  const Eigen::Matrix3d modified = modifiedWeight(someWeight(), kRoof);
  const double precision = kRoof.dot(someWeight() * kRoof);
  EXPECT_LT((modified - precision * kRoof * kRoof.transpose()).norm(), 1e-12);  // rounding
}

TEST(ModifiedWeight, DoesNotSeeASlideInsideThePatch) {
  const Eigen::Vector3d slide = kRoof.cross(Eigen::Vector3d(1.0, 7.0, -2.0));
  EXPECT_GT((someWeight() * slide).norm(), 1.0);  // the full weight does
  EXPECT_LT((modifiedWeight(someWeight(), kRoof) * slide).norm(), 1e-12);
}

TEST(ModifiedWeight, TurnsWithEverything) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix3d turned =
      modifiedWeight(turn * someWeight() * turn.transpose(), turn * kRoof);
  EXPECT_LT((turned - turn * modifiedWeight(someWeight(), kRoof) * turn.transpose()).norm(), 1e-12);
}

TEST(ModifiedWeight, PatchRotationIsARotationWithTheNormalLast) {
  for (const Eigen::Vector3d& normal :
       {kRoof, Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0, 1)}) {
    const Eigen::Matrix3d rotation = patchRotation(normal);
    EXPECT_NEAR(rotation.determinant(), 1.0, 1e-14);
    EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    EXPECT_LT((rotation.row(2).transpose() - normal).norm(), 1e-15);
  }
}

TEST(ModifiedWeight, MarginalAndConditionalAgreeAlongAPrincipalAxis) {
  Eigen::Matrix3d covariance = Eigen::Vector3d(0.04, 0.04, 0.0004).asDiagonal();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_DOUBLE_EQ(1.0 / normalVariance(covariance, up),
                   modifiedWeight(covariance.inverse(), up)(2, 2));
  // Off axis, the paper's entry is the larger one: it trusts the pair more than the pair deserves.
  const double paper = kRoof.dot(covariance.inverse() * kRoof);
  EXPECT_GT(paper, 2.0 / normalVariance(covariance, kRoof));
}

ScanGeometry geometryAt(double x, double z, double kappa) {
  ScanGeometry g;
  g.x = x, g.z = z, g.beta = -std::atan2(x, -z);
  g.rotation = Eigen::AngleAxisd(kappa, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return g;
}

TEST(NoiseModel, AtNadirRangeIsHeightAndAngleIsPosition) {
  NoiseModel noise;
  noise.range = 0.02, noise.angle = 1e-4, noise.position = 0.01, noise.beam_divergence = 4e-4;
  const Eigen::Matrix3d covariance = noise.pointCovariance(geometryAt(0.0, -1000.0, 0.7));
  // By hand: height 0.02^2 + 0.01^2; plan (1e-4^2 + (4e-4 / 4)^2) 1000^2 + 0.01^2.
  EXPECT_NEAR(covariance(2, 2), 0.0005, 1e-12);
  EXPECT_NEAR(covariance(0, 0), 0.0201, 1e-12);
  EXPECT_NEAR(covariance(1, 1), 0.0201, 1e-12);
}

TEST(NoiseModel, RangeNoiseActsAlongTheBeam) {
  NoiseModel noise;
  noise.range = 0.02, noise.angle = 0.0, noise.position = 0.0, noise.beam_divergence = 0.0;
  // Flying north, a point 300 m to the right (east) and 400 m below: the beam is (0.6, 0, -0.8).
  const Eigen::Matrix3d covariance = noise.pointCovariance(geometryAt(300.0, -400.0, 0.0));
  const Eigen::Vector3d beam(0.6, 0.0, -0.8);
  EXPECT_LT((covariance - 0.0004 * beam * beam.transpose()).norm(), 1e-15);
}

TEST(NoiseModel, RefusesWhatIsNoStandardDeviation) {
  NoiseModel noise;
  noise.angle = -1e-5;
  EXPECT_THROW(noise.validate(), UsageError);
  noise = NoiseModel();
  noise.range = noise.position = 0.0;
  EXPECT_THROW(noise.validate(), UsageError);
}

}  // namespace
}  // namespace pcl_als
