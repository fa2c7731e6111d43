// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/survey/survey_map.h>

#include "area_matcher.h"

namespace pcl_als {
namespace {

/// Gently rolling ground with a gable of 30 degrees on it.
double height(double x, double y) {
  const double ground = 100.0 + 0.05 * x + std::sin(y / 40.0);
  const double roof = 6.0 - 0.577 * std::abs(x - 25.0);
  return std::abs(x - 25.0) < 8.0 && std::abs(y - 25.0) < 12.0 ? ground + roof : ground;
}

std::vector<LidarReturn> sampled(unsigned seed, double from, double to,
                                 const Eigen::Vector3d& shift) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> plan(from, to);
  std::vector<LidarReturn> points;
  for (int i = 0; i < static_cast<int>((to - from) * (to - from) * 4.0); ++i) {
    LidarReturn p;
    const double x = plan(random), y = plan(random);
    p.position = Eigen::Vector3d(x, y, height(x, y)) + shift;
    p.time = 10.0;
    points.push_back(p);
  }
  return points;
}

Trajectory flightNorth() {
  std::vector<TrajectorySample> samples;
  for (int i = 0; i <= 200; ++i) {
    TrajectorySample sample;
    sample.time = 0.1 * i;
    sample.position = Eigen::Vector3d(25.0, 60.0 * (sample.time - 10.0) + 25.0, 1100.0);
    samples.push_back(sample);
  }
  return Trajectory(samples);
}

const SurveyArea kMatchedArea{{0.0, 0.0}, 50.0, 8.0};

AreaMatcher matcherOf(const std::vector<LidarReturn>& a, const std::vector<LidarReturn>& b,
                      std::size_t candidates = 500) {
  AreaMatcher matcher(kMatchedArea, 2);
  for (const LidarReturn& p : a) matcher.add(0, p);
  for (const LidarReturn& p : b) matcher.add(1, p);
  matcher.prepare(SurfaceCriterion(), candidates, 0.001, flightNorth());
  return matcher;
}

TEST(SurfacePoint, LeavesOutWhatIsNoSurface) {
  LidarReturn p;
  EXPECT_TRUE(isSurfacePoint(p));
  p.number_of_returns = 2;
  EXPECT_FALSE(isSurfacePoint(p));  // first of two
  p.return_number = 2;
  EXPECT_TRUE(isSurfacePoint(p));
  p.classification = 5;
  EXPECT_FALSE(isSurfacePoint(p));
  p.classification = 2;
  p.flags = kWithheld;
  EXPECT_FALSE(isSurfacePoint(p));
}

TEST(AreaMatcher, MeasuresAVerticalShiftInBothDirections) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(1, -8.0, 58.0, {0, 0, 0}), b = sampled(2, -8.0, 58.0, {0, 0, -0.05});
  const AreaMatcher matcher = matcherOf(a, b);
  const AreaObservations found = matcher.match({{0, 1}}, 0.5, trajectory, NoiseModel());
  ASSERT_GT(found.size(), 500U);
  int forward = 0;
  for (const PairObservation& o : found) {
    // A above B by 5 cm: n_z 0.05 for points of A, the negative for points of B; chords of rolling
    // ground within 1 cm.
    const double expected = (o.a == 0 ? 0.05 : -0.05) * o.normal.z();
    EXPECT_NEAR(o.distance(SystemVector::Zero()), expected, 0.01);
    forward += o.a == 0 ? 1 : 0;
  }
  EXPECT_GT(forward, 200);
  EXPECT_LT(forward, static_cast<int>(found.size()) - 200);
}

// Noise of 2 cm of points 0.5 m apart tilts the vertices around a triangle by 0.01: of a slope of
// 0.04, a part of them is significant at five standard deviations.
TEST(AreaMatcher, PairsOfOneSlopeHaveOneDirection) {
  std::mt19937_64 random(4);
  std::normal_distribution<double> noise(0.0, 0.02);
  auto a = sampled(1, -8.0, 58.0, {0, 0, 0}), b = sampled(2, -8.0, 58.0, {0, 0, 0});
  for (auto* strip : {&a, &b})
    for (LidarReturn& p : *strip) p.position.z() = 100.0 + 0.04 * p.position.x() + noise(random);
  const AreaObservations found = matcherOf(a, b).match({{0, 1}}, 0.5, flightNorth(), NoiseModel());
  ASSERT_GT(found.size(), 500U);
  for (const PairObservation& o : found) EXPECT_NEAR(o.normal.x(), -0.04, 0.01);
}

