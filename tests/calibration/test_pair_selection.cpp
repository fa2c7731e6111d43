// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <map>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <pcl_als/calibration/pair_selection.h>
#include <pcl_als/calibration/pair_weights.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {
namespace {

using Weights = std::vector<std::vector<double>>;

/// A pair of two opposite lines at 1000 m over a surface with this normal, x metres to the right of
/// the first.
PairObservation pairAt(double x, const Eigen::Vector3d& normal, int a = 0, int b = 1) {
  PairObservation o;
  o.a = a;
  o.b = b;
  o.normal = normal;
  o.variance = 4e-4;
  for (const bool second : {false, true}) {
    ScanGeometry g;
    g.x = second ? -x : x;
    g.z = -1000.0;
    g.beta = -std::atan2(g.x, -g.z);
    if (second) g.rotation = Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
    (second ? o.row_b : o.row_a) = normal.transpose() * designBlock(g);
  }
  return o;
}

Weights unitWeights(const std::vector<AreaObservations>& areas) {
  Weights weights;
  for (const AreaObservations& area : areas) weights.emplace_back(area.size(), 1.0);
  return weights;
}

/// Ten areas: much flat ground, few slopes.
std::vector<AreaObservations> mostlyFlat() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<AreaObservations> areas(10);
  for (AreaObservations& area : areas) {
    const double x = 300.0 * uniform(random);
    for (int i = 0; i < 1000; ++i) area.push_back(pairAt(x, Eigen::Vector3d::UnitZ()));
    for (int i = 0; i < 60; ++i) {
      const double aspect = 3.14 * uniform(random);
      area.push_back(pairAt(
          x, Eigen::Vector3d(0.4 * std::cos(aspect), 0.4 * std::sin(aspect), 1.0).normalized()));
    }
  }
  return areas;
}

/// ln of the determinant of N for what such a block shows at its one height: lever_arm_x, pitch and
/// roll.
double information(const std::vector<AreaObservations>& areas,
                   const std::vector<std::vector<std::size_t>>& chosen, double shared) {
  SystemMatrix normal = SystemMatrix::Zero();
  for (std::size_t area = 0; area < areas.size(); ++area) {
    // Pairs of an area share an error: all of its flat ones are one observation, and so on by
    // orientation; eight aspects here.
    std::map<int, std::pair<SystemRow, int>> groups;
    for (const std::size_t i : chosen[area]) {
      const Eigen::Vector3d& n = areas[area][i].normal;
      const int key =
          n.z() > 0.999 ? -1 : static_cast<int>(8.0 * (std::atan2(n.y(), n.x()) + 3.1416) / 6.2832);
      auto& group = groups.try_emplace(key, SystemRow::Zero(), 0).first->second;
      group.first += areas[area][i].row();
      ++group.second;
    }
    for (const auto& [key, group] : groups) {
      const SystemRow row = group.first / group.second;
      normal += row.transpose() * row / (shared + 4e-4 / group.second);
    }
  }
  const int which[] = {0, 3, 4};
  Eigen::Matrix3d part;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) part(r, c) = normal(which[r], which[c]);
  }
  return std::log(part.determinant());
}

TEST(PairSelection, KeepsEverythingWithinTheBudget) {
  const auto areas = mostlyFlat();
  const PairSelection selection(areas, unitWeights(areas),
                                PairSelectionSettings{20000, 0.25, 2e-4});
  EXPECT_EQ(selection.chosenCount(), 10600U);
}

