// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/simulation_options.h>

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

double at(const SystemVector& v, SystemParameter p) {
  return v[indexOf(p)];
}

TEST(SimulationOptions, BiasesComeInInterfaceUnits) {
  SystemVector bias = SystemVector::Zero();
  setBiases("boresight_roll=-90, range_bias=0.12,scan_angle_scale=1e-4", bias);
  // 90 arcsec = 4.363323e-4 rad
  EXPECT_NEAR(at(bias, SystemParameter::boresight_roll), -4.363323e-4, 1e-10);
  EXPECT_EQ(at(bias, SystemParameter::range_bias), 0.12);
  EXPECT_EQ(at(bias, SystemParameter::scan_angle_scale), 1e-4);
  EXPECT_EQ(at(bias, SystemParameter::boresight_pitch), 0.0);
}

TEST(SimulationOptions, NamedBiasesReplaceAndNoneClears) {
  SystemVector bias = SimulationOptions::preset("small").bias;
  setBiases("range_bias=0.2", bias);
  EXPECT_EQ(at(bias, SystemParameter::range_bias), 0.2);
  EXPECT_NE(at(bias, SystemParameter::boresight_roll), 0.0);
  setBiases("none,lever_arm_z=1", bias);
  EXPECT_EQ(at(bias, SystemParameter::lever_arm_z), 1.0);
  EXPECT_EQ(bias.cwiseAbs().sum(), 1.0);
}

TEST(SimulationOptions, WrongBiasesAreNamed) {
  SystemVector bias = SystemVector::Zero();
  const auto message = [&](const char* text) { return messageOf([&] { setBiases(text, bias); }); };
  EXPECT_NE(message("roll=1").find("'roll'"), std::string::npos);
  EXPECT_NE(message("roll=1").find("boresight_roll"), std::string::npos);
  EXPECT_NE(message("range_bias=abc").find("'abc'"), std::string::npos);
  EXPECT_NE(message("range_bias=1m").find("'1m'"), std::string::npos);
  EXPECT_NE(message("range_bias").find("NAME=VALUE"), std::string::npos);
  EXPECT_NE(message("range_bias=nan").find("not a number"), std::string::npos);
  EXPECT_NE(message("range_bias=0.1,none").find("'none'"), std::string::npos);
}

TEST(SimulationOptions, PaperIsThePapersBlock) {
  const auto options = SimulationOptions::preset("paper");
  ASSERT_EQ(options.lines.size(), 6U);
  EXPECT_EQ(options.lines[0].height, 1150.0);
  EXPECT_EQ(options.lines[5].height, 540.0);
  EXPECT_EQ(options.control_points, 37);
  const auto course = [&](int i) -> Eigen::Vector2d {
    return (options.lines[i].end - options.lines[i].start).normalized();
  };
  EXPECT_EQ(course(0), -course(1));
  EXPECT_EQ(course(2), -course(3));
  EXPECT_EQ(course(3), -course(4));
  EXPECT_EQ(course(4), course(5));
  EXPECT_EQ(course(0).dot(course(2)), 0.0);
  // Overlap of neighbours: 1 - offset / swath; swaths 2 h tan 20 deg = 837.13 and 393.08 m.
  const auto overlap = [&](int a, int b, double swath) {
    const Eigen::Vector2d c = course(a), right(c.y(), -c.x());
    return 1.0 - std::abs(right.dot(options.lines[a].start - options.lines[b].start)) / swath;
  };
  EXPECT_NEAR(overlap(0, 1, 837.1315), 0.80, 1e-6);
  EXPECT_NEAR(overlap(2, 3, 393.0878), 0.25, 1e-6);
  EXPECT_NEAR(overlap(3, 4, 393.0878), 0.75, 1e-6);
  EXPECT_NEAR(overlap(4, 5, 393.0878), 0.50, 1e-6);
}

TEST(SimulationOptions, EveryPresetIsPossible) {
  for (const char* name :
       {"small", "uav", "corridor", "conical", "dual", "rosette", "mountain", "city"}) {
    const auto options = SimulationOptions::preset(name);
    EXPECT_NO_THROW(options.check()) << name;
    EXPECT_GE(options.lines.size(), 5U) << name;
    EXPECT_GE(options.pairs.size(), 2U) << name;
    // No line ends beyond the next: lines have their order.
    for (std::size_t i = 0; i < options.lines.size(); ++i)
      EXPECT_EQ(options.lines[i].id, i + 1) << name;
  }
}

