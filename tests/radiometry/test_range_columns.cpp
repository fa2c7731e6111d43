// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {
namespace {

const Eigen::Vector3d kOrigin(700000.0, 5660000.0, 0.0);  // UTM: floats would not do

/// A climbing curve of 20 s, 20 samples a second, with a gap of 5 s.
std::shared_ptr<const Trajectory> climbingFlight() {
  std::vector<TrajectorySample> samples;
  for (int i = 0; i <= 400; ++i) {
    const double t = 0.05 * i;
    if (t > 5.0 && t < 10.0) continue;
    TrajectorySample sample;
    sample.time = t;
    sample.position = kOrigin + Eigen::Vector3d(50.0 * t, t * t, 20000.0 + 2.0 * t);
    samples.push_back(sample);
  }
  return std::make_shared<const Trajectory>(samples);
}

struct RangedPoints {
  std::vector<double> time, x, y, z;
  PointColumns columns(std::size_t from = 0) const {
    return {&time[from], &x[from], &y[from], &z[from]};
  }
};

/// Ranges of 1 m to 20 km, some above the sensor; times in order, but for a tenth; some have none.
RangedPoints randomPoints(std::size_t count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  RangedPoints points;
  for (std::size_t i = 0; i < count; ++i) {
    double time = 20.0 * static_cast<double>(i) / static_cast<double>(count);
    if (unit(random) < 0.1) time = 24.0 * unit(random) - 2.0;
    if (unit(random) < 0.01) time = NAN;
    const double t = std::isnan(time) ? 0.0 : time;
    const double down = unit(random) < 0.05 ? -10.0 : std::pow(20000.0, unit(random));
    points.time.push_back(time);
    points.x.push_back(kOrigin.x() + 50.0 * t + down * (unit(random) - 0.5));
    points.y.push_back(kOrigin.y() + t * t + down * (unit(random) - 0.5));
    points.z.push_back(20000.0 + 2.0 * t - down);
  }
  return points;
}

/// Columns against evaluate(), point by point; the tolerance is that of the exponential and the
/// rounding of its argument.
void expectSame(const RadiometricModel& model) {
  constexpr std::size_t kCount = 20011;  // no multiple of any number of lanes
  const RangedPoints points = randomPoints(kCount);
  const RadiometricEvaluator evaluator(climbingFlight(), model);
  std::vector<double> range(kCount), factor(kCount);
  RadiometryCursor cursor, other;
  const RangeCounts counts =
      evaluator.evaluateRanges(points.columns(), kCount, {range.data(), factor.data()}, cursor);
  RangeCounts wanted;
  for (std::size_t i = 0; i < kCount; ++i) {
    LidarReturn point;
    point.time = points.time[i];
    point.position = {points.x[i], points.y[i], points.z[i]};
    const PointRadiometry found = evaluator.evaluate(point, LocalSurface(), other);
    wanted.uncovered += found.status == RadiometryStatus::uncovered ? 1 : 0;
    wanted.above_sensor += found.status == RadiometryStatus::above_sensor ? 1 : 0;
    ASSERT_EQ(std::isnan(range[i]), !found.corrected()) << i;
    ASSERT_NEAR(factor[i], found.factor, 2e-11 * found.factor) << i;
    if (found.corrected()) {
      ASSERT_EQ(static_cast<float>(range[i]), found.range) << i;
    }
  }
  EXPECT_EQ(counts.uncovered, wanted.uncovered);
  EXPECT_EQ(counts.above_sensor, wanted.above_sensor);
  EXPECT_GT(counts.uncovered, kCount / 100);
  EXPECT_GT(counts.above_sensor, kCount / 100);
}

TEST(RangeColumns, AgreeWithSinglePoints) {
  for (const double exponent : {2.0, 0.0, 3.8}) {
    for (const double extinction : {0.0, 0.035, 10.0}) {  // exponents of -20 to 470
      RadiometricModel model;
      model.range_exponent = exponent;
      model.extinction_per_km = extinction;
      expectSame(model);
    }
  }
}

TEST(RangeColumns, DoNotDependOnHowPointsAreDivided) {
  constexpr std::size_t kCount = 1000;
  const RangedPoints points = randomPoints(kCount);
  RadiometricModel model;
  model.extinction_per_km = 0.1;
  const RadiometricEvaluator evaluator(climbingFlight(), model);
  std::vector<double> range(kCount), factor(kCount);
  RadiometryCursor cursor;
  evaluator.evaluateRanges(points.columns(), kCount, {range.data(), factor.data()}, cursor);
  for (std::size_t i = 0; i < kCount; ++i) {
    double single_range = 0.0, single_factor = 0.0;
    RadiometryCursor fresh;
    evaluator.evaluateRanges(points.columns(i), 1, {&single_range, &single_factor}, fresh);
    EXPECT_EQ(single_factor, factor[i]);
    EXPECT_TRUE(single_range == range[i] || (std::isnan(single_range) && std::isnan(range[i])));
  }
}

TEST(RangeColumns, AnAirThatLetsNothingThroughStaysANumber) {
  RadiometricModel model;
  model.extinction_per_km = 50.0;  // exp(1900) has no double
  const RadiometricEvaluator evaluator(climbingFlight(), model);
  const double time = 1.0, x = kOrigin.x() + 50.0, y = kOrigin.y() + 1.0, z = 1.0;
  double range = 0.0, factor = 0.0;
  RadiometryCursor cursor;
  evaluator.evaluateRanges({&time, &x, &y, &z}, 1, {&range, &factor}, cursor);
  EXPECT_NEAR(range, 20001.0, 0.01);
  EXPECT_TRUE(std::isfinite(factor));
  EXPECT_GT(factor, 1e200);
}

}  // namespace
}  // namespace pcl_als
