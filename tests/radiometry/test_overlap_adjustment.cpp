// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/radiometry/overlap_adjustment.h>
#include <pcl_als/radiometry/radiometric_cells.h>

namespace pcl_als {
namespace {

/// What the receiver of the simulated cells does; the law is written out here once more.
struct Truth {
  double range_power = 2.0, cosine_power = 1.0, extinction = 0.0;
  std::vector<double> gains = {1.0, 1.0, 1.0};
};

struct Scene {
  std::vector<double> heights = {500.0, 500.0, 1200.0};
  double steepest = 0.5;  ///< largest slope, tangent
  double noise = 0.0;     ///< relative, of a cell's mean
  double texture = 0.0;   ///< relative, shared by the cells of 40 m and one strip
  unsigned seed = 1;
};

/// Cells of 2 m under parallel lines at x = 0, 150 and 80 m.
std::vector<SharedCell> cellsOf(const Truth& truth, const Scene& scene) {
  std::mt19937 random(scene.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const std::array<double, 3> lines = {0.0, 150.0, 80.0};
  std::vector<SharedCell> cells;
  for (std::int32_t row = 0; row < 100; row += 4) {
    for (std::int32_t column = 0; column < 100; column += 2) {
      SharedCell cell;
      cell.row = row, cell.column = column;
      const double x = 2.0 * column, reflectance = 0.2 + 0.15 * (1.0 + uniform(random));
      const Eigen::Vector3d up =
          Eigen::Vector3d(scene.steepest * uniform(random), scene.steepest * uniform(random), 1.0)
              .normalized();
      for (std::size_t s = 0; s < lines.size(); ++s) {
        const Eigen::Vector3d to_sensor(lines[s] - x, 0.0, scene.heights[s]);
        const double range = to_sensor.norm(), cosine = up.dot(to_sensor) / range;
        const auto area = static_cast<unsigned>(row / 20 * 1000 + column / 20 * 10) +
                          static_cast<unsigned>(s) + 100000U * scene.seed;
        std::mt19937 of_area(area);
        std::normal_distribution<double> shared(0.0, scene.texture);
        double number = 3e9 * truth.gains[s] * reflectance * std::pow(cosine, truth.cosine_power) /
                        std::pow(range, truth.range_power) *
                        std::exp(-2.0 * truth.extinction * range / 1000.0);
        number *=
            std::exp(scene.noise * normal(random) + (scene.texture > 0 ? shared(of_area) : 0));
        cell.views.push_back({static_cast<int>(s), 6.0, number, range, cosine});
      }
      cells.push_back(cell);
    }
  }
  return cells;
}

const std::vector<std::string> kStrips = {"a", "b", "c"};

OverlapSettings asked(bool range, bool incidence, bool extinction, bool gains) {
  OverlapSettings settings;
  settings.estimate = {range, incidence, extinction};
  settings.estimate_gains = gains;
  return settings;
}

TEST(OverlapAdjustment, GainsOfTwoStripsByHand) {
  // One strip sees 200, the other 50 in every cell, same range, same angle: gains 2 and 1/2.
  std::vector<SharedCell> cells;
  cells.reserve(60);
  for (std::int32_t i = 0; i < 60; ++i)
    cells.push_back({i, 0, {{0, 5.0, 200.0, 1000.0, 1.0}, {1, 5.0, 50.0, 1000.0, 1.0}}});
  const OverlapResult result =
      adjustOverlaps(cells, 2.0, {"1", "2"}, RadiometricModel(), asked(false, false, false, true));
  EXPECT_NEAR(result.gains[0].value, 2.0, 1e-9);
  EXPECT_NEAR(result.gains[1].value, 0.5, 1e-9);
  // 200 and 50: mean 125, standard deviation 150 / sqrt 2 = 106.07, ratio 0.8485.
  EXPECT_NEAR(result.before.median, 0.8485, 1e-4);
  EXPECT_NEAR(result.after.rms, 0.0, 1e-9);
  EXPECT_TRUE(result.reliable());
}

TEST(OverlapAdjustment, FindsWhatTheReceiverDoes) {
  Truth truth;
  truth.range_power = 1.7;
  truth.cosine_power = 0.8;
  truth.gains = {1.2, 0.9, 1.0};
  const auto cells = cellsOf(truth, Scene());
  const OverlapResult result =
      adjustOverlaps(cells, 2.0, kStrips, RadiometricModel(), asked(true, true, false, true));
  // No noise: what is left is rounding, and the weights' tolerance of 1e-6.
  EXPECT_NEAR(result.terms[0].value, 1.7, 1e-5);
  EXPECT_NEAR(result.terms[1].value, 0.8, 1e-5);
  const double mean = std::cbrt(1.2 * 0.9 * 1.0);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(result.gains[i].value, truth.gains[i] / mean, 1e-5);
  // The test would be worth nothing if the start were as good.
  EXPECT_GT(result.physics.median, 0.05);
  EXPECT_LT(result.after.rms, 1e-5);
}

TEST(OverlapAdjustment, TwoHeightsGiveTheExtinctionWhenGainsAreKnown) {
  Truth truth;
  truth.extinction = 0.25;
  const OverlapResult result = adjustOverlaps(cellsOf(truth, Scene()), 2.0, kStrips,
                                              RadiometricModel(), asked(false, true, true, false));
  EXPECT_NEAR(result.terms[2].value, 0.25, 1e-5);
  EXPECT_EQ(result.terms[2].status, TermStatus::estimated);
  EXPECT_EQ(result.terms[0].status, TermStatus::fixed);
}

TEST(OverlapAdjustment, SaysWhatOneHeightCannotTell) {
  Scene scene;
  scene.heights = {500.0, 500.0, 500.0};
  scene.noise = 0.03;
  const OverlapResult result = adjustOverlaps(cellsOf(Truth(), scene), 2.0, kStrips,
                                              RadiometricModel(), asked(true, true, true, true));
  EXPECT_EQ(result.terms[2].status, TermStatus::not_estimable);
  EXPECT_NE(result.terms[2].reason.find("cannot be separated from"), std::string::npos)
      << result.terms[2].reason;
  EXPECT_EQ(result.model.extinction_per_km, 0.0);  // as given
  EXPECT_FALSE(result.reliable());
  EXPECT_EQ(result.terms[1].status, TermStatus::estimated);
}

TEST(OverlapAdjustment, LevelGroundDoesNotTellRangeFromIncidence) {
  Scene scene;
  scene.heights = {500.0, 500.0, 500.0};
  scene.steepest = 0.0;  // cos is a function of range there
  scene.noise = 0.02;
  const OverlapResult result = adjustOverlaps(cellsOf(Truth(), scene), 2.0, kStrips,
                                              RadiometricModel(), asked(true, true, false, true));
  EXPECT_FALSE(result.terms[0].status == TermStatus::estimated &&
               result.terms[1].status == TermStatus::estimated);
  EXPECT_FALSE(result.reliable());
}

TEST(OverlapAdjustment, StandardDeviationsCoverErrorsThatAreasShare) {
  // 30 blocks, errors shared by 40 m: the formal ones are too small by more than twice, the
  // clustered ones cover. 120 normalised errors of 4 parameters: their RMS is 1 +- 0.09 if they
  // were independent (they are not: gains sum to zero), so 0.7 to 1.35 are 3 of those and more.
  double squares = 0.0, formal = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    Scene scene;
    scene.seed = seed;
    scene.noise = 0.03;
    scene.texture = 0.02;
    const OverlapResult result = adjustOverlaps(
        cellsOf(Truth(), scene), 2.0, kStrips, RadiometricModel(), asked(false, true, false, true));
    const auto add = [&](double error, const EstimatedTerm& term) {
      squares += std::pow(error / term.std, 2);
      formal += std::pow(error / term.std_formal, 2);
      ++count;
    };
    add(result.terms[1].value - 1.0, result.terms[1]);
    for (const EstimatedTerm& gain : result.gains) add(std::log(gain.value), gain);
  }
  EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.35);
  EXPECT_GT(std::sqrt(formal / count), 2.0);
}

TEST(OverlapAdjustment, FewAreasKnowTheirScatterBadly) {
  // Five areas of 40 m: the scatter of five gives deviations with which errors have Student's
  // distribution, a fifth or more wider than they say.
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 150; ++seed) {
    Scene scene;
    scene.noise = 0.005, scene.texture = 0.03, scene.seed = seed;
    std::vector<SharedCell> cells = cellsOf(Truth(), scene);
    cells.erase(
        std::remove_if(cells.begin(), cells.end(), [](const auto& c) { return c.row >= 20; }),
        cells.end());
    const OverlapResult result =
        adjustOverlaps(cells, 2.0, kStrips, RadiometricModel(), asked(false, false, false, true));
    for (const EstimatedTerm& gain : result.gains) {
      const double z = std::log(gain.value) / gain.std;
      sum += z * z, ++count;
    }
  }
  EXPECT_LT(std::sqrt(sum / count), 1.28);  // 1.17; taken as they are 1.39
}

