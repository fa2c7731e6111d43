// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/photogrammetry/bundle_adjustment.h>

#include "synthetic_block.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::noisy;
using test::SyntheticBlock;
using Status = BundleResult::Status;

TEST(BundleAdjustment, ParallelLinesLeaveAShiftUndetermined) {
  SyntheticBlock::Options options = noisy(4);
  options.direction_spread = 0.0;
  SyntheticBlock truth(options);
  for (ObjectLine& line : truth.block.lines) line.end.z() = line.start.z();
  const BundleResult result = adjustBundle(truth.block);
  EXPECT_EQ(result.status, Status::not_determined);
  EXPECT_NE(result.message.find("azimuth 90"), std::string::npos) << result.message;
  EXPECT_NE(result.weakest.find("azimuth 90"), std::string::npos) << result.weakest;
  EXPECT_GT(result.weakest_std, BundleSettings().determined_std);
}

TEST(BundleAdjustment, TooFewLinesDoNotDetermineTheBlock) {
  SyntheticBlock::Options options = noisy(4);
  options.lines = 2;
  const BundleResult result = adjustBundle(SyntheticBlock(options).block);
  EXPECT_EQ(result.status, Status::not_determined);
  EXPECT_FALSE(result.message.empty());
  options.lines = 0;
  EXPECT_THROW(adjustBundle(SyntheticBlock(options).block), InputError);
}

TEST(BundleAdjustment, AnotherCameraIsReported) {
  SyntheticBlock truth(noisy(6));
  truth.block.camera.focal_length = 95.0;
  const BundleResult result = adjustBundle(truth.block);
  EXPECT_EQ(result.status, Status::not_determined);
  EXPECT_NE(result.message.find("focal length"), std::string::npos) << result.message;
}

TEST(BundleAdjustment, OrientationsOfAnotherSystemAreRefused) {
  SyntheticBlock truth(noisy(6));
  for (ObjectLine& line : truth.block.lines) {
    line.start.x() += 5000.0;
    line.end.x() += 5000.0;
  }
  const std::string all = test::messageOf<InputError>([&] { adjustBundle(truth.block); });
  EXPECT_NE(all.find("control lines: 20 of 20"), std::string::npos) << all;
  SyntheticBlock one(noisy(6));
  one.block.images[4].angles.x() += 2.0;
  const std::string single = test::messageOf<InputError>([&] { adjustBundle(one.block); });
  EXPECT_NE(single.find("1 of 20 (in image I5"), std::string::npos) << single;
}

TEST(BundleAdjustment, StandardisedResidualsAreAboutOne) {
  const SyntheticBlock truth(noisy(12));
  const BundleResult result = adjustBundle(truth.block);
  double squares = 0.0, line_squares = 0.0;
  for (const ImageResidual& r : result.residuals) squares += r.standardised * r.standardised;
  for (const AdjustedLine& line : result.lines) line_squares += line.misfit * line.misfit;
  // Mean squares of 2000 residuals and of 60 lines with four coordinates: 0.03 and 0.09 from 1.
  EXPECT_NEAR(squares / static_cast<double>(result.residuals.size()), 1.0, 0.1);
  EXPECT_NEAR(line_squares / static_cast<double>(result.lines.size()), 1.0, 0.3);
}

TEST(BundleAdjustment, MostLinesOfOtherRidgesAreStated) {
  SyntheticBlock truth(noisy(13));
  for (std::size_t i = 0; i + 3 < truth.block.lines.size(); ++i) {
    ObjectLine& line = truth.block.lines[i];
    const Eigen::Vector3d beside(truth.uniform(-40.0, 40.0), truth.uniform(-40.0, 40.0), 0.0);
    line.start += beside;
    line.end += beside;
  }
  const BundleResult result = adjustBundle(truth.block);
  EXPECT_EQ(result.status, Status::not_determined);
  EXPECT_NE(result.message.find("contradict the images"), std::string::npos) << result.message;
}

TEST(BundleAdjustment, ASingleImageIsRefused) {
  SyntheticBlock truth(noisy(6));
  truth.block.images.resize(1);
  EXPECT_THROW(adjustBundle(truth.block), InputError);
}

TEST(BundleAdjustment, AnImageWithoutMeasurementsIsNamed) {
  SyntheticBlock truth(noisy(6));
  auto& all = truth.block.measurements;
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const ImageMeasurement& m) { return m.image == "I7"; }),
            all.end());
  const BundleResult result = adjustBundle(truth.block);
  EXPECT_EQ(result.status, Status::not_determined);
  EXPECT_NE(result.message.find("I7"), std::string::npos) << result.message;
}

TEST(BundleAdjustment, AnImageOfBlundersIsNamed) {
  SyntheticBlock truth(noisy(6));
  std::vector<ImageMeasurement> kept;
  std::size_t points = 0;
  for (ImageMeasurement m : truth.block.measurements) {
    if (m.image == "I7") {
      if (m.kind == ImageMeasurement::Kind::line || ++points > 6) continue;
      if (points > 2) m.position += Eigen::Vector2d(truth.uniform(-3.0, 3.0), 1.0 * points);
    }
    kept.push_back(m);
  }
  truth.block.measurements = kept;
  const BundleResult result = adjustBundle(truth.block);
  EXPECT_EQ(result.status, Status::not_determined);
  EXPECT_NE(result.message.find("too few measurements"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("1 image: I7"), std::string::npos) << result.message;
}

TEST(BundleAdjustment, PriorsOfTheOrientationsReplaceControl) {
  SyntheticBlock::Options options = noisy(8);
  options.lines = 0;
  options.position_error = 0.05;
  options.angle_error = 1e-5;
  SyntheticBlock truth(options);
  for (ImageOrientation& image : truth.block.images) {
    image.position_sigma = 0.05;
    image.angle_sigma = 1e-5;
  }
  const BundleResult result = adjustBundle(truth.block);
  ASSERT_EQ(result.status, Status::converged) << result.message;
  EXPECT_NEAR(result.sigma0, 1.0, 0.1);
}

TEST(LineAssignment, FindsTheLinesByPosition) {
  SyntheticBlock truth(noisy(9));
  for (ImageMeasurement& m : truth.block.measurements)
    if (m.kind == ImageMeasurement::Kind::line) m.feature = "image" + m.feature;
  const auto assignments = assignLines(truth.block, 6.0);
  EXPECT_GT(assignments.size(), 40U);
  for (const LineAssignment& assignment : assignments)
    EXPECT_EQ(assignment.image_line, "image" + assignment.object_line);
  EXPECT_TRUE(adjustBundle(truth.block).reliable());
}

}  // namespace
}  // namespace pcl_als
