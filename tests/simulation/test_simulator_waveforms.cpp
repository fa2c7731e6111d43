// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/simulator.h>

#include "blocks.h"

namespace {

using namespace pcl_als::simulation;
using namespace pcl_als::simulation::test;
using pcl_als::UsageError;

SimulatedWaveforms firstStrip(const SimulationOptions& options, int threads, bool truth = false) {
  SimulatedWaveforms all;
  const Simulator simulator(options);
  simulator.simulateWaveforms(
      0, threads,
      [&all](const SimulatedWaveforms& chunk) {
        for (SimulatedPulse pulse : chunk.pulses) {
          pulse.point += all.points.size();
          pulse.count += all.counts.size();
          pulse.part += all.backscatter.size();
          all.pulses.push_back(pulse);
        }
        const auto append = [](auto& to, const auto& from) {
          to.insert(to.end(), from.begin(), from.end());
        };
        append(all.points, chunk.points);
        append(all.locations, chunk.locations);
        append(all.counts, chunk.counts);
        append(all.backscatter, chunk.backscatter);
      },
      truth);
  return all;
}

SimulationOptions sparse(SimulationOptions options) {
  options.lines[0].density = 0.05;
  options.waveform.emplace();
  return options;
}

TEST(SimulatorWaveforms, NeedTheOption) {
  SimulationOptions options = oneLine();
  const Simulator simulator(options);
  EXPECT_THROW(simulator.simulateWaveforms(0, 1, [](const SimulatedWaveforms&) {}), UsageError);
  options.waveform.emplace();
  options.waveform->bits = 2;
  EXPECT_THROW(Simulator{options}, UsageError);
}

TEST(SimulatorWaveforms, PointsOfAPlaneLieWhereTheirWaveformsSay) {
  SimulationOptions options = sparse(overPlane());
  options.waveform->noise = 0.0;
  const SimulatedWaveforms all = firstStrip(options, 2);
  ASSERT_GT(all.pulses.size(), 1000U);
  ASSERT_EQ(all.points.size(), all.pulses.size());
  ASSERT_EQ(all.points.size(), all.locations.size());
  double sum = 0.0;
  for (const SimulatedPulse& pulse : all.pulses) {
    const SimulatedPoint& point = all.points[pulse.point];
    EXPECT_EQ(point.return_number, 1);
    EXPECT_EQ(point.number_of_returns, 1);
    const double time = pulse.first_sample + 1e-3 * static_cast<double>(all.locations[pulse.point]);
    const Eigen::Vector3d sensor = options.origin + pulse.true_origin;
    EXPECT_NEAR((point.position - sensor).norm(), 0.5 * kLightSpeed * time, 1e-4);
    EXPECT_NEAR((point.position - sensor).normalized().dot(pulse.to_sensor), -1.0, 1e-9);
    // Reflectances that differ within the footprint move the mean of its ranges.
    EXPECT_NEAR(point.surface.z(), options.origin.z(), 0.01);
    EXPECT_NEAR(point.position.z(), point.surface.z(), 0.003);
    sum += point.position.z() - options.origin.z();
  }
  // Cubic polynomials are 1 mm above the edge of a Gaussian with samples at 0.6 standard
  // deviations.
  EXPECT_NEAR(sum / static_cast<double>(all.pulses.size()), 0.001, 0.001);
}

TEST(SimulatorWaveforms, IntensityIsThatOfDiscreteReturns) {
  SimulationOptions options = sparse(overPlane());
  options.waveform->noise = 0.0;
  const SimulatedWaveforms all = firstStrip(options, 2);
  const std::vector<SimulatedPoint> discrete = Simulator(options).strip(0, 2);
  ASSERT_EQ(all.points.size(), discrete.size());
  double relative = 0.0;
  for (std::size_t i = 0; i < discrete.size(); ++i)
    relative += all.points[i].intensity / static_cast<double>(discrete[i].intensity);
  EXPECT_NEAR(relative / static_cast<double>(discrete.size()), 1.0, 0.02);
}

TEST(SimulatorWaveforms, DoNotDependOnThreads) {
  SimulationOptions options = sparse(oneLine());
  options.noise = NoiseOptions::named("realistic");
  const SimulatedWaveforms one = firstStrip(options, 1), three = firstStrip(options, 3);
  EXPECT_EQ(one.counts, three.counts);
  EXPECT_EQ(one.locations, three.locations);
  ASSERT_EQ(one.points.size(), three.points.size());
  for (std::size_t i = 0; i < one.points.size(); ++i)
    EXPECT_EQ(one.points[i].position, three.points[i].position);
}

TEST(SimulatorWaveforms, TruthIsAllOfTheEnergy) {
  const SimulatedWaveforms all = firstStrip(sparse(oneLine()), 1, true);
  std::size_t several = 0;
  for (const SimulatedPulse& pulse : all.pulses) {
    double share = 0.0;
    for (std::size_t i = pulse.part; i < pulse.part + pulse.parts; ++i) {
      share += all.backscatter[i].share;
      if (i == pulse.part) continue;
      EXPECT_LE(all.backscatter[i - 1].range, all.backscatter[i].range);
    }
    EXPECT_NEAR(share, 1.0, 1e-9);
    several += pulse.points > 1 ? 1 : 0;
  }
  EXPECT_GT(several, all.pulses.size() / 200);  // over trees and edges of roofs
}

/// An error of the detector moves the point along its waveform, a bias the waveform with it.
TEST(SimulatorWaveforms, ErrorsOfTheDetectorDoNotMoveTheWaveform) {
  const SimulationOptions options = sparse(overPlane());
  SimulationOptions wrong = options;
  wrong.errors.add("range_walk=0.5");
  SimulationOptions biased = options;
  setBias(biased, pcl_als::SystemParameter::range_bias, 0.3);
  const SimulatedWaveforms a = firstStrip(options, 1), b = firstStrip(wrong, 1),
                           c = firstStrip(biased, 1);
  ASSERT_EQ(a.points.size(), b.points.size());
  ASSERT_EQ(a.points.size(), c.points.size());
  EXPECT_EQ(a.counts, b.counts);
  const auto anchor = [](const SimulatedWaveforms& all, const SimulatedPulse& pulse) {
    const double ns = 1e-3 * static_cast<double>(all.locations[pulse.point]);
    return Eigen::Vector3d(all.points[pulse.point].position +
                           0.5 * kLightSpeed * ns * pulse.to_sensor);
  };
  for (std::size_t i = 0; i < a.pulses.size(); ++i) {
    const Eigen::Vector3d moved = b.points[i].position - a.points[i].position;
    const double decades = std::log10(wrong.rangeWalkReference() / a.points[i].intensity);
    EXPECT_NEAR(-moved.dot(a.pulses[i].to_sensor), 0.5 * decades, 1e-6);
    EXPECT_NEAR((anchor(b, b.pulses[i]) - anchor(a, a.pulses[i])).norm(), 0.0, 1e-4);
    EXPECT_NEAR((anchor(c, c.pulses[i]) - anchor(a, a.pulses[i])).norm(), 0.3, 1e-4);
    EXPECT_EQ(a.locations[i], c.locations[i]);
  }
}

}  // namespace