TEST(OverlapAdjustment, GrossErrorsDoNotMoveIt) {
  Scene scene;
  scene.noise = 0.02;
  auto cells = cellsOf(Truth(), scene);
  for (std::size_t i = 0; i < cells.size(); i += 20) cells[i].views[0].intensity *= 4.0;  // a car
  const OverlapResult result =
      adjustOverlaps(cells, 2.0, kStrips, RadiometricModel(), asked(false, false, false, true));
  // 5 % of cells of 1250 wrong: Huber's weights leave a bias of 0.05 * 1.5 * 0.02 / 0.87, times
  // 2/3.
  EXPECT_NEAR(std::log(result.gains[0].value), 0.0, 0.003);
}

TEST(OverlapAdjustment, StripsWithoutOverlapAreNamed) {
  auto cells = cellsOf(Truth(), Scene());
  for (SharedCell& cell : cells) cell.views.pop_back();
  const OverlapResult result =
      adjustOverlaps(cells, 2.0, kStrips, RadiometricModel(), asked(false, false, false, true));
  EXPECT_EQ(result.gains[2].status, TermStatus::not_estimable);
  EXPECT_FALSE(result.gains[2].reason.empty());
  EXPECT_EQ(result.gainFactors()[2], 1.0);
  EXPECT_EQ(result.gains[0].status, TermStatus::estimated);
  EXPECT_FALSE(result.warnings.empty());
}

