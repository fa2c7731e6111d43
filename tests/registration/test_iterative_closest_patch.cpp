// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

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
constexpr double kMillimetre = 1e-3;

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
/// with 300, and some leeway for the jackknife's own scatter (with 60 groups, a tenth).
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

/// One pair that most tests look at: 0.4 m and up to 0.2 degrees apart.
class AlignedPair : public testing::Test {
 protected:
  AlignedPair()
      : truth_(test::randomMotion(0.4, 0.2, 7)),
        target_(test::stripPoints({}, 7, 1, kPoints)),
        source_(test::moved(test::stripPoints({}, 7, 2, kPoints), truth_.inverse())) {}

  PatchAlignmentResult align() {
    Icpatch icpatch;
    return pcl_als::align(source_, target_, icpatch);
  }

  Eigen::Affine3d truth_;
  Points target_, source_;
};

/// Both directions are used and every choice is made alike in both clouds, so the answers are
/// inverse but for where the iteration stops: some hundredths of a millimetre each.
TEST_F(AlignedPair, SwappingSourceAndTargetInvertsTheAnswer) {
  const RigidMotion there = align().motion;
  std::swap(source_, target_);
  const RigidMotion back =
      RigidMotion::about(there.centroid + there.shift, align().motion.transformation());
  EXPECT_GT(there.shift.norm(), 0.3);
  EXPECT_NEAR((there.shift + back.shift).norm(), 0.0, 0.3 * kMillimetre);
  EXPECT_NEAR((there.inverse().rotation - back.rotation).norm() * 80.0, 0.0, 0.3 * kMillimetre);
}

/// A quarter turn of everything about the vertical: cells and classes of aspects fall differently,
/// so other points are chosen; the answers agree well inside their uncertainty (1 to 2 mm in plan,
/// 0.2 mm in height).
TEST_F(AlignedPair, RotatingEverythingChangesNothing) {
  const PatchAlignmentResult plain = align();
  const Eigen::Affine3d turn =
      Eigen::Translation3d(300.0, -200.0, 50.0) *
      Eigen::AngleAxisd(0.5 * 3.14159265358979323846 + 0.3, Vector3d::UnitZ());
  source_ = test::moved(source_, turn);
  target_ = test::moved(target_, turn);
  const PatchAlignmentResult turned = align();
  const Eigen::Affine3d back = turn.inverse() * turned.motion.transformation() * turn;
  const RigidMotion motion = RigidMotion::about(plain.motion.centroid, back);
  for (int p = 0; p < 3; ++p)
    EXPECT_NEAR((motion.shift - plain.motion.shift)[p], 0.0, plain.standardDeviation(p)) << p;
}

