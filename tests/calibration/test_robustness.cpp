// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// What a survey contains that a calibration must not believe.
#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "simulated_survey.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using simulation::NoiseOptions;
using simulation::SimulationOptions;
using test::SimulatedSurvey;

/// Each test damages a copy of the same block, whose calibration is done once.
class Robustness : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    SimulationOptions options = SimulationOptions::preset("small", 1.0, 0.6);
    options.noise = NoiseOptions::named("realistic");
    options.seed = 21;
    clean = std::make_unique<SimulatedSurvey>(options);
    undamaged = calibrated(*clean);
    ASSERT_TRUE(undamaged.converged);
  }
  static void TearDownTestSuite() { clean.reset(); }

  /// Parameters stay where they are, to one standard deviation (the largest move is 0.43).
  static void expectSame(const CalibrationResult& damaged) {
    EXPECT_TRUE(damaged.converged);
    for (const SystemParameterInfo& info : systemParameters()) {
      const ParameterEstimate& before = undamaged[info.parameter];
      const ParameterEstimate& after = damaged[info.parameter];
      ASSERT_EQ(after.status, before.status) << info.name;
      if (before.status != ParameterStatus::estimated) continue;
      EXPECT_LT(std::abs(after.bias - before.bias), before.std)
          << info.name << " moved by " << (after.bias - before.bias) / before.std
          << " standard deviations";
      EXPECT_LT(std::abs(after.bias - clean->bias[indexOf(info.parameter)]), 3.0 * after.std)
          << info.name;
    }
  }

  static CalibrationResult calibrated(const SimulatedSurvey& survey) {
    return survey.calibrate(CalibrationSettings(), true, true);
  }

  static std::unique_ptr<SimulatedSurvey> clean;
  static CalibrationResult undamaged;
};
std::unique_ptr<SimulatedSurvey> Robustness::clean;
CalibrationResult Robustness::undamaged;

/// A number in [0, 1) that belongs to a square of the ground and a strip.
double chance(const Eigen::Vector3d& position, double square, std::size_t strip) {
  const auto column = static_cast<std::uint64_t>(std::floor(position.x() / square));
  const auto row = static_cast<std::uint64_t>(std::floor(position.y() / square));
  std::mt19937_64 random(column * 73856093U ^ row * 19349663U ^ (strip + 1) * 83492791U);
  random.discard(3);
  return std::uniform_real_distribution<double>()(random);
}

TEST_F(Robustness, ThreeInTenPairsToChangedGround) {
  // Crops grown and soil moved between strips: 30 % of all 15 m squares of every other strip are
  // higher by 0.2 to 1 m, so that 30 % of all pairs between neighbours are wrong together.
  SimulatedSurvey survey = *clean;
  for (std::size_t strip = 0; strip < survey.strips.size(); strip += 2) {
    for (LidarReturn& point : survey.strips[strip]) {
      const double draw = chance(point.position, 15.0, strip);
      if (draw < 0.3) point.position.z() += 0.2 + 0.8 * draw / 0.3;
    }
  }
  expectSame(calibrated(survey));
}

TEST_F(Robustness, ThreeInTenPointsInVegetation) {
  // Undergrowth that came back as single returns, up to 1.5 m above the ground.
  SimulatedSurvey survey = *clean;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform;
  for (std::size_t strip = 0; strip < survey.strips.size(); ++strip) {
    for (LidarReturn& point : survey.strips[strip]) {
      const bool overgrown = chance(point.position, 20.0, 0) < 0.4;  // the same places in all
      if (overgrown && uniform(random) < 0.75) point.position.z() += 1.5 * uniform(random);
    }
  }
  expectSame(calibrated(survey));
}

TEST_F(Robustness, MovingCarsAndWalls) {
  // Boxes of 5 m and 1.6 m height on 8 % of the ground, elsewhere in every strip.
  SimulatedSurvey survey = *clean;
  for (std::size_t strip = 0; strip < survey.strips.size(); ++strip) {
    for (LidarReturn& point : survey.strips[strip]) {
      if (chance(point.position, 5.0, strip) < 0.08) point.position.z() += 1.6;
    }
  }
  expectSame(calibrated(survey));
}

TEST_F(Robustness, WaterWithHolesAndStrayReturns) {
  // Ponds of 40 m on a sixth of the ground: one return in fifty, and that from below the surface.
  SimulatedSurvey survey = *clean;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> uniform;
  for (auto& strip : survey.strips) {
    std::vector<LidarReturn> kept;
    for (LidarReturn point : strip) {
      if (chance(point.position, 40.0, 0) < 1.0 / 6.0) {
        if (uniform(random) > 0.02) continue;
        point.position.z() -= 2.0 * uniform(random);
      }
      kept.push_back(point);
    }
    strip = kept;
  }
  expectSame(calibrated(survey));
}

TEST_F(Robustness, ControlOutsideTheBlockSaysNothing) {
  SimulatedSurvey survey = *clean;
  for (ControlPoint& point : survey.control) point.position.x() += 15000.0;
  const CalibrationResult result = calibrated(survey);
  EXPECT_EQ(result[P::range_bias].status, ParameterStatus::not_estimable);
  EXPECT_FALSE(result[P::range_bias].reason.empty());
  const auto about_control = [](const Warning& warning) {
    return warning.text.find("control") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(result.warnings.begin(), result.warnings.end(), about_control));
  EXPECT_NEAR(result[P::boresight_roll].bias, clean->bias[indexOf(P::boresight_roll)],
              3.0 * result[P::boresight_roll].std);
}

TEST_F(Robustness, ControlOfAnotherRegionIsRefused) {
  SimulatedSurvey survey = *clean;
  for (ControlPoint& point : survey.control) point.position.x() += 50000.0;
  EXPECT_THROW(calibrated(survey), InputError);
}

TEST_F(Robustness, AWrongControlPointIsOutvoted) {
  SimulatedSurvey survey = *clean;
  survey.control.front().position.z() += 1.0;  // a typing error
  expectSame(calibrated(survey));
}

TEST_F(Robustness, ATrajectoryOfAnotherFlightAtTheSameTimesIsRefused) {
  SimulatedSurvey survey = *clean;
  for (TrajectorySample& sample : survey.trajectory) sample.position.x() += 5000.0;
  EXPECT_THROW(calibrated(survey), InputError);
  survey = *clean;
  for (TrajectorySample& sample : survey.trajectory) sample.position.z() -= 2000.0;
  EXPECT_THROW(calibrated(survey), InputError);
}

TEST_F(Robustness, AClockWithoutLeapSecondsIsRefused) {
  SimulatedSurvey survey = *clean;  // UTC in place of GPS time: a kilometre along the flight
  for (TrajectorySample& sample : survey.trajectory) sample.time += 18.0;
  EXPECT_THROW(calibrated(survey), InputError);
}

}  // namespace
}  // namespace pcl_als
