// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// Blocks measured by several systems.
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>

#include "simulated_observations.h"
#include "simulated_survey.h"

namespace pcl_als {
namespace {

StripSystems twoSystems() {
  StripSystems systems;
  systems.system = {0, 1};
  systems.count = 2;
  systems.own = {{P::boresight_roll, P::scan_angle_scale}, true};
  return systems;
}

/// The same unknowns in one dense normal matrix: eight parameters, then the shared errors.
struct Dense {
  Eigen::VectorXd solution;
  Eigen::MatrixXd covariance;

  Dense(const SharedErrors& errors, const std::vector<AreaObservations>& areas) {
    const int unknowns = 8 + errors.unknowns(), system = 8 + 6 * errors.systemBlock(1);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    normal.bottomRightCorner(errors.unknowns(), errors.unknowns()) = errors.priorInformation();
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    for (const AreaObservations& area : areas) {
      for (const PairObservation& o : area) {
        Eigen::VectorXd row = Eigen::VectorXd::Zero(unknowns);
        row.head<8>() = o.row().transpose();
        const auto place = [&](int strip, double time, const SystemRow& design, double sign) {
          const auto where = errors.placeOf(strip, time);
          Eigen::Matrix<double, 6, 1> effect;
          effect << o.normal, design.segment<3>(3).transpose();
          row.segment<6>(8 + 6 * where.knot) += sign * (1.0 - where.next) * effect;
          row.segment<6>(8 + 6 * where.next_knot) += sign * where.next * effect;
          if (errors.systems().of(strip) == 0) return;
          row.segment<8>(system) += sign * design.transpose();
          row.segment<3>(system + 8) += sign * o.normal;
        };
        place(o.a, o.time_a, o.row_a.cast<double>(), 1.0);
        place(o.b, o.time_b, o.row_b.cast<double>(), -1.0);
        normal += row * row.transpose() / o.variance;
        right += row * o.misclosure / o.variance;
      }
    }
    for (const P fixed : {P::lever_arm_z, P::range_bias})
      normal(indexOf(fixed), indexOf(fixed)) += 1e20;
    const Eigen::VectorXd scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    covariance = scale.asDiagonal() * scaled.inverse() * scale.asDiagonal();
    solution = covariance * right;
  }
};

TEST(Systems, EqualTheDenseSolution) {
  SharedErrorModel without = model();
  without.sources[0] = {1e-9, 0.5};  // no ranging error on slopes, which would be averaged
  const SharedErrors errors({{0.0, 25.0}, {100.0, 125.0}}, without, {}, twoSystems());
  auto areas = simulated(SystemVector::Zero(), 0.02, 5);
  SystemUnknowns truth = SystemUnknowns::Zero();
  truth[indexOf(P::boresight_roll)] = 3e-4;
  truth[indexOf(P::scan_angle_scale)] = -1e-4;
  truth.tail<3>() << 0.1, -0.2, 0.05;
  for (AreaObservations& area : areas) {
    for (PairObservation& o : area)
      o.misclosure += o.a == 1 ? o.effectAtPoint(truth) : -o.effectAtPatch(truth);
  }
  const Dense dense(errors, areas);
  const auto weights = unitWeights(areas);
  Adjustment adjustment(errors);
  adjustment.accumulate(areas, weights);
  const AdjustmentSolution solution = adjustment.solve(kSix, SystemVector::Zero());
  const auto system = adjustment.systemSolution(1, kSix, solution);
  const int at = 8 + 6 * errors.systemBlock(1);
  for (int i = 0; i < kSystemUnknownCount; ++i) {
    const double variance = dense.covariance(at + i, at + i);
    const double std = std::sqrt(variance);
    // 1e-5: rounding of two routes.
    EXPECT_NEAR(system.difference[i], dense.solution[at + i], 1e-5 * std) << i;
    EXPECT_GE(system.difference_std[i], std * (1.0 - 1e-5)) << i;
    EXPECT_LT(system.difference_std[i], std * 1.5) << i;  // the jackknife's
    EXPECT_LT(std::abs(system.difference[i] - truth[i]), 4.0 * std + 1e-9) << i;
    if (i >= 8) continue;
    const double own = variance + dense.covariance(i, i) + 2.0 * dense.covariance(at + i, i);
    EXPECT_GE(system.std[i], std::sqrt(own) * (1.0 - 1e-5)) << i;
  }
  EXPECT_LT(std::abs(system.difference[indexOf(P::boresight_pitch)]), 1e-6);  // shared
}

TEST(Systems, ChannelsOfAPassHaveItsTrajectoryErrors) {
  StripSystems systems;
  systems.pass = {0, 0, 2};
  const SharedErrors errors({{0.0, 25.0}, {1.0, 30.0}, {100.0, 125.0}}, model(), {}, systems);
  EXPECT_EQ(errors.placeOf(0, 10.0).knot, errors.placeOf(1, 10.0).knot);
  EXPECT_NE(errors.placeOf(0, 10.0).knot, errors.placeOf(2, 110.0).knot);
  const SharedErrors passes({{0.0, 30.0}, {100.0, 125.0}}, model());
  EXPECT_EQ(errors.knotCount(), passes.knotCount());
}

class TwoSessions : public ::testing::Test {
 protected:
  static const test::SimulatedSurvey& survey() {
    static const test::SimulatedSurvey made = [] {
      auto options = simulation::SimulationOptions::preset("small");
      options.noise = simulation::NoiseOptions::named("realistic");
      options.seed = 4;
      for (const char* strip : {"strip2", "strip4"}) {
        options.errors.add(std::string(strip) + ":boresight_roll=60");
        options.errors.add(std::string(strip) + ":range_bias=0.08");
      }
      return test::SimulatedSurvey(options);
    }();
    return made;
  }
  static CalibrationResult calibrated(const std::vector<StripGroup>& systems) {
    test::SimulatedSurvey::Request request;
    request.control = survey().control;
    request.rigorous = true;
    request.settings.systems = systems;
    return survey().calibrate(request).result;
  }
};

/// Additional biases of two of five strips: each parameter of both systems is within four standard
/// deviations (a chance of 1e-4), and the strips fit as those of a block with one system do.
TEST_F(TwoSessions, AreRecovered) {
  const CalibrationResult result = calibrated({{"morning", {"1", "3", "5"}}, {"noon", {"2", "4"}}});
  EXPECT_TRUE(result.verdict.usable()) << result.verdict.text();
  ASSERT_EQ(result.systems.size(), 2U);
  EXPECT_EQ(result.systems[1].group.strips, (std::vector<std::string>{"2", "4"}));
  SystemVector second = survey().bias;
  second[indexOf(P::boresight_roll)] += 60.0 * kRadiansPerArcsec;
  second[indexOf(P::range_bias)] += 0.08;
  for (const SystemParameterInfo& info : systemParameters()) {
    const auto i = static_cast<std::size_t>(indexOf(info.parameter));
    const ParameterEstimate &a = result.systems[0].parameters[i],
                            &b = result.systems[1].parameters[i];
    if (a.status != ParameterStatus::estimated) continue;
    EXPECT_NEAR(a.bias, survey().bias[indexOf(info.parameter)], 4.0 * a.std) << info.name;
    EXPECT_NEAR(b.bias, second[indexOf(info.parameter)], 4.0 * b.std) << info.name;
  }
  const ParameterEstimate& roll = result.systems[1].parameters[indexOf(P::boresight_roll)];
  EXPECT_LT(roll.std, 10.0 * kRadiansPerArcsec);
  EXPECT_LT(result.misfit.rms_after, 0.04);
}

TEST_F(TwoSessions, LeaveAMisfitWithOneSystem) {
  const CalibrationResult result = calibrated({});
  EXPECT_TRUE(result.systems.empty());
  EXPECT_GT(result.misfit.rms_after, 0.05);
}

TEST_F(TwoSessions, RefuseGroupsThatDoNotExist) {
  EXPECT_THROW(calibrated({{"a", {"1"}}, {"b", {"9"}}}), UsageError);
  EXPECT_THROW(calibrated({{"a", {"1", "2"}}, {"b", {"2"}}}), UsageError);
  EXPECT_THROW(calibrated({{"a", {"1"}}, {"a", {"2"}}}), UsageError);
  EXPECT_THROW(calibrated({{"a", {}}}), UsageError);
}

}  // namespace
}  // namespace pcl_als