/// At UTM coordinates, in two local frames 1.5 km apart: the same to float steps of 2 km, 0.12 mm.
TEST_F(AlignedPair, GroundCoordinatesAndTwoLocalFrames) {
  const PatchAlignmentResult plain = align();
  LocalFrame source_frame, target_frame;
  source_frame.origin = Vector3d(500'000.0, 5'400'000.0, 100.0);
  target_frame.origin = source_frame.origin + Vector3d(1200.0, -900.0, 40.0);
  for (Vector3d& p : target_) p += source_frame.origin - target_frame.origin;
  Icpatch icpatch;
  icpatch.setFrames(source_frame, target_frame);
  const PatchAlignmentResult result = pcl_als::align(source_, target_, icpatch);
  ASSERT_TRUE(result.hasConverged()) << result.message;
  EXPECT_NEAR((result.motion.centroid - source_frame.origin - plain.motion.centroid).norm(), 0.0,
              1.0);
  const RigidMotion here =
      RigidMotion::about(plain.motion.centroid,
                         result.motion.transformation(source_frame.origin, source_frame.origin));
  EXPECT_NEAR((here.shift - plain.motion.shift).norm(), 0.0, 1.0 * kMillimetre);
  const Vector3d local = icpatch.getTransformation() * source_.front();
  EXPECT_NEAR(
      (local + target_frame.origin - result.motion.apply(source_.front() + source_frame.origin))
          .norm(),
      0.0, 1e-8);
}

TEST_F(AlignedPair, ThreadsChangeNothing) {
  Icpatch one, eight;
  one.setNumberOfThreads(1);
  eight.setNumberOfThreads(8);
  const auto a = pcl_als::align(source_, target_, one), b = pcl_als::align(source_, target_, eight);
  EXPECT_EQ(a.motion.shift, b.motion.shift);
  EXPECT_EQ(a.motion.rotation, b.motion.rotation);
  EXPECT_EQ(a.covariance, b.covariance);
  EXPECT_EQ(a.pairs, b.pairs);
}

TEST_F(AlignedPair, GuessIsPartOfTheAnswer) {
  // 300 m away: out of reach without a guess.
  const Eigen::Affine3d away =
      Eigen::Translation3d(300.0, 0.0, 100.0) * Eigen::Affine3d::Identity();
  const Points far = test::moved(source_, away);
  Icpatch icpatch;
  EXPECT_FALSE(pcl_als::align(far, target_, icpatch).hasConverged());
  EXPECT_FALSE(icpatch.hasConverged());
  pcl::PointCloud<PointLidar> aligned;
  icpatch.align(aligned, away.inverse().matrix());
  ASSERT_TRUE(icpatch.hasConverged());
  const RigidMotion found =
      RigidMotion::about(Vector3d(80, 80, 2), icpatch.getTransformation() * away);
  const RigidMotion plain =
      RigidMotion::about(Vector3d(80, 80, 2), align().motion.transformation());
  EXPECT_NEAR((found.shift - plain.shift).norm(), 0.0, 1.0 * kMillimetre);
  EXPECT_NEAR((aligned[5].getVector3fMap().cast<double>() - truth_ * source_[5]).norm(), 0.0, 0.01);
}

TEST_F(AlignedPair, MeetsPclsExpectations) {
  Icpatch icpatch;
  pcl_als::align(source_, target_, icpatch);
  EXPECT_EQ(icpatch.getClassName(), "IterativeClosestPatch");
  // Mean squared distance to the nearest point: half a square metre for each point.
  EXPECT_GT(icpatch.getFitnessScore(), 0.0);
  EXPECT_LT(icpatch.getFitnessScore(), 0.5);
  icpatch.setMaximumIterations(1);
  pcl::PointCloud<PointLidar> aligned;
  icpatch.align(aligned);
  EXPECT_FALSE(icpatch.hasConverged());
  EXPECT_EQ(icpatch.getResult().status, PatchAlignmentResult::Status::not_converged);
  icpatch.setMaximumIterations(50);
  icpatch.setMaxCorrespondenceDistance(-1.0);
  EXPECT_THROW(icpatch.align(aligned), UsageError);
}

/// The target as the source moved by 300 ppm about the middle: 24 mm at 80 m.
TEST_F(AlignedPair, ScaleIsFoundWhenAsked) {
  constexpr double kScale = 300e-6;
  const Vector3d middle(80, 80, 2);
  for (Vector3d& p : target_) p = middle + (1.0 + kScale) * (p - middle);
  Icpatch icpatch;
  icpatch.setEstimateScale(true);
  const PatchAlignmentResult result = pcl_als::align(source_, target_, icpatch);
  ASSERT_TRUE(result.hasConverged());
  EXPECT_GT(result.scale_std, 1e-6);
  EXPECT_GT(kScale / result.scale_std, 10.0);
  EXPECT_NEAR(result.motion.scale - 1.0, kScale, 4.0 * result.scale_std);
}

/// Sliding along a plane's level line by 3 m: a plane of 10 degrees shows nothing of it.
TEST(IterativeClosestPatchFlat, SlidingInAPlaneCostsNothing) {
  const auto plane = [](unsigned seed, double slide) {
    Points points = test::stripPoints({0.0, false, 0.0, 0.01}, 1, seed, 20'000);
    for (Vector3d& p : points) p.z() += 0.17 * p.x(), p.y() += slide;
    return points;
  };
  Icpatch icpatch;
  const auto result = align(plane(1, 3.0), plane(2, 0.0), icpatch);
  ASSERT_TRUE(result.hasConverged()) << result.message;
  EXPECT_FALSE(result.parameters[1].determined);
  EXPECT_LT(std::abs(result.normal_before.mean), 1.0 * kMillimetre);
  EXPECT_LT(result.normal_before.rms, 0.02);  // noise of 1 cm in point and patch
}

TEST(IterativeClosestPatchFlat, FlatPairsSayWhatTheyDoNotDetermine) {
  Points target = test::stripPoints({0.0, false, 0.0, 0.02}, 1, 1, kPoints);
  Points source = test::stripPoints({0.0, false, 0.0, 0.02}, 1, 2, kPoints);
  for (Vector3d& p : source) p += Vector3d(0.5, -0.7, 0.1 + 1e-3 * (p.x() - 80.0));
  Icpatch icpatch;
  const auto result = align(source, target, icpatch);
  ASSERT_TRUE(result.hasConverged()) << result.message;
  const bool expected[] = {false, false, true, true, true, false};
  for (int p = 0; p < 6; ++p) {
    EXPECT_EQ(result.parameters[p].determined, expected[p]) << PatchAlignmentResult::name(p);
    EXPECT_EQ(result.parameters[p].reason.empty(), expected[p]);
    if (!expected[p]) {
      EXPECT_EQ(result.standardDeviation(p), 0.0);
    }
  }
  EXPECT_NE(result.message.find("XT, YT, kappa"), std::string::npos) << result.message;
  EXPECT_NEAR(result.motion.shift.z(), -0.1, 4.0 * result.standardDeviation(2));
  EXPECT_NEAR(result.motion.rotation.y(), 1e-3, 4.0 * result.standardDeviation(4));
  EXPECT_NEAR(result.motion.shift.head<2>().norm(), 0.0, 0.01);  // left where they were
}

/// Errors of a trajectory: smooth along the flight, which is that of y, \a size metres in each
/// axis.
Points bent(Points points, double size, double longest, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double frequency[3], phase[3];
  for (int axis = 0; axis < 3; ++axis) {
    frequency[axis] = 6.283 / (longest * (0.4 + 0.6 * unit(random)));
    phase[axis] = 6.283 * unit(random);
  }
  for (Vector3d& p : points) {
    const double y = p.y();
    for (int axis = 0; axis < 3; ++axis)
      p[axis] += 1.41 * size * std::sin(frequency[axis] * y + phase[axis]);
  }
  return points;
}

/// Slopes of two percent seem to determine the motion in plan to millimetres, because 100,000 pairs
/// average the noise. Errors of some centimetres that neighbours share are not averaged: what they
/// leave open keeps its initial value, and no point moves farther than the limit of
/// determined_std, or four reported standard deviations.
TEST(IterativeClosestPatchFlat, SharedErrorsMoveNothingFartherThanTheDataDetermine) {
  constexpr double kLimit = 0.1;  // metres, PatchAlignmentSettings::determined_std
  const test::PairScene gentle{0.3, false, 0.0, 0.02};
  int held = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Points target =
        bent(test::stripPoints(gentle, seed, 10 + seed, kPoints), 0.03, 60.0, seed);
    const Points source =
        bent(test::stripPoints(gentle, seed, 20 + seed, kPoints), 0.03, 60.0, 100 + seed);
    Icpatch icpatch;
    const PatchAlignmentResult result = align(source, target, icpatch);
    ASSERT_TRUE(result.hasConverged()) << seed << ' ' << result.message;
    for (int p = 0; p < 6; ++p) {
      const double scale = p < 3 ? 1.0 : result.radius;
      if (result.parameters[p].determined)
        EXPECT_LT(scale * result.standardDeviation(p), kLimit);
      else
        ++held;
    }
    for (const double x : {0.0, 160.0})
      for (const double y : {0.0, 160.0}) {
        const Vector3d corner(x, y, 0.0);
        EXPECT_LT((result.motion.apply(corner) - corner).norm(), 2.0 * kLimit) << seed;
      }
  }
  EXPECT_GE(held, 6);  // of 36: otherwise the scene shows nothing
}

/// Motion at the middle of the scene, with the standard deviations there.
struct MotionAtMiddle {
  Eigen::Matrix<double, 6, 1> values, variances;

  explicit MotionAtMiddle(const PatchAlignmentResult& result) {
    const Vector3d arm = Vector3d(80.0, 80.0, 2.0) - result.motion.centroid;
    const Vector3d turn = result.motion.rotation;
    values << result.motion.shift + turn.cross(arm), turn;
    Eigen::Matrix<double, 6, 6> jacobian = Eigen::Matrix<double, 6, 6>::Identity();
    for (int axis = 0; axis < 3; ++axis)
      jacobian.col(3 + axis).head<3>() = Vector3d::Unit(axis).cross(arm);
    variances = (jacobian * result.covariance * jacobian.transpose()).diagonal();
  }
};

/// Strips that bend by more than a cell of the jackknife: the motions of the two halves of an
/// overlap, along the flight and across it, differ by their combined standard deviations.
TEST(IterativeClosestPatchBent, HalvesAgreeWithinTheirUncertainty) {
  double squares = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Points target = bent(test::stripPoints({}, seed, 10 + seed, kPoints), 0.02, 400.0, seed);
    const Points source =
        bent(test::stripPoints({}, seed, 20 + seed, kPoints), 0.02, 400.0, 100 + seed);
    for (const int axis : {0, 1}) {
      std::vector<MotionAtMiddle> halves;
      for (const double side : {-1.0, 1.0}) {
        const auto half = [&](const Points& points) {
          Points part;
          for (const Vector3d& p : points)
            if (side * (p[axis] - 80.0) > 0.0) part.push_back(p);
          return part;
        };
        Icpatch icpatch;
        const PatchAlignmentResult result = align(half(source), half(target), icpatch);
        if (result.hasConverged() && result.allDetermined()) halves.emplace_back(result);
      }
      if (halves.size() < 2) continue;
      squares += ((halves[0].values - halves[1].values).array().square() /
                  (halves[0].variances + halves[1].variances).array())
                     .sum();
      count += 6;
    }
  }
  ASSERT_GE(count, 60);
  EXPECT_LT(std::sqrt(squares / count), 1.3);
  EXPECT_GT(std::sqrt(squares / count), 0.5);
}