TEST(SimulationOptions, CorridorStripsOverlapAtTheirEndsAndAlongABand) {
  const auto options = SimulationOptions::preset("corridor");
  ASSERT_EQ(options.lines.size(), 6U);
  const double swath = 2.0 * 200.0 * 0.5773503;  // field of view 60 degrees
  for (std::size_t i = 1; i < 4; ++i) {
    const PlannedLine &before = options.lines[i - 1], &line = options.lines[i];
    const Eigen::Vector2d a = (before.end - before.start).normalized();
    const Eigen::Vector2d b = (line.end - line.start).normalized();
    EXPECT_LT(a.dot(b), std::cos(20.0 * kRadiansPerDegree)) << "a bend";
    // Both reach 0.3 swaths beyond the corner that they share.
    EXPECT_LT((before.end - 0.3 * swath * a - line.start - 0.3 * swath * b).norm(), 1e-3);
  }
  const PlannedLine &out = options.lines[1], &back = options.lines[4];
  const Eigen::Vector2d course = (out.end - out.start).normalized();
  EXPECT_NEAR((back.end - back.start).normalized().dot(course), -1.0, 1e-9);
  const Eigen::Vector2d from = back.end - out.start;
  EXPECT_NEAR(std::abs(from.x() * course.y() - from.y() * course.x()), 0.85 * swath, 1e-3);
}

TEST(SimulationOptions, HeightMultipliesHeightsAndSpacing) {
  const auto one = SimulationOptions::preset("uav", 1.0, 1.0, 0.0, 1.0);
  const auto two = SimulationOptions::preset("uav", 1.0, 1.0, 0.0, 2.0);
  EXPECT_DOUBLE_EQ(two.lines[0].height, 150.0);
  EXPECT_NEAR((two.lines[1].end - two.lines[0].start).norm(),
              2.0 * (one.lines[1].end - one.lines[0].start).norm(), 1e-9);
}

TEST(SimulationOptions, SessionsDivideTheLinesInOrder) {
  auto options = SimulationOptions::preset("paper");
  options.setSessions(2);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(options.lines[i].session, i < 3 ? 1 : 2);
  EXPECT_NE(messageOf([&] { options.setSessions(7); }).find("sessions"), std::string::npos);
}

TEST(SimulationOptions, GradesOfTheTrajectoryKeepTheOtherNoise) {
  auto noise = NoiseOptions::named("range");
  noise.setTrajectoryGrade("mems");
  EXPECT_EQ(noise.range, 0.02);
  EXPECT_NEAR(noise.heading / kRadiansPerDegree, 0.08, 1e-12);
  EXPECT_NEAR(noise.roll_pitch / kRadiansPerDegree, 0.025, 1e-12);
  EXPECT_TRUE(noise.trajectory());
  const std::string message = messageOf([&] { noise.setTrajectoryGrade("toy"); });
  EXPECT_NE(message.find("tactical"), std::string::npos) << message;
}

TEST(SimulationOptions, GainsAreThoseOfLines) {
  auto options = SimulationOptions::preset("small");
  options.setGains("2=1.5,4=0.5");
  EXPECT_EQ(options.lines[1].gain, 1.5);
  EXPECT_EQ(options.lines[3].gain, 0.5);
  for (const char* wrong : {"9=1", "2", "2=x", "2=1000", "2=1.5x"})
    EXPECT_NE(messageOf([&] { options.setGains(wrong); }).find(wrong), std::string::npos) << wrong;
}

TEST(SimulationOptions, EveryParameterButOneHasABias) {
  // lever_arm_z cannot be told from range_bias, so it stays zero.
  const SystemVector bias = SimulationOptions::preset("paper").bias;
  for (int i = 0; i < kSystemParameterCount; ++i)
    EXPECT_EQ(bias[i] == 0.0, i == indexOf(SystemParameter::lever_arm_z));
}

TEST(SimulationOptions, ScaleAndDensityMultiply) {
  const auto one = SimulationOptions::preset("small");
  const auto other = SimulationOptions::preset("small", 0.5, 3.0);
  EXPECT_DOUBLE_EQ((other.lines[0].end - other.lines[0].start).norm(),
                   0.5 * (one.lines[0].end - one.lines[0].start).norm());
  EXPECT_DOUBLE_EQ(other.lines[0].density, 3.0 * one.lines[0].density);
}

TEST(SimulationOptions, ImpossibleValuesAreNamed) {
  EXPECT_NE(messageOf([] { SimulationOptions::preset("large"); }).find("'large'"),
            std::string::npos);
  EXPECT_NE(messageOf([] { SimulationOptions::preset("small", -1.0); }).find("scale"),
            std::string::npos);
  EXPECT_NE(messageOf([] { NoiseOptions::named("loud"); }).find("'loud'"), std::string::npos);
  auto options = SimulationOptions::preset("small");
  EXPECT_NO_THROW(options.check());
  options.lines[1].speed = 0.0;
  EXPECT_NE(messageOf([&] { options.check(); }).find("line 2: speed"), std::string::npos);
  options.lines.clear();
  EXPECT_NE(messageOf([&] { options.check(); }).find("no flight line"), std::string::npos);
}

TEST(SimulationOptions, ErrorProcessesAreNamed) {
  for (const char* name :
       {"gauss_markov", "band_limited", "random_walk", "drift", "white", "jumps"})
    EXPECT_EQ(nameOf(errorProcessNamed(name)), name);
  const std::string message = messageOf([] { errorProcessNamed("brownian"); });
  EXPECT_NE(message.find("'brownian'"), std::string::npos) << message;
  EXPECT_NE(message.find("band_limited"), std::string::npos) << message;
}

}  // namespace
