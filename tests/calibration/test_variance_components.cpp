// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The variance components of the shared errors: standard deviations that they give where trajectory
// errors are no Gauss-Markov process.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/calibration/adjustment.h>

#include "simulated_observations.h"

namespace pcl_als {
namespace {

/// Four strips of 10 s over control with smooth errors of their height: eight waves of periods from
/// 12 to 100 s. A range bias raises all points; a scale has an effect quadratic in time.
std::vector<AreaObservations> smoothlyWrong(double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<AreaObservations> areas(4);
  for (int strip = 0; strip < 4; ++strip) {
    double rate[8], cosine[8], sine[8];
    for (int wave = 0; wave < 8; ++wave) {
      rate[wave] = 2.0 * kPi / (12.0 * std::pow(100.0 / 12.0, uniform(random)));
      cosine[wave] = sigma * std::sqrt(0.125) * normal(random);
      sine[wave] = sigma * std::sqrt(0.125) * normal(random);
    }
    for (double time = 0.05; time < 10.0; time += 0.1) {
      PairObservation o;
      o.b = strip, o.time_b = time;
      o.normal = Eigen::Vector3d::UnitZ();
      o.row_b[indexOf(P::range_bias)] = 1.0;
      o.row_b[indexOf(P::scan_angle_scale)] = 300.0 * (std::pow(0.2 * time - 1.0, 2) - 1.0 / 3.0);
      o.variance = 1e-6;
      o.misclosure = 1e-3 * normal(random);
      for (int wave = 0; wave < 8; ++wave)
        o.misclosure -=
            cosine[wave] * std::cos(rate[wave] * time) + sine[wave] * std::sin(rate[wave] * time);
      areas[static_cast<std::size_t>(strip)].push_back(o);
    }
  }
  return areas;
}

TEST(VarianceComponents, CoverSmoothErrors) {
  // The variance of what resembles the scale is known from four strips: Student's t of four degrees
  // of freedom has a standard deviation of 1.41, known to 16 % from 20 values. A Gauss-Markov
  // process alone, its variance determined by changes within a second, gave 2.56.
  SharedErrorModel errors_model = model(20.0);
  errors_model.knot_spacing = 1.0;
  const std::vector<TimeSpan> spans(4, {0.0, 10.0});
  const SharedErrors errors(spans, errors_model);
  const std::vector<P> estimate{P::range_bias, P::scan_angle_scale};
  constexpr int kBlocks = 20;
  double squares = 0.0;
  for (unsigned seed = 1; seed <= kBlocks; ++seed) {
    const auto areas = smoothlyWrong(0.015, seed);
    const auto weights = unitWeights(areas);
    Adjustment adjustment(errors, 1);
    adjustment.accumulate(areas, weights);
    mostLikelyLevels(adjustment, estimate);
    const AdjustmentSolution solution = adjustment.solve(estimate, SystemVector::Zero());
    const int i = indexOf(P::scan_angle_scale);
    squares += std::pow(solution.biases[i], 2) / solution.covariance(i, i);
  }
  const double rms = std::sqrt(squares / kBlocks);
  EXPECT_GT(rms, 0.7);
  EXPECT_LT(rms, 1.8);
}

}  // namespace
}  // namespace pcl_als