// Echoes of strip A with 3 cm and of strip B with 1 cm: level distances of A's points contain 9
// cm^2 and the square sum of three weights (1/3 to 1) of 1 cm^2, along beams within 3 degrees of
// the vertical.
TEST(AreaMatcher, AddsTheNoiseOfEchoes) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(1, -8.0, 58.0, {0, 0, 0}), b = sampled(2, -8.0, 58.0, {0, 0, -0.05});
  AreaMatcher matcher(kMatchedArea, 2);
  for (const LidarReturn& p : a) matcher.add(0, p, 0.03F);
  for (const LidarReturn& p : b) matcher.add(1, p, 0.01F);
  matcher.prepare(SurfaceCriterion(), 500, 0.001, trajectory);
  const AreaObservations with = matcher.match({{0, 1}}, 0.5, trajectory, NoiseModel());
  const AreaObservations without = matcherOf(a, b).match({{0, 1}}, 0.5, trajectory, NoiseModel());
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(without[i].echo, 0.0F);
    EXPECT_NEAR(with[i].variance - without[i].variance, with[i].echo, 1e-8);
    if (with[i].normal.z() < 1.0) continue;
    const double point = with[i].a == 0 ? 9e-4 : 1e-4, vertex = with[i].a == 0 ? 1e-4 : 9e-4;
    EXPECT_GE(with[i].echo, 0.99 * (point + vertex / 3.0));
    EXPECT_LE(with[i].echo, point + vertex);
  }
}

TEST(AreaMatcher, DividesPairsByDistance) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(1, -8.0, 58.0, {0, 0, 0});
  auto b = sampled(2, -8.0, 58.0, {0, 0, -0.05});
  for (LidarReturn& p : b)
    if (p.position.x() > 25.0) p.position.z() -= 0.1;
  const AreaMatcher matcher = matcherOf(a, b);
  const auto found = matcher.matchByDistance({{0, 1}}, {0.1, 0.5}, trajectory, NoiseModel());
  const AreaObservations near = matcher.match({{0, 1}}, 0.1, trajectory, NoiseModel());
  const AreaObservations all = matcher.match({{0, 1}}, 0.5, trajectory, NoiseModel());
  ASSERT_EQ(found.near.size(), near.size());
  EXPECT_EQ(found.near.size() + found.far.size(), all.size());
  EXPECT_GT(found.near.size(), 100U);
  EXPECT_GT(found.far.size(), 100U);
  for (std::size_t i = 0; i < near.size(); ++i) {
    EXPECT_EQ(found.near[i].point, near[i].point);
    EXPECT_EQ(found.near[i].variance_inflation, near[i].variance_inflation);
  }
  // Chords: distances along the normal of the neighbourhood differ from those of the triangle.
  for (const PairObservation& o : found.far)
    EXPECT_GT(std::abs(o.distance(SystemVector::Zero())), 0.09);
}

/// One point in four has three others within centimetres, as along the lines of a rosette.
TEST(AreaMatcher, EvensOutDensePoints) {
  AreaMatcher matcher(kMatchedArea, 1);
  const std::vector<LidarReturn> single = sampled(8, -8.0, 58.0, {0, 0, 0});
  for (std::size_t i = 0; i < single.size(); ++i) {
    for (int k = 0; k < (i % 4 == 0 ? 4 : 1); ++k) {
      LidarReturn p = single[i];
      p.position.x() += 0.02 * k;
      matcher.add(0, p);
    }
  }
  const std::size_t before = matcher.pointCount();
  matcher.evenOut();
  // A cell of the mean spacing holds a point with a probability of 1 - 1/e at an even density.
  const double kept = static_cast<double>(matcher.pointCount()) / static_cast<double>(before);
  EXPECT_GT(kept, 0.40);
  EXPECT_LT(kept, 0.60);
  matcher.prepare(SurfaceCriterion(), 500, 0.001, flightNorth());
  EXPECT_GT(matcher.surfaceOf(0).tin().triangles().size(), matcher.pointCount());
}

