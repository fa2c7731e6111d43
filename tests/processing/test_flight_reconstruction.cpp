// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/processing/trajectory_from_points.h>
#include <pcl_als/simulation/simulator.h>

#include "real_data.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

/// A simulated town at 1150 and 540 m above ground, written as files with errors of every kind.
struct Town {
  fs::path folder;
  std::vector<std::string> files;
  std::vector<TrajectorySample> truth;  ///< origin of the pulses: with the assumed lever arm

  explicit Town(const char* name) : folder(test::scratch(name)) {
    auto options = simulation::SimulationOptions::preset("small", 1.0, 0.5);
    options.noise = simulation::NoiseOptions::named("realistic");
    const simulation::Simulator simulator(options);
    StripFileOptions format;
    format.folder = folder;
    for (std::size_t strip = 0; strip < simulator.stripCount(); ++strip) {
      writeStrip(simulator, strip, format, 1, [](double) {});
      files.push_back((folder / format.nameOf(static_cast<std::uint16_t>(strip + 1))).string());
    }
    const Eigen::Vector3d arm = (options.mounting + options.bias).head<3>();
    truth = simulator.trajectory();
    for (TrajectorySample& sample : truth) {
      const Eigen::Vector3d forward(std::sin(sample.heading), std::cos(sample.heading), 0.0);
      const Eigen::Vector3d right(forward.y(), -forward.x(), 0.0);
      sample.position += arm.x() * right + arm.y() * forward + arm.z() * Eigen::Vector3d::UnitZ();
    }
  }

  /// The sample at a time; null outside the flight.
  const TrajectorySample* at(double time) const {
    for (const TrajectorySample& sample : truth)
      if (std::abs(sample.time - time) < 0.003) return &sample;
    return nullptr;
  }
};

ReconstructedTrajectory reconstructed(const std::vector<std::string>& files,
                                      const ReconstructionOptions& options = {}) {
  SurveyReader survey(files, 1);
  return reconstructTrajectory(survey, options);
}

// Coordinates in whole millimetres and returns some ten metres apart: centimetres.
TEST(FlightReconstruction, FindsPositionAndAttitudeOfABlock) {
  const Town town("flight_reconstruction");
  const ReconstructedTrajectory flight = reconstructed(town.files);
  ASSERT_TRUE(flight.incomplete.empty()) << flight.incomplete;
  ASSERT_EQ(flight.paths.size(), town.files.size());
  ASSERT_EQ(flight.samples.size(), flight.accuracy.size());
  std::size_t compared = 0;
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < flight.samples.size(); ++i) {
    const TrajectorySample& sample = flight.samples[i];
    const TrajectorySample* truth = town.at(sample.time);
    if (truth == nullptr) continue;
    ++compared;
    const Eigen::Vector3d error = sample.position - truth->position;
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 0.3) << sample.time;
    squares += error.cwiseQuotient(flight.accuracy[i].position).cwiseAbs2();
    EXPECT_LT(error.cwiseQuotient(flight.accuracy[i].position).cwiseAbs().maxCoeff(), 8.0)
        << sample.time;  // 5 sigma and 1.5 cm of the trajectory's own errors
    ASSERT_TRUE(sample.hasAttitude()) << flight.attitude;
    EXPECT_NEAR(sample.pitch, truth->pitch, 2e-3);
    EXPECT_NEAR(std::remainder(sample.heading - truth->heading, 2.0 * kPi), 0.0, 5e-3);
    EXPECT_NEAR(sample.roll, truth->roll, 4.0 * flight.accuracy[i].angles.x());
  }
  EXPECT_GT(compared, 300U);
  // Some fifteen independent values: 20 %.
  for (const double square : squares) {
    EXPECT_GT(std::sqrt(square / static_cast<double>(compared)), 0.6);
    EXPECT_LT(std::sqrt(square / static_cast<double>(compared)), 1.5);
  }
}

/// RMS difference in the worst coordinate to the trajectory that comes with real data, metres.
double rmsDifference(const std::vector<std::string>& files, const fs::path& reference,
                     std::size_t& compared) {
  ReconstructionOptions options;
  options.attitude = false;
  const ReconstructedTrajectory flight = reconstructed(files, options);
  const Trajectory other(readTrajectory(reference));
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  std::size_t cursor = 0;
  for (const TrajectorySample& sample : flight.samples) {
    PathSpan span;
    if (!other.pathAt(sample.time, span, cursor)) continue;
    ++compared;
    squares += (sample.position - span.at(sample.time)).cwiseAbs2();
  }
  return std::sqrt(squares.maxCoeff() / static_cast<double>(compared));
}

// The reference is one quadratic for each strip, good to 1 to 2 m.
TEST(FlightReconstruction, AgreesWithTheTrajectoriesOfRealStrips) {
  const auto first = test::unpacked("delft_ahn3/ahn3_cropped_1.las.xz");
  PCL_ALS_REQUIRE_DATA(first);
  const auto second = test::unpacked("delft_ahn3/ahn3_cropped_2.las.xz");
  PCL_ALS_REQUIRE_DATA(second);
  std::size_t compared = 0;
  EXPECT_LT(rmsDifference({first->string(), second->string()},
                          *test::testData("delft_ahn3/trajectory.csv"), compared),
            2.0);
  EXPECT_GT(compared, 100U);
  const auto conical = test::unpacked("real/stbarth/stbarth.las.xz");
  PCL_ALS_REQUIRE_DATA(conical);
  compared = 0;
  EXPECT_LT(
      rmsDifference({conical->string()}, *test::testData("real/stbarth/trajectory.csv"), compared),
      2.0);
  EXPECT_GT(compared, 20U);
}

TEST(FlightReconstruction, WritesWhatItReads) {
  const Town town("flight_reconstruction_file");
  ReconstructionOptions options;
  options.attitude = false;
  options.strips.only = {"3"};
  const ReconstructedTrajectory flight = reconstructed(town.files, options);
  EXPECT_EQ(flight.paths.size(), 1U);
  const fs::path csv = town.folder / "reconstructed.csv";
  writeReconstruction(flight, csv, {});
  const TrajectoryFile file = readTrajectoryFile(csv, TrajectoryReading());
  ASSERT_EQ(file.samples.size(), flight.samples.size());
  ASSERT_EQ(file.accuracy.size(), flight.samples.size());
  EXPECT_NEAR(file.accuracy[3].position.z(), flight.accuracy[3].position.z(), 1e-4);
  EXPECT_THROW(writeReconstruction(flight, town.folder / "a.txt", {}), UsageError);
  EXPECT_THROW(writeReconstruction(flight, town.folder / "a.sbet", {}), UsageError);
  EXPECT_FALSE(fs::exists(town.folder / "a.sbet"));
}

TEST(FlightReconstruction, RefusesPointsThatShowNoPath) {
  const fs::path folder = test::scratch("flight_reconstruction_none");
  auto options = simulation::SimulationOptions::preset("small", 0.3, 0.05);
  options.scene = {0.0, 0.0, 0.0};
  options.scanner.max_returns = 1;
  options.scanner.field_of_view = 1.01 * kRadiansPerDegree;
  const simulation::Simulator simulator(options);
  StripFileOptions format;
  format.folder = folder;
  writeStrip(simulator, 0, format, 1, [](double) {});
  const std::string message =
      test::messageOf<InputError>([&] { reconstructed({(folder / "strip1.las").string()}); });
  EXPECT_NE(message.find("no trajectory"), std::string::npos) << message;
}

}  // namespace
}  // namespace pcl_als
