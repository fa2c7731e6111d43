// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <memory>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/io/trajectory_writer.h>
#include <pcl_als/processing/file_correction.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/processing/trajectory_conversion.h>
#include <pcl_als/simulation/simulator.h>

#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

Eigen::Matrix3d rotationAbout(int axis, double angle) {
  return Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
}

/// Position and rotation of a trajectory at a time, linear between samples (5 ms apart).
struct Pose {
  Eigen::Vector3d position;
  Eigen::Matrix3d rotation;

  Pose(const std::vector<TrajectorySample>& samples, double time) {
    std::size_t i = 1;
    while (i + 1 < samples.size() && samples[i].time < time) ++i;
    const TrajectorySample &a = samples[i - 1], &b = samples[i];
    const double share = (time - a.time) / (b.time - a.time);
    position = a.position + share * (b.position - a.position);
    const double turn = std::remainder(b.heading - a.heading, 2.0 * kPi);
    rotation = rotationAbout(2, -(a.heading + share * turn)) *
               rotationAbout(0, a.pitch + share * (b.pitch - a.pitch)) *
               rotationAbout(1, a.roll + share * (b.roll - a.roll));
  }
};

/// A strip of a block in files, and a calibration of every kind of bias, with strip corrections.
struct Block {
  fs::path folder = test::scratch("trajectory_conversion");
  CalibrationResult calibration;

  Block() {
    auto options = simulation::SimulationOptions::preset("small", 0.2, 0.05);
    const simulation::Simulator simulator(options);
    StripFileOptions files;
    files.folder = folder;
    writeSurveyFiles(simulator, folder);
    writeStrip(simulator, 0, files, 1, [](double) {});
    for (int i = 0; i < kSystemParameterCount; ++i) {
      calibration.parameters[static_cast<std::size_t>(i)].bias = options.bias[i];
      calibration.parameters[static_cast<std::size_t>(i)].status = ParameterStatus::estimated;
    }
    calibration[SystemParameter::lever_arm_x].std = 0.03;
    calibration.attitude = AttitudeSource::trajectory;
    calibration.converged = true;
    const double start = options.start_time;
    // The angles are constant: apply takes those of the middle of a tenth of a second.
    for (const double time : {start, start + 10.0}) {
      TrajectoryErrorKnot knot;
      knot.time = time;
      knot.position = {0.1, -0.2 - 0.01 * (time - start), 0.3};
      knot.angles = Eigen::Vector3d(20.0, -30.0, 40.0) * kRadiansPerArcsec;
      if (calibration.strip_errors.empty()) calibration.strip_errors.push_back({"1", {}, {}});
      calibration.strip_errors[0].knots.push_back(knot);
    }
  }

  std::vector<TrajectorySample> corrected(bool strip_corrections) const {
    TrajectoryConversionOptions options;
    options.calibration = &calibration;
    options.strip_corrections = strip_corrections;
    convertTrajectory({folder / "trajectory.csv"}, folder / "corrected.csv", options);
    return readTrajectory(folder / "corrected.csv");
  }

  PointChunk applied(bool strip_corrections) const {
    TrajectoryLoadingOptions reading = trajectoryLoadingOptions(calibration);
    FileCorrectionOptions options;
    options.strip_corrections = strip_corrections;
    options.check_trajectory = false;
    correctPointFile(folder / "strip1.las", folder / "applied.las", calibration,
                     loadTrajectory(folder / "trajectory.csv", reading).trajectory, options);
    return points("applied.las");
  }

  PointChunk points(const char* name) const {
    PointChunk chunk;
    PointReader::open(folder / name)->read(chunk);
    return chunk;
  }
};

Eigen::Vector3d at(const PointChunk& points, std::size_t i) {
  return {points.x[i], points.y[i], points.z[i]};
}

/// The georeferencing equation (Habib et al. 2011, Eq. (1)-(2)) of a program that keeps its lever
/// arm and is given boresight, range bias and scan angle scale: \a measured is what it computed
/// before, in the body frame.
Eigen::Vector3d georeferenced(const Pose& pose, const Eigen::Vector3d& measured,
                              const SystemVector& b) {
  const Eigen::Vector3d lever = b.head<3>();
  const Eigen::Matrix3d boresight =
      rotationAbout(2, b[indexOf(SystemParameter::boresight_heading)]) *
      rotationAbout(0, b[indexOf(SystemParameter::boresight_pitch)]) *
      rotationAbout(1, b[indexOf(SystemParameter::boresight_roll)]);
  const Eigen::Vector3d beam = boresight.transpose() * (measured - lever);
  const double range = beam.norm() - b[indexOf(SystemParameter::range_bias)];
  const double beta =
      std::atan2(-beam.x(), -beam.z()) / (1.0 + b[indexOf(SystemParameter::scan_angle_scale)]);
  const double ahead = beam.y() / beam.norm(), across = std::sqrt(1.0 - ahead * ahead);
  const Eigen::Vector3d laser(-range * across * std::sin(beta), range * ahead,
                              -range * across * std::cos(beta));
  return pose.position + pose.rotation * (lever + laser);
}