TEST(AreaMatcher, KeepsAwayFromEavesAndRidges) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(3, -8.0, 58.0, {0, 0, 0}), b = sampled(4, -8.0, 58.0, {0.3, 0, 0});
  const AreaMatcher matcher = matcherOf(a, b);
  std::size_t roof = 0;
  for (const PairObservation& o : matcher.match({{0, 1}}, 0.5, trajectory, NoiseModel())) {
    if (std::hypot(o.normal.x(), o.normal.y()) < 0.3) continue;
    ++roof;  // a roof side moved 30 cm across the ridge: 15 cm along its normal
    EXPECT_NEAR(std::abs(o.distance(SystemVector::Zero())), 0.15, 0.02);
  }
  EXPECT_GT(roof, 100U);
}

TEST(AreaMatcher, TakesNothingFromTrees) {
  const Trajectory trajectory = flightNorth();
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> crown(0.0, 8.0);
  auto a = sampled(6, -8.0, 58.0, {0, 0, 0}), b = sampled(7, -8.0, 58.0, {0, 0, 0});
  for (auto* strip : {&a, &b}) {
    for (LidarReturn& p : *strip) {
      if (p.position.y() > 40.0) p.position.z() += crown(random);
    }
  }
  for (const PairObservation& o : matcherOf(a, b).match({{0, 1}}, 2.0, trajectory, NoiseModel())) {
    EXPECT_LT(std::abs(o.distance(SystemVector::Zero())), 0.1);
  }
}

TEST(AreaMatcher, AControlPointsErrorIsOneInAllStrips) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(1, -8.0, 58.0, {0, 0, 0}), b = sampled(2, -8.0, 58.0, {0, 0, -0.05});
  const AreaMatcher matcher = matcherOf(a, b);
  const std::vector<ControlPoint> control{{"1", {5.0, 45.0, height(5.0, 45.0)}, 0.03}};
  const AreaObservations found = matcher.matchControl(control, 0.5, trajectory, NoiseModel(), 0.01);
  ASSERT_EQ(found.size(), 2U);
  for (const PairObservation& o : found) {
    EXPECT_EQ(o.a, PairObservation::kControl);
    EXPECT_NEAR(o.distance(SystemVector::Zero()), o.b == 0 ? 0.0 : 0.05 * o.normal.z(), 0.01);
    const double own = found[0].normal.z() * found[1].normal.z() * 0.03 * 0.03;
    EXPECT_NEAR(o.variance_inflation, 1.0 + own / o.variance, 1e-6);  // single precision
    EXPECT_GT(o.variance, 0.9 * own);
  }
}

TEST(AreaMatcher, PatchesAreThoseOfTheWholeTin) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(8, -8.0, 58.0, {0, 0, 0}), b = sampled(9, -60.0, 110.0, {0, 0, -0.05});
  const AreaMatcher part = matcherOf(a, b);  // keeps of b what the margin holds
  AreaMatcher whole(SurveyArea{{0.0, 0.0}, 50.0, 60.0}, 2);
  for (const LidarReturn& p : a) whole.add(0, p);
  for (const LidarReturn& p : b) whole.add(1, p);
  whole.prepare(SurfaceCriterion(), 500, 0.001, trajectory);
  ASSERT_GT(whole.pointCount(), 2 * part.pointCount());
  const PatchSurface &tin_of_part = part.surfaceOf(1), &tin_of_whole = whole.surfaceOf(1);
  for (const LidarReturn& p : a) {
    if (!kMatchedArea.contains(p.position)) continue;
    const auto in_part = tin_of_part.closest(p.position, 0.5),
               in_whole = tin_of_whole.closest(p.position, 0.5);
    ASSERT_EQ(in_part.has_value(), in_whole.has_value());
    if (!in_part) continue;
    // The same triangle; its corners may be counted from another one, which costs rounding.
    EXPECT_NEAR(in_part->signed_normal_distance, in_whole->signed_normal_distance, 1e-12);
  }
}

