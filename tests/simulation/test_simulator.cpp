// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstring>
#include <map>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/radiometry.h>

#include "blocks.h"

namespace {

using namespace pcl_als;
using namespace pcl_als::simulation;
using namespace pcl_als::simulation::test;

bool same(const SimulatedPoint& a, const SimulatedPoint& b) {
  return a.position == b.position && a.unbiased == b.unbiased && a.surface == b.surface &&
         a.time == b.time && a.scan_angle == b.scan_angle && a.reflectance == b.reflectance &&
         a.intensity == b.intensity && a.strip == b.strip && a.return_number == b.return_number &&
         a.number_of_returns == b.number_of_returns && a.classification == b.classification &&
         a.flags == b.flags;
}

bool same(const std::vector<SimulatedPoint>& a, const std::vector<SimulatedPoint>& b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](auto& p, auto& q) { return same(p, q); });
}

SimulationOptions noisyLine(std::uint64_t seed) {
  SimulationOptions options = oneLine();
  options.noise = NoiseOptions::named("realistic");
  options.bias = SimulationOptions::preset("small").bias;
  options.seed = seed;
  return options;
}

TEST(Simulator, OneThreadEqualsManyAndSeedDecides) {
  const auto one = Simulator(noisyLine(1)).strip(0, 1);
  EXPECT_TRUE(same(one, Simulator(noisyLine(1)).strip(0, 2)));
  EXPECT_TRUE(same(one, Simulator(noisyLine(1)).strip(0, 5)));
  EXPECT_FALSE(same(one, Simulator(noisyLine(2)).strip(0, 1)));
}

TEST(Simulator, ChunksComeInOrderAndAreBounded) {
  const Simulator simulator(noisyLine(1));
  std::vector<SimulatedPoint> all;
  std::size_t chunks = 0;
  simulator.simulateStrip(0, 3, [&](const std::vector<SimulatedPoint>& points) {
    ++chunks;
    ASSERT_LE(points.size(), 16384U * 5U);
    all.insert(all.end(), points.begin(), points.end());
  });
  EXPECT_EQ(chunks, (simulator.pulseCount(0) + 16383) / 16384);
  EXPECT_TRUE(same(all, simulator.strip(0, 1)));
  EXPECT_THROW(simulator.strip(1), UsageError);
}

TEST(Simulator, OriginMovesTheBlockAndNothingElse) {
  SimulationOptions options = noisyLine(1);
  const auto here = Simulator(options).strip(0);
  const Eigen::Vector3d shift(-116606.0, -376900.0, -502.0);
  options.origin += shift;
  const auto there = Simulator(options).strip(0);
  ASSERT_EQ(here.size(), there.size());
  for (std::size_t i = 0; i < here.size(); ++i) {
    // A step of double at 5.6e6 m is 1e-9 m; three sums.
    ASSERT_LT((there[i].position - here[i].position - shift).norm(), 5e-9);
    ASSERT_EQ(here[i].intensity, there[i].intensity);
  }
}

TEST(Simulator, IntensityFollowsTheRadarEquation) {
  const Simulator simulator(oneLine());
  const auto& options = simulator.options();
  const auto trajectory = simulator.trueTrajectory();
  std::size_t checked = 0;
  for (const SimulatedPoint& p : simulator.strip(0)) {
    if (p.classification != 2 || p.number_of_returns != 1) continue;
    const double place = (p.time - trajectory.front().time) * options.trajectory_rate;
    const auto k = static_cast<std::size_t>(place);
    const Eigen::Vector3d sensor =
        trajectory[k].position +
        (place - static_cast<double>(k)) * (trajectory[k + 1].position - trajectory[k].position);
    const Eigen::Vector3d beam = p.surface - sensor;
    const Eigen::Vector3d local = p.surface - options.origin;
    const double cosine =
        -simulator.scene().terrain().normal(local.x(), local.y()).dot(beam.normalized());
    // 10000 at 1000 m; visibility 48.3 km: 3.91 / 48.3 * 0.42409 + 8e-4 * 1.0043 * 0.95127 / km.
    const double extinction = 0.0343309 + 0.00076427;
    const double km = beam.norm() / 1000.0;
    const double expected =
        10000.0 * p.reflectance * cosine / (km * km) * std::exp(-2.0 * extinction * km);
    // Half a digit of rounding; single ground echoes only, but one under leaves lost energy.
    if (std::abs(p.intensity - expected) > 0.51 + 1e-4 * expected) continue;
    ++checked;
  }
  EXPECT_GT(checked, 30000U);
}