TEST(TrajectoryConversion, PointsFromTheCorrectedTrajectoryAreThoseThatApplyGives) {
  const Block block;
  const auto delivered = readTrajectory(block.folder / "trajectory.csv");
  const PointChunk points = block.points("strip1.las");
  const SystemVector biases = block.calibration.biases();
  for (const bool strip_corrections : {false, true}) {
    const auto corrected = block.corrected(strip_corrections);
    const PointChunk applied = block.applied(strip_corrections);
    ASSERT_EQ(applied.size(), points.size());
    double largest = 0.0, moved = 0.0;
    for (std::size_t i = 0; i < points.size(); i += 7) {
      const Pose before(delivered, points.gps_time[i]), after(corrected, points.gps_time[i]);
      const Eigen::Vector3d measured =
          before.rotation.transpose() * (at(points, i) - before.position);
      const Eigen::Vector3d computed = georeferenced(after, measured, biases);
      largest = std::max(largest, (computed - at(applied, i)).cwiseAbs().maxCoeff());
      moved = std::max(moved, (at(points, i) - at(applied, i)).norm());
    }
    EXPECT_GT(moved, 0.3);
    // Half of the millimetre of the file, and 2e-4 m: products of biases and corrections.
    EXPECT_LT(largest, 7e-4) << strip_corrections;
  }
}

TEST(TrajectoryConversion, StandardDeviationsHoldTheLeverArm) {
  const Block block;
  TrajectoryConversionOptions options;
  options.calibration = &block.calibration;
  options.strip_corrections = false;
  TrajectoryAccuracy accuracy;
  accuracy.position = {0.04, 0.04, 0.05};
  accuracy.angles.setConstant(1e-4);
  for (const double time : {400000.0, 500000.0}) {
    for (int i = 0; i < 3; ++i) {
      accuracy.time = time + i;
      options.accuracy.push_back(accuracy);
    }
  }
  const auto samples = readTrajectory(block.folder / "trajectory.csv");
  for (double time = samples.front().time; time < samples.back().time + 1.0; time += 1.0) {
    accuracy.time = time;
    options.accuracy.push_back(accuracy);
  }
  const auto written =
      convertTrajectory({block.folder / "trajectory.csv"}, block.folder / "sd.csv", options);
  EXPECT_EQ(written.samples, samples.size());
  const TrajectoryFile file = readTrajectoryFile(block.folder / "sd.csv", TrajectoryReading());
  ASSERT_EQ(file.accuracy.size(), file.samples.size());
  const TrajectoryAccuracy& sd = file.accuracy[10];
  // The lever arm's 3 cm lie across the flight, which goes north or south: 4 and 3 make 5.
  EXPECT_NEAR(sd.position.x(), 0.05, 2e-4);
  EXPECT_NEAR(sd.position.y(), 0.04, 2e-4);
  EXPECT_NEAR(sd.position.z(), 0.05, 2e-4);
  EXPECT_NEAR(sd.angles.z(), 1e-4, 1e-9);
}

TEST(TrajectoryConversion, RefusesWhatItCannotWrite) {
  const Block block;
  const auto refusal = [&](const char* output) {
    return test::messageOf<UsageError>(
        [&] { convertTrajectory({block.folder / "trajectory.csv"}, output, {}); });
  };
  EXPECT_NE(refusal("x.txt").find(".csv, .sbet or .out"), std::string::npos);
  EXPECT_NE(refusal("x.sbet").find("an SBET is in latitude and longitude"), std::string::npos);
}

/// The points of the strip were measured when the calibration knew nothing.
TEST(StripCorrections, AreRefusedForAStripThatHasNone) {
  Block block;
  for (TrajectoryErrorKnot& knot : block.calibration.strip_errors[0].knots) knot.time += 1000.0;
  block.calibration.strip_errors[0].id = "7";
  const std::string message = test::messageOf<InputError>([&] { block.applied(true); });
  EXPECT_NE(message.find("strip1.las: the calibration has no strip corrections for"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("points, of strip 1; it has some for 7"), std::string::npos) << message;
  EXPECT_FALSE(fs::exists(block.folder / "applied.las"));
  block.applied(false);

  FileCorrectionOptions options;
  options.strip_corrections = options.force = true;
  options.check_trajectory = false;
  const auto flight =
      loadTrajectory(block.folder / "trajectory.csv", trajectoryLoadingOptions(block.calibration))
          .trajectory;
  const FileCorrectionResult forced = correctPointFile(
      block.folder / "strip1.las", block.folder / "forced.las", block.calibration, flight, options);
  ASSERT_EQ(forced.warnings.size(), 1U);
  EXPECT_NE(forced.warnings[0].text.find("no strip corrections"), std::string::npos);

  savePcd(block.folder / "strip1.pcd", loadStrips({block.folder / "strip1.las"}).at(0));
  options.force = false;
  EXPECT_THROW(correctPointFile(block.folder / "strip1.pcd", block.folder / "applied.pcd",
                                block.calibration, flight, options),
               InputError);
}

}  // namespace
}  // namespace pcl_als