TEST(AreaMatcher, CorrectsItsPoints) {
  const Trajectory trajectory = flightNorth();
  const auto a = sampled(10, -8.0, 58.0, {0, 0, 0}), b = sampled(11, -8.0, 58.0, {0, 0, 0});
  AreaMatcher matcher = matcherOf(a, b);
  SystemVector biases = SystemVector::Zero();
  biases[indexOf(SystemParameter::range_bias)] = 0.1;
  matcher.correct(BiasEvaluator(std::make_shared<Trajectory>(trajectory), biases), trajectory);
  // Nadir, nearly: a range bias of 10 cm put points 10 cm too low (Eq. (8)), so the correction
  // lifts them.
  const auto& moved = matcher.surfaceOf(0).tin().points();
  EXPECT_NEAR(moved[0].z() - a[0].position.z(), 0.1, 1e-4);
}

/// The second strip measures the area ahead of the sensor at \a first and behind it at \a second.
AreaObservations pairsOfScanHalves(double first, double second, const Trajectory& trajectory) {
  const auto a = sampled(12, -8.0, 58.0, {0, 0, 0});
  auto b = sampled(13, -8.0, 58.0, {0, 0, 0.10}), back = sampled(14, -8.0, 58.0, {0, 0, -0.05});
  for (LidarReturn& p : b) p.time = first;
  for (LidarReturn& p : back) p.time = second;
  b.insert(b.end(), back.begin(), back.end());
  return matcherOf(a, b).match({{0, 1}}, 0.5, trajectory, NoiseModel());
}

TEST(AreaMatcher, MeasuresEachHalfOfAConicalScanner) {
  const Trajectory trajectory = flightNorth();
  const AreaObservations found = pairsOfScanHalves(5.0, 15.0, trajectory);
  std::map<std::pair<int, int>, int> pairs;
  for (const PairObservation& o : found) {
    ++pairs[{o.surfaceA(), o.surfaceB()}];
    const auto offset = [&](int strip, ScanHalf half) {
      return strip == 0 ? 0.0 : half == ScanHalf::fore ? 0.10 : -0.05;
    };
    const double expected = offset(o.a, o.half_a) - offset(o.b, o.half_b);
    // Curvature; a triangle that joins both half-scans would be 0.05 m off on average.
    EXPECT_NEAR(o.distance(SystemVector::Zero()), expected * o.normal.z(), 0.03);
    const auto time = [&](int strip, ScanHalf half) {
      return strip == 0 ? 10.0 : half == ScanHalf::fore ? 5.0 : 15.0;
    };
    EXPECT_NEAR(o.time_a, time(o.a, o.half_a), 1e-9);
    EXPECT_NEAR(o.time_b, time(o.b, o.half_b), 1e-9);
  }
  // Two half-scans with the other strip and with each other, in both directions.
  const int ahead = PairObservation::surfaceIndex(1, ScanHalf::fore),
            back = PairObservation::surfaceIndex(1, ScanHalf::aft);
  ASSERT_EQ(pairs.size(), 6U);
  for (const auto& [a, b] : {std::pair(0, ahead), {0, back}, {ahead, back}}) {
    EXPECT_GT((pairs[{a, b}]), 100);
    EXPECT_GT((pairs[{b, a}]), 100);
  }
}

TEST(AreaMatcher, KeepsAStripWholeThatIsMeasuredOnce) {
  const Trajectory trajectory = flightNorth();
  for (const double second : {10.2, 5.0}) {  // 10.2: successive lines; 5.0: only ahead
    const double first = second < 10.0 ? 3.0 : 10.0;
    for (const PairObservation& o : pairsOfScanHalves(first, second, trajectory)) {
      ASSERT_NE(o.a, o.b);
      ASSERT_EQ(o.half_a, ScanHalf::whole);
      ASSERT_EQ(o.half_b, ScanHalf::whole);
    }
  }
}

