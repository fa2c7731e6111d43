// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <fstream>
#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include <pcl_als/calibration/impl/system_calibration.hpp>
#include <pcl_als/common/errors.h>
#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/survey_io.h>

#include "own_point.h"
#include "simulated_strips.h"
#include "simulated_survey.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using simulation::SimulationOptions;
using test::SimulatedStrips;
using test::SimulatedSurvey;

/// A small block with errors of trajectory and points, of which only the path is used.
SimulationOptions smallBlock() {
  SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.7);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = 3;
  return options;
}

const SimulatedStrips& strips() {
  static const SimulatedStrips made(smallBlock());
  return made;
}

const std::vector<ControlPoint>& control() {
  static const std::vector<ControlPoint> points =
      simulation::Simulator(smallBlock()).controlPoints();
  return points;
}

/// Enough for what is compared here, in a fifth of the time.
CalibrationOptions quickOptions(std::vector<ControlPoint> points = {}) {
  CalibrationOptions options;
  options.settings.candidates = 20'000;
  options.control = std::move(points);
  return options;
}

template <typename PointT>
void addStrips(SystemCalibration<PointT>& calibration) {
  for (const test::SimulatedStrip& made : strips().strips)
    calibration.addInputStrip(test::cloudOf<PointT>(*made.strip.cloud), made.strip.frame,
                              made.strip.id);
  calibration.setTrajectory(strips().flight);
  calibration.setOptions(quickOptions(control()));
}

const CalibrationResult& fromClouds() {
  static const CalibrationResult result = [] {
    SystemCalibration<PointLidar> calibration;
    addStrips(calibration);
    calibration.calibrate();
    return calibration.getResult();
  }();
  return result;
}

/// Everything that is written of a result, except the names of its inputs: 17 digits a number.
std::string textOf(CalibrationResult result) {
  result.inputs.clear();
  const fs::path path = test::scratch("calibration_text") / "calibration.json";
  writeCalibration(path, result);
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(SystemCalibration, IsWithinItsIntervalsOfTheTruth) {
  const CalibrationResult& result = fromClouds();
  ASSERT_TRUE(result.converged);
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  int estimated = 0;
  double largest = 0.0;  // of the biases, in standard deviations: what was there to be found
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    if (estimate.status != ParameterStatus::estimated) continue;
    const double truth = smallBlock().bias[indexOf(info.parameter)];
    EXPECT_LT(std::abs(estimate.bias - truth), 4.0 * estimate.std) << info.name;
    largest = std::max(largest, std::abs(truth) / estimate.std);
    ++estimated;
  }
  EXPECT_GE(estimated, 4);
  EXPECT_GT(largest, 4.0);
}

TEST(SystemCalibration, EqualsTheCalibrationOfPcdFilesToTheLastBit) {
  const fs::path folder = test::scratch("calibration_of_clouds");
  std::vector<std::string> files;
  for (const test::SimulatedStrip& made : strips().strips) {
    files.push_back((folder / ("strip" + made.strip.id + ".pcd")).string());
    savePcd(files.back(), made.strip);
  }
  SurveyReader survey(files, 0);
  const SurveyCalibration of_files =
      calibrateSurvey(survey, strips().flight, quickOptions(control()));
  EXPECT_EQ(textOf(of_files.result), textOf(fromClouds()));
  EXPECT_EQ(of_files.result.inputs, files);
  EXPECT_EQ(fromClouds().inputs.front(), "strip 1");
}

TEST(SystemCalibration, TakesAPointTypeOfOnesOwn) {
  SystemCalibration<test::OwnPoint> calibration;
  addStrips(calibration);
  calibration.calibrate();
  EXPECT_TRUE(calibration.hasConverged());
  EXPECT_EQ(textOf(calibration.getResult()), textOf(fromClouds()));
}

TEST(SystemCalibration, RoundingToFloatsIsWithinTheStandardDeviation) {
  const SimulatedSurvey survey(smallBlock());
  const CalibrationResult exact =
      survey.calibrate(quickOptions().settings);  // of double coordinates
  SystemCalibration<PointLidar> calibration;
  const LocalFrame frame = LocalFrame::around(smallBlock().origin);
  for (std::size_t i = 0; i < survey.strips.size(); ++i) {
    pcl::PointCloud<PointLidar>::Ptr cloud(new pcl::PointCloud<PointLidar>);
    for (const LidarReturn& p : survey.strips[i]) {
      PointLidar& point = cloud->emplace_back();
      point.getVector3fMap() = frame.toLocal(p.position);
      point.gps_time = p.time;
      point.return_number = p.return_number;
      point.number_of_returns = p.number_of_returns;
    }
    calibration.addInputStrip(cloud, frame, std::to_string(i + 1));
  }
  calibration.setOptions(quickOptions(survey.control));
  calibration.setTrajectory(survey.flight(false));
  calibration.calibrate();
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate &one = exact[info.parameter],
                            &other = calibration.getResult()[info.parameter];
    ASSERT_EQ(one.status, other.status) << info.name;
    // Rounding by 0.1 mm moves no pair by more, but points at the border of a class of orientation
    // change places, and every so manyth of a class is chosen: another sample of the same surfaces.
    // 0.3 standard deviations of this small block at most when this was written.
    EXPECT_NEAR(one.bias, other.bias, one.std) << info.name;
  }
}