TEST(Simulator, EchoesOfAPulseShareItsEnergy) {
  // No leaf clump may return more than its opacity lets it: signal <= share * rho * 0.5.
  const Simulator simulator(oneLine());
  std::size_t split = 0;
  for (const SimulatedPoint& p : simulator.strip(0)) {
    if (p.number_of_returns < 2) continue;
    ++split;
    const double full = 10000.0 * p.reflectance / std::pow(0.45, 2.0);  // nearest range 450 m
    ASSERT_LT(p.intensity, full);
    ASSERT_GT(p.intensity, 0);
  }
  EXPECT_GT(split, 500U);
}

TEST(Simulator, ReflectanceTellsTheCoversApart) {
  std::map<int, std::pair<double, int>> sums;
  for (const SimulatedPoint& p : Simulator(oneLine()).strip(0)) {
    sums[p.classification].first += p.reflectance;
    ++sums[p.classification].second;
  }
  const auto mean = [&](int c) { return sums[c].first / sums[c].second; };
  EXPECT_LT(mean(11), mean(6));
  EXPECT_LT(mean(6), mean(2));
  EXPECT_LT(mean(2), mean(5));
}

TEST(Simulator, ControlLiesOnBareGroundUnderSeveralStrips) {
  const Simulator simulator(SimulationOptions::preset("small"));
  const auto control = simulator.controlPoints();
  ASSERT_EQ(control.size(), 37U);
  const Scene& scene = simulator.scene();
  for (const ControlPoint& point : control) {
    const Eigen::Vector3d local = point.position - simulator.options().origin;
    EXPECT_NEAR(local.z(), scene.terrain().height(local.x(), local.y()), 1e-8);
    EXPECT_TRUE(scene.isOpen(Eigen::Vector2d(local.head<2>()), 5.0));
    EXPECT_EQ(point.sigma, 0.0);
  }
  EXPECT_EQ(control.front().id, "GCP01");
}

TEST(Simulator, ControlNoiseIsPutInAndStated) {
  SimulationOptions options = SimulationOptions::preset("small");
  options.noise.control = 0.01;
  const Simulator simulator(options);
  double square = 0.0;
  const auto control = simulator.controlPoints();
  for (const ControlPoint& point : control) {
    const Eigen::Vector3d local = point.position - options.origin;
    square += std::pow(local.z() - simulator.scene().terrain().height(local.x(), local.y()), 2);
    EXPECT_EQ(point.sigma, 0.01);
  }
  EXPECT_NEAR(std::sqrt(square / control.size()), 0.01, 0.004);  // 37 values: 12 %
}

TEST(Simulator, LandCoverSitesAreWhatTheySay) {
  const Simulator simulator(SimulationOptions::preset("small"));
  const auto training = simulator.landCoverSites(40, 0), check = simulator.landCoverSites(40, 1);
  std::map<std::string_view, int> count;
  for (const LandCoverSite& site : training) {
    ++count[classNameOf(site.cover)];
    const double x = site.x - simulator.options().origin.x();
    const double y = site.y - simulator.options().origin.y();
    EXPECT_EQ(simulator.scene().topCover(x, y), site.cover);
  }
  EXPECT_EQ(count.size(), 4U);
  for (const auto& [name, sites] : count) EXPECT_EQ(sites, 40) << name;
  EXPECT_NE(training.front().x, check.front().x);
}

TEST(Simulator, PlannedPairsOverlap) {
  // Share of the second line's ground points that lie in the bounding box of the first.
  const auto options = SimulationOptions::preset("paper", 0.2, 0.02);
  const Simulator simulator(options);
  std::vector<std::vector<SimulatedPoint>> strips;
  for (std::size_t i = 0; i < simulator.stripCount(); ++i) strips.push_back(simulator.strip(i));
  const auto overlap = [&](int a, int b, int axis) {
    double low = 1e30, high = -1e30;
    for (const auto& p : strips[a]) {
      low = std::min(low, p.position[axis]);
      high = std::max(high, p.position[axis]);
    }
    std::size_t inside = 0;
    for (const auto& p : strips[b])
      inside += p.position[axis] >= low && p.position[axis] <= high ? 1 : 0;
    return static_cast<double>(inside) / strips[b].size();
  };
  // Roll (half a degree of 20), sway and relief (50 m of 540) move the edges.
  EXPECT_NEAR(overlap(0, 1, 0), 0.80, 0.06);
  EXPECT_NEAR(overlap(2, 3, 1), 0.25, 0.10);
  EXPECT_NEAR(overlap(3, 4, 1), 0.75, 0.10);
  EXPECT_NEAR(overlap(4, 5, 1), 0.50, 0.10);
}

TEST(Simulator, RefusesImpossibleOptions) {
  SimulationOptions options = oneLine();
  options.noise.range = -1.0;
  EXPECT_THROW(Simulator{options}, UsageError);
}

}  // namespace