/// Of the second strip all returns are e times as intense, and 5 cm too long.
TEST(AreaMatcher, RemovesErrorSourcesFromItsPoints) {
  const Trajectory trajectory = flightNorth();
  auto a = sampled(15, -8.0, 58.0, {0, 0, 0}), b = sampled(16, -8.0, 58.0, {0, 0, -0.05});
  for (LidarReturn& p : a) p.intensity = 100.0F;
  for (LidarReturn& p : b) p.intensity = 271.828F;
  AreaMatcher matcher = matcherOf(a, b);
  ErrorSourceScale scale;
  scale.largest_angle = 0.3;
  scale.median_intensity = 100.0;
  matcher.considerSources(scale);
  ErrorSourceVector value = ErrorSourceVector::Zero();
  value[indexOf(ErrorSource::intensity_ranging)] = 0.05;
  const BiasEvaluator none(std::make_shared<Trajectory>(trajectory), SystemVector::Zero());
  matcher.correct({{&none}, {&none}}, value, trajectory);
  EXPECT_NEAR(matcher.surfaceOf(0).tin().points()[0].z() - a[0].position.z(), 0.0, 1e-12);
  EXPECT_NEAR(matcher.surfaceOf(1).tin().points()[0].z() - b[0].position.z(), 0.05, 1e-4);
  const AreaObservations found = matcher.match({{0, 1}}, 0.02, trajectory, NoiseModel());
  EXPECT_GT(found.size(), 500U);
  for (const PairObservation& o : found) {
    // The equation remains that of the points as read; 1 cm: curvature.
    EXPECT_NEAR(o.distance(SystemVector::Zero()), o.effectOfSources(value), 0.01);
    EXPECT_NEAR(std::abs(o.effectOfSources(value)), 0.05 * o.normal.z(), 2e-3);
  }
}

struct MeanDistance {
  double value = 0.0, variance = 0.0, independent = 0.0;  ///< as if the pairs shared nothing
};

/// Of two strips of level ground under 2 cm of noise, weighted as the adjustment weighs pairs; all
/// points look for patches.
MeanDistance meanDistance(unsigned draw) {
  std::mt19937_64 random(draw);
  std::normal_distribution<double> noise(0.0, 0.02);
  std::vector<LidarReturn> strips[2] = {sampled(2 * draw, -8.0, 58.0, {0, 0, 0}),
                                        sampled(2 * draw + 1, -8.0, 58.0, {0, 0, 0})};
  for (auto& strip : strips) {
    for (LidarReturn& p : strip) p.position.z() = 100.0 + noise(random);
  }
  const Trajectory trajectory = flightNorth();
  double sum = 0.0, weights = 0.0, pairs = 0.0;
  for (const PairObservation& o :
       matcherOf(strips[0], strips[1], 1'000'000)
           .match({{0, 1}}, 0.5, trajectory, NoiseModel{0.02, 0.0, 0.0, 0.0})) {
    const double weight = 1.0 / (o.variance * o.variance_inflation);
    sum += (o.a == 0 ? weight : -weight) * o.distance(SystemVector::Zero());
    weights += weight;
    pairs += 1.0 / o.variance;
  }
  return {sum / weights, 1.0 / weights, 1.0 / pairs};
}

TEST(AreaMatcher, SaysWhatPairsShare) {
  constexpr int kDraws = 25;
  double squares = 0.0, said = 0.0, independent = 0.0;
  for (unsigned draw = 1; draw <= kDraws; ++draw) {
    const MeanDistance mean = meanDistance(draw);
    squares += mean.value * mean.value;
    said += mean.variance;
    independent += mean.independent;
  }
  // A mean square of 25 draws is known to 28 %: twice that and more, either way.
  EXPECT_LT(squares, 1.7 * said);
  EXPECT_GT(squares, 0.4 * said);
  // Every point seeks one patch and is, on the mean, once a vertex: n points of either strip tell
  // their difference to 2 s^2 / n, and 2 n pairs of variance 1.5 s^2 would to 0.75 s^2 / n.
  EXPECT_NEAR(said / independent, 2.0 / 0.75, 0.4);
}

}  // namespace
}  // namespace pcl_als
