// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// One strip id on several days: work and memory follow the times at which something was observed.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "simulated_observations.h"
#include "simulated_survey.h"

namespace pcl_als {
namespace {

constexpr double kDay = 86400.0;

TEST(TimeGaps, DivideSpans) {
  using Spans = std::vector<TimeSpan>;
  EXPECT_EQ(continuousSpans({}), Spans());
  EXPECT_EQ(continuousSpans({5.0}), (Spans{{5.0, 5.0}}));
  // 9.9 s, of two intervals, are no gap; 10.1 s are one. Times need not be in order.
  EXPECT_EQ(continuousSpans({9.0, 1.0, 18.9, 29.0, kDay}),
            (Spans{{1.0, 18.9}, {29.0, 29.0}, {kDay, kDay}}));
}

/// The mean time of a patch of two days is that of neither.
TEST(TimeGaps, LieBetweenTheVerticesOfPatches) {
  PairObservation o;
  o.time_b = 0.4 * kDay;
  PairObservation::Special special;
  special.mixed_times = true;
  special.vertices[0].time = 1.0;
  special.vertices[1].time = kDay + 3.0;
  special.vertices[2].time = kDay + 2.0;
  o.special = std::make_shared<const PairObservation::Special>(special);
  using Spans = std::vector<TimeSpan>;
  EXPECT_EQ(observedTimes({{o}}, 1), (std::vector<Spans>{{{1.0, 1.0}, {kDay + 2.0, kDay + 3.0}}}));
}

TEST(TimeGaps, HaveNoKnots) {
  constexpr double kLater = 44.0 * kDay;
  const SharedErrors errors({{0.0, kLater + 30.0}}, model(),
                            {{{0.0, 30.0}, {kLater, kLater + 30.0}}});
  EXPECT_LT(errors.knotCount(), 12);
  const std::vector<SharedErrors::Expectation> all = errors.expectationsOf(0);
  EXPECT_LT(all.size(), 300U);
  EXPECT_EQ(all.front().time, 0.0);
  EXPECT_NEAR(all.back().time, kLater + 30.0, 1e-6);
  // Either end of the gap has nearly the expectation of the constant component alone: what is
  // interpolated between them is that of every time in it.
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (all[i].time - all[i - 1].time < kDay) continue;
    for (const SharedErrors::Expectation& end : {all[i - 1], all[i]}) {
      EXPECT_NEAR(end.gauss_markov_left, 1.0, 1e-6);  // exp(-16)
      for (const auto& [block, weight] : end.blocks) {
        if (block < errors.knotCount()) {
          EXPECT_LT(std::abs(weight), 4e-4);  // exp(-8)
        }
      }
    }
    return;
  }
  FAIL() << "no gap";
}

/// The last line of a block under the id of the first one, a day later.
TEST(TimeGaps, OfADayChangeNothingInACalibration) {
  auto options = simulation::SimulationOptions::preset("small", 1.0, 0.4);
  options.noise = simulation::NoiseOptions::named("realistic");
  options.seed = 3;
  test::SimulatedSurvey survey(options);
  CalibrationSettings settings;
  settings.candidates = 20'000;
  settings.estimate = {P::boresight_roll, P::boresight_pitch};
  const CalibrationResult apart = survey.calibrate(settings, true, true);
  std::vector<LidarReturn> last = survey.strips.back();
  survey.strips.pop_back();
  const double from = last.front().time - 30.0;
  for (TrajectorySample& sample : survey.trajectory)
    if (sample.time > from) sample.time += kDay;
  for (LidarReturn& point : last) point.time += kDay;
  survey.strips.front().insert(survey.strips.front().end(), last.begin(), last.end());
  const CalibrationResult joined = survey.calibrate(settings, true, true);
  for (const P parameter : settings.estimate)
    EXPECT_NEAR(joined[parameter].bias, apart[parameter].bias, 3.0 * apart[parameter].std);
  for (const StripErrors& strip : joined.strip_errors) EXPECT_LT(strip.knots.size(), 3000U);
}

}  // namespace
}  // namespace pcl_als