TEST(IterativeClosestPatchInput, AStripAgainstItselfRests) {
  const Points strip = test::stripPoints({}, 3, 1, kPoints);
  Icpatch icpatch;
  const auto result = align(strip, strip, icpatch);
  ASSERT_TRUE(result.hasConverged()) << result.message;
  EXPECT_LT(result.motion.shift.norm(), 1e-6);
  EXPECT_LT(result.motion.rotation.norm(), 1e-8);
}

TEST(IterativeClosestPatchInput, HardlyAnyPoints) {
  const Points strip = test::stripPoints({}, 3, 1, 5000);
  const Points few[] = {{}, {strip[0]}, {strip[0], strip[1]}, {strip.begin(), strip.begin() + 30}};
  for (const Points& points : few) {
    if (points.empty()) continue;  // PCL itself refuses empty clouds
    Icpatch icpatch;
    const auto result = align(points, strip, icpatch);
    EXPECT_FALSE(icpatch.hasConverged());
    EXPECT_FALSE(result.message.empty());
    EXPECT_FALSE(result.allDetermined());
  }
}

TEST(IterativeClosestPatchInput, StripsBesideEachOtherAndPointsThatAreNotFinite) {
  Points strip = test::stripPoints({}, 3, 1, 20'000), beside = strip;
  for (Vector3d& p : beside) p.x() += 1000.0;
  Icpatch icpatch;
  EXPECT_EQ(align(beside, strip, icpatch).status, PatchAlignmentResult::Status::no_overlap);
  Points other = test::stripPoints({}, 3, 2, 20'000);
  other[5].z() = other[6].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(align(other, strip, icpatch).hasConverged()) << icpatch.getResult().message;
}

}  // namespace
}  // namespace pcl_als