TEST(PairSelection, SpendsTheBudgetOnWhatDetermines) {
  const auto areas = mostlyFlat();
  PairSelectionSettings settings{800, 0.25, 2e-4};
  const PairSelection selection(areas, unitWeights(areas), settings);
  EXPECT_NEAR(static_cast<double>(selection.chosenCount()), 800.0, 5.0);
  std::size_t slopes = 0;
  for (std::size_t area = 0; area < areas.size(); ++area) {
    for (const std::size_t i : selection.chosen()[area]) {
      if (areas[area][i].normal.z() < 0.999) ++slopes;
    }
  }
  EXPECT_GT(slopes, 400U);  // 6 % of what there is
  // Evenly thinned, the same number is worth far less; all 10,600 pairs hardly more.
  std::vector<std::vector<std::size_t>> even(areas.size()), all(areas.size());
  for (std::size_t area = 0; area < areas.size(); ++area) {
    for (std::size_t i = 0; i < 80; ++i) even[area].push_back(i * areas[area].size() / 80);
    all[area].resize(areas[area].size());
    std::iota(all[area].begin(), all[area].end(), std::size_t{0});
  }
  const double chosen = information(areas, selection.chosen(), settings.shared_variance);
  EXPECT_GT(chosen, information(areas, even, settings.shared_variance) + 0.5);
  EXPECT_GT(chosen, information(areas, all, settings.shared_variance) - 1.0);
}

TEST(PairSelection, LeavesNoMeetingOfStripsUnseen) {
  auto areas = mostlyFlat();
  areas.emplace_back();  // an area that tells nothing new
  for (int i = 0; i < 500; ++i) areas.back().push_back(pairAt(0.0, Eigen::Vector3d::UnitZ(), 2, 3));
  const PairSelection selection(areas, unitWeights(areas), PairSelectionSettings{800, 0.25, 2e-4});
  EXPECT_GE(selection.chosen().back().size(), 15U);  // 200 pairs over 11 meetings
}

TEST(PairSelection, NeverTakesOutliersAndAlwaysControl) {
  auto areas = mostlyFlat();
  areas.emplace_back();
  PairObservation control = pairAt(0.0, Eigen::Vector3d::UnitZ());
  control.a = PairObservation::kControl;
  control.row_a.setZero();
  areas.back().push_back(control);
  Weights weights = unitWeights(areas);
  for (std::size_t i = 0; i < weights[3].size(); i += 2) weights[3][i] = 0.0;
  const PairSelection selection(areas, weights, PairSelectionSettings{800, 0.25, 2e-4});
  for (const std::size_t i : selection.chosen()[3]) EXPECT_EQ(i % 2, 1U);
  EXPECT_EQ(selection.chosen().back().size(), 1U);
}

TEST(PairWeights, FindsHowWellASystemPoints) {
  // Half of the variance of slopes is said to come from pointing, and none does: residuals of
  // slopes are half as large (in variance) as said, those of flat ground are as said.
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  std::vector<AreaObservations> areas(1);
  std::vector<std::vector<double>> residuals(1);
  for (int i = 0; i < 4000; ++i) {
    PairObservation o = pairAt(100.0, Eigen::Vector3d::UnitZ());
    const bool slope = i % 2 == 0;
    o.pointing = slope ? 4e-4 : 0.0;
    o.variance = 4e-4 + o.pointing;
    areas[0].push_back(o);
    residuals[0].push_back(0.02 * normal(random));
  }
  PairWeights weights;
  weights.update(areas, residuals, true);
  EXPECT_LE(weights.pointingFactor(), 0.1);
  // Weight over the model's variance: slopes count as much as flat ground.
  EXPECT_NEAR(weights.weights()[0][0] / areas[0][0].variance,
              weights.weights()[0][1] / areas[0][1].variance, 0.1 / 4e-4);
  EXPECT_NEAR(weights.sigma0(), std::sqrt(0.75), 0.03);  // against the noise as given
}

TEST(PairWeights, RejectsOutliersOnlyWhenAsked) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<AreaObservations> areas(1);
  std::vector<std::vector<double>> residuals(1);
  for (int i = 0; i < 1000; ++i) {
    areas[0].push_back(pairAt(100.0, Eigen::Vector3d::UnitZ()));
    residuals[0].push_back(i % 10 == 0 ? 0.5 : 0.02 * normal(random));
  }
  PairWeights weights;
  weights.update(areas, residuals, true);
  EXPECT_EQ(weights.weights()[0][0], 0.0);
  EXPECT_NEAR(static_cast<double>(weights.kept()), 900.0, 1.0);
  weights.update(areas, residuals, false);
  EXPECT_EQ(weights.kept(), 1000U);
  EXPECT_LT(weights.weights()[0][0], 0.1);  // Huber: 1.5 of some 25 standard deviations
}

}  // namespace
}  // namespace pcl_als