TEST(OverlapAdjustment, TooFewCellsAreSaid) {
  auto cells = cellsOf(Truth(), Scene());
  cells.resize(10);
  const OverlapResult result =
      adjustOverlaps(cells, 2.0, kStrips, RadiometricModel(), asked(true, false, false, true));
  EXPECT_FALSE(result.reliable());
  EXPECT_NE(result.terms[0].reason.find("only 10"), std::string::npos);
  EXPECT_EQ(result.model.range_exponent, 2.0);
}

TEST(RadiometricCells, MeansOfSmoothCellsOnly) {
  RadiometricCells cells(2.0);
  PointRadiometry point;
  point.status = RadiometryStatus::surface;
  point.range = 800.0F;
  point.beam = {0.0F, 0.0F, -1.0F};
  LocalSurface surface;
  surface.normal = {0.0F, 0.6F, 0.8F};
  surface.support = 9;
  const auto add = [&](int strip, double x, double intensity) {
    cells.add(strip, x, 5660000.5, intensity, intensity > 0.0, point, surface);
  };
  for (const int strip : {0, 1}) {
    for (const double intensity : {90.0, 100.0, 110.0}) {
      add(strip, 700000.5, intensity);
      add(strip, 700002.5, intensity);
    }
  }
  for (int i = 0; i < 3; ++i) add(1, 700002.5, 0.0);  // half of its points were not received
  const std::vector<SharedCell> shared = cells.shared();
  ASSERT_EQ(shared.size(), 1U);
  EXPECT_EQ(shared[0].column, 350000);
  EXPECT_EQ(shared[0].row, 2830000);
  ASSERT_EQ(shared[0].views.size(), 2U);
  EXPECT_NEAR(shared[0].views[1].intensity, 100.0, 1e-9);
  EXPECT_NEAR(shared[0].views[1].range, 800.0, 1e-9);
  EXPECT_NEAR(shared[0].views[1].cosine, 0.8, 1e-6);
}

TEST(RadiometricCells, KeepsTheSameShareOfCellsForAllStrips) {
  const RadiometricCells all(2.0), some(2.0, 10);
  int kept = 0;
  for (int i = 0; i < 20000; ++i) {
    const int column = i % 200, row = i / 200;
    const double x = 700000.0 + 2.0 * column, y = 5660000.0 + 2.0 * row;
    EXPECT_TRUE(all.wants(x, y));
    kept += some.wants(x, y);
    EXPECT_EQ(some.wants(x, y), some.wants(x + 1.9, y + 1.9));
  }
  EXPECT_NEAR(kept, 2000, 130);  // three standard deviations of a binomial
  EXPECT_THROW(RadiometricCells(0.0), UsageError);
  EXPECT_THROW(RadiometricCells(1.0, 0), UsageError);
}

}  // namespace
}  // namespace pcl_als