/// Two strips, with a further part of one and points that are not finite: what was read is told in
/// the result.
TEST(SystemCalibration, JoinsPartsAndLeavesOutPointsThatAreNotFinite) {
  SystemCalibration<PointLidar> whole, parts;
  for (const test::SimulatedStrip& made : strips().strips) {
    pcl::PointCloud<PointLidar>::Ptr first(new pcl::PointCloud<PointLidar>),
        second(new pcl::PointCloud<PointLidar>);
    const auto& points = *made.strip.cloud;
    const LocalFrame& frame = made.strip.frame;
    // The attitude is taken from every 16th and 32nd point of a part: here the same ones.
    const std::size_t half = points.size() / 64 * 32;
    for (std::size_t i = 0; i < points.size(); ++i)
      (i < half ? first : second)->push_back(points[i]);
    PointLidar invalid;
    invalid.x = std::numeric_limits<float>::quiet_NaN();
    second->push_back(invalid);
    whole.addInputStrip(made.strip.cloud, frame, made.strip.id);
    parts.addInputStrip(first, frame, made.strip.id);
    parts.addInputStrip(second, frame, made.strip.id);
  }
  for (SystemCalibration<PointLidar>* calibration : {&whole, &parts}) {
    calibration->setTrajectory(strips().flight);
    CalibrationOptions options = quickOptions();
    options.settings.estimate = {SystemParameter::boresight_roll};
    calibration->setOptions(options);
    calibration->calibrate();
    EXPECT_EQ((*calibration).getResult()[SystemParameter::boresight_pitch].status,
              ParameterStatus::fixed);
  }
  EXPECT_EQ(textOf(whole.getResult()), textOf(parts.getResult()));
}

TEST(SystemCalibration, AlignsTimes) {
  constexpr double kLater = 131072.0;  // seconds: a sum that a double holds to 3e-11 s
  SystemCalibration<PointLidar> calibration;
  for (const test::SimulatedStrip& made : strips().strips) {
    pcl::PointCloud<PointLidar>::Ptr cloud(new pcl::PointCloud<PointLidar>(*made.strip.cloud));
    for (PointLidar& point : *cloud) point.gps_time += kLater;
    calibration.addInputStrip(cloud, made.strip.frame, made.strip.id);
  }
  calibration.setTrajectory(strips().flight);
  calibration.setOptions(quickOptions(control()));
  EXPECT_NE(test::messageOf<InputError>([&] { calibration.calibrate(); }).find("no strip is left"),
            std::string::npos);
  EXPECT_FALSE(calibration.hasConverged());
  TimeAlignment alignment;
  alignment.offset = -kLater;
  calibration.setTimeAlignment(alignment);
  calibration.calibrate();
  EXPECT_NEAR(calibration.getResult()[SystemParameter::boresight_roll].bias,
              fromClouds()[SystemParameter::boresight_roll].bias, 1e-9);
}

TEST(SystemCalibration, IsCancelledByItsCallback) {
  SystemCalibration<PointLidar> calibration;
  addStrips(calibration);
  std::vector<std::string> phases;
  calibration.setProgressCallback([&](const JobProgress& progress) {
    if (phases.empty() || phases.back() != progress.phase) phases.push_back(progress.phase);
    return progress.phase != "Reading the areas";
  });
  EXPECT_THROW(calibration.calibrate(), Cancelled);
  EXPECT_GE(phases.size(), 2U);
  EXPECT_THROW(calibration.getResult(), UsageError);
}

TEST(SystemCalibration, RefusesWhatIsMissingOrWrong) {
  SystemCalibration<PointLidar> calibration;
  EXPECT_THROW(calibration.getResult(), UsageError);
  EXPECT_THROW(calibration.addInputStrip(nullptr, LocalFrame(), "1"), UsageError);
  EXPECT_THROW(calibration.calibrate(), UsageError);  // no strips
  pcl::PointCloud<PointLidar>::Ptr cloud(new pcl::PointCloud<PointLidar>);
  EXPECT_THROW(calibration.addInputStrip(cloud, LocalFrame(), ""), UsageError);
  calibration.addInputStrip(cloud, LocalFrame(), "empty");
  EXPECT_THROW(calibration.calibrate(), UsageError);  // no trajectory
  calibration.setTrajectory(strips().flight);
  EXPECT_THROW(calibration.calibrate(), InputError);  // no points
  // Map coordinates as floats, without a frame.
  cloud->push_back(PointLidar(432000.0F, 5450000.0F, 100.0F));
  const std::string text = test::messageOf<InputError>([&] { calibration.calibrate(); });
  EXPECT_NE(text.find("strip empty: its coordinates are floats"), std::string::npos) << text;
}

}  // namespace
}  // namespace pcl_als
