// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// Blocks whose terrain or lines leave parameters open: each is named, none is given a number that
// looks fine.
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "simulated_survey.h"

namespace pcl_als {
namespace {

using P = SystemParameter;
using simulation::NoiseOptions;
using simulation::SimulationOptions;
using test::SimulatedSurvey;

/// Lines along north at 700 m and 200 m apart, each to the north (1) or back (-1).
SimulationOptions northward(const std::vector<double>& ways) {
  SimulationOptions options = SimulationOptions::preset("small");
  options.noise = NoiseOptions::named("range");
  options.seed = 31;
  options.lines.clear();
  options.pairs.clear();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    simulation::PlannedLine line;
    line.id = static_cast<std::uint16_t>(i + 1);
    const double x = 200.0 * (static_cast<double>(i) - 1.0);
    line.start = {x, -250.0 * ways[i]};
    line.end = {x, 250.0 * ways[i]};
    line.height = 700.0;
    options.lines.push_back(line);
    for (std::uint16_t other = 1; other < line.id; ++other)
      options.pairs.emplace_back(other, line.id);
  }
  return options;
}

/// Roofs of 30 degrees whose ridges run north without an end, 30 m apart.
double gables(double x) {
  const double from_ridge = std::abs(x - 30.0 * std::floor(x / 30.0) - 15.0);
  return std::max(0.0, 5.0 - 0.577 * from_ridge);
}

/// The plane of a block with gables on it. Rays are those of the plane: a bias of 0.5 m at 700 m is
/// wrong by 4 mm on a ridge.
SimulatedSurvey gableStreet(const SimulationOptions& options) {
  SimulatedSurvey survey(options);
  const simulation::Simulator simulator(options);
  for (std::size_t i = 0; i < survey.strips.size(); ++i) {
    std::size_t k = 0;
    simulator.simulateStrip(i, 2, [&](const std::vector<simulation::SimulatedPoint>& part) {
      for (const simulation::SimulatedPoint& p : part)
        survey.strips[i][k++].position.z() += gables(p.surface.x());
    });
  }
  for (ControlPoint& control : survey.control) control.position.z() += gables(control.position.x());
  return survey;
}

void expectHonest(const CalibrationResult& result, const SystemVector& truth) {
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = result[info.parameter];
    if (estimate.status == ParameterStatus::estimated) {
      EXPECT_LT(std::abs(estimate.bias - truth[indexOf(info.parameter)]), 3.0 * estimate.std)
          << info.name << ' ' << estimate.bias << " +- " << estimate.std;
    } else {
      EXPECT_EQ(estimate.bias, 0.0) << info.name;
      EXPECT_TRUE(info.parameter == P::lever_arm_z || !estimate.reason.empty()) << info.name;
    }
  }
}

TEST(Determinability, AStreetOfParallelGables) {
  // Everything slopes across the lines: shifts along them, of the lever arm, the pitch or, at the
  // edges, the heading, move roofs into themselves.
  SimulationOptions options = northward({1.0, -1.0, 1.0});
  options.vertical = true;  // crab would turn shifts along the lines across the ridges
  options.scene.relief = options.scene.buildings = options.scene.trees = 0.0;
  const SimulatedSurvey survey = gableStreet(options);
  const CalibrationResult result = survey.calibrate(CalibrationSettings(), true, true);
  for (const P p : {P::lever_arm_y, P::boresight_pitch, P::boresight_heading})
    EXPECT_EQ(result[p].status, ParameterStatus::not_estimable) << infoOf(p).name;
  for (const P p : {P::lever_arm_x, P::boresight_roll})
    EXPECT_EQ(result[p].status, ParameterStatus::estimated) << infoOf(p).name;
  expectHonest(result, options.bias);
}

/// Lines over relief and houses, and what they leave open; the rest within its deviations.
void expectOpen(const std::vector<double>& ways, bool control, const std::vector<P>& open) {
  const SimulationOptions options = northward(ways);
  const CalibrationResult result =
      SimulatedSurvey(options).calibrate(CalibrationSettings(), control, true);
  for (const P p : open)
    EXPECT_EQ(result[p].status, ParameterStatus::not_estimable) << infoOf(p).name;
  expectHonest(result, options.bias);
}

TEST(Determinability, OneHeight) {
  expectOpen({1.0, -1.0, 1.0}, true, {});
}

TEST(Determinability, OneDirection) {
  expectOpen({1.0, 1.0, 1.0}, true, {P::lever_arm_y});
}

TEST(Determinability, OneDirectionWithoutControl) {
  // lever_arm_x is at its limit: crab turns its effect, which gives a standard deviation of 5 cm.
  expectOpen({1.0, 1.0, 1.0}, false, {P::lever_arm_y, P::range_bias});
}

TEST(Determinability, OnePair) {
  expectOpen({1.0, -1.0}, true, {});
}

TEST(Determinability, OneStripOverControl) {
  expectOpen({1.0}, true, {P::lever_arm_y});
}

}  // namespace
}  // namespace pcl_als
