// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "adjustment.h"
#include "area_normal.h"
#include "simulated_observations.h"
#include "strip_covariance.h"

namespace pcl_als {
namespace {

constexpr int kSize = SharedErrors::kPerKnot;
const std::vector<TimeSpan> kFlown{{0.0, 40.0}, {100.0, 140.0}};
/// Nothing is observed from 9 to 30 s and at the ends of the strips.
const std::vector<std::vector<TimeSpan>> kObserved{{{4.0, 9.0}, {30.0, 36.0}}, {{110.0, 132.0}}};

SharedErrorModel errorModel() {
  SharedErrorModel errors = model(20.0);
  errors.knot_spacing = 2.0;
  return errors;
}

/// Pairs of the two strips within the observed times, with rows of the sizes that real ones have.
std::vector<AreaObservations> observations() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  std::vector<AreaObservations> areas = simulated(SystemVector::Zero(), 0.02, 3);
  for (AreaObservations& area : areas) {
    for (PairObservation& o : area) {
      const double first =
          uniform(random) < 0.5 ? 4.0 + 5.0 * uniform(random) : 30.0 + 6.0 * uniform(random);
      const double second = 110.0 + 22.0 * uniform(random);
      o.time_a = o.a == 0 ? first : second;
      o.time_b = o.a == 0 ? second : first;
    }
  }
  return areas;
}

/// Covariance of the parameters kSix and all unknowns of \a errors, from the whole normal matrix.
Eigen::MatrixXd denseCovariance(const SharedErrors& errors,
                                const std::vector<AreaObservations>& areas,
                                const SystemVector& prior) {
  const auto parameters = static_cast<Eigen::Index>(kSix.size());
  Eigen::MatrixXd normal =
      Eigen::MatrixXd::Zero(parameters + errors.unknowns(), parameters + errors.unknowns());
  normal.bottomRightCorner(errors.unknowns(), errors.unknowns()) = errors.priorInformation();
  for (Eigen::Index i = 0; i < parameters; ++i) {
    const double std = prior[indexOf(kSix[static_cast<std::size_t>(i)])];
    normal(i, i) = 1.0 / (std * std);
  }
  for (const AreaObservations& area : areas) {
    for (const PairObservation& o : area) {
      const TouchedRow touched(o, errors);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(normal.rows());
      for (Eigen::Index i = 0; i < parameters; ++i)
        row[i] = touched.row[indexOf(kSix[static_cast<std::size_t>(i)])];
      for (int slot = 0; slot < TouchedRow::kSlots; ++slot) {
        if (touched.knots[static_cast<std::size_t>(slot)] < 0) continue;
        row.segment<kSize>(parameters + kSize * touched.knots[static_cast<std::size_t>(slot)]) +=
            touched.row.segment<kSize>(TouchedRow::slot(slot)).transpose();
      }
      normal += row * row.transpose() / o.variance;
    }
  }
  // Unknowns have units and sizes of their own.
  const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd inverse = (scale.asDiagonal() * normal * scale.asDiagonal()).inverse();
  return scale.asDiagonal() * inverse * scale.asDiagonal();
}

struct Solved {
  SharedErrors errors{kFlown, errorModel(), kObserved};
  Adjustment adjustment{errors, 1};
  AdjustmentSolution solution;
  SystemVector prior;
  std::vector<AreaObservations> areas = observations();

  Solved() {
    prior << 1.0, 1.0, 1.0, 0.01, 0.01, 0.01, 1.0, 0.01;
    adjustment.accumulate(areas, unitWeights(areas));
    solution = adjustment.solveNearZero(kSix, prior);
  }
};

// The strip has no knots where nothing was observed: its covariance there must be that of a model
// with knots everywhere.
TEST(StripCovariance, EqualsTheInverseOfAllUnknowns) {
  const Solved solved;
  const auto covariance = solved.adjustment.stripCovariance(solved.solution);
  const SharedErrors all(kFlown, errorModel());
  ASSERT_GT(all.knotCount(), solved.errors.knotCount());
  const Eigen::MatrixXd dense = denseCovariance(all, solved.areas, solved.prior);
  const auto parameters = static_cast<Eigen::Index>(kSix.size());
  int knot = 0;
  for (int strip = 0; strip < 2; ++strip) {
    for (const SharedErrors::Expectation& at : solved.errors.expectationsOf(strip)) {
      const StripCovariance::At found = covariance->at(strip, at);
      const Eigen::Index first = parameters + kSize * knot++;
      for (int i = 0; i < kSize; ++i) {
        const double std = std::sqrt(dense(first + i, first + i));
        // 1e-5: the shifts of areas (0.1 micrometre) and rounding; a priori and a posteriori
        // standard deviations differ by tens of percent.
        EXPECT_NEAR(std::sqrt(found.errors(i, i)), std, 1e-5 * std) << strip << ' ' << at.time;
        for (int j = 0; j < i; ++j) {
          const double other = std::sqrt(dense(first + j, first + j));
          EXPECT_NEAR(found.errors(i, j), dense(first + i, first + j), 1e-5 * std * other);
        }
        for (Eigen::Index p = 0; p < parameters; ++p) {
          EXPECT_NEAR(found.parameters(i, indexOf(kSix[static_cast<std::size_t>(p)])),
                      dense(first + i, p), 1e-5 * std * std::sqrt(dense(p, p)));
        }
      }
    }
  }
}

TEST(StripCovariance, ObservationsMakeDeviationsSmaller) {
  const Solved solved;
  StripErrors strip{"1", solved.errors.errorsOf(0, solved.solution.shared), {}};
  solved.adjustment.stripCovariance(solved.solution)->add(0, kSix, strip);
  const double prior = std::sqrt(solved.errors.variances(VarianceFactors())[2]);
  ASSERT_EQ(strip.knots.size(), 21U);
  EXPECT_LT(strip.knots[3].position_std.z(), 0.8 * prior);  // 6 s: observed
  EXPECT_GT(strip.knots[10].position_std.z(), 1.05 * strip.knots[3].position_std.z());  // 20 s
  EXPECT_LT(strip.knots[10].position_std.z(), prior);
  // Correlations a quarter of the correlation time apart at least, and at the ends.
  ASSERT_EQ(strip.correlations.size(), 8U);  // 0, 6, 12 … 36, 40 s
  EXPECT_DOUBLE_EQ(strip.correlations.front().time, 0.0);
  EXPECT_DOUBLE_EQ(strip.correlations.back().time, 40.0);
  EXPECT_EQ(strip.correlations[1].parameters.cols(), 6);
  EXPECT_NEAR(strip.correlations[1].errors(3, 3), 1.0, 1e-9);
  EXPECT_LE(strip.correlations[1].parameters.cwiseAbs().maxCoeff(), 1.0);
}

}  // namespace
}  // namespace pcl_als
