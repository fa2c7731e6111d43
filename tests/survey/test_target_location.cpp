// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <optional>
#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <pcl_als/survey/target_location.h>

namespace pcl_als {
namespace {

/// Ground with a target, measured by pulses with a footprint that is sampled point by point.
struct Ground {
  double radius = 1.0, spacing = 0.5, footprint = 0.08;
  double ground = 100.0, target = 400.0;
  double noise = 0.05;                    ///< of an intensity, over its value
  double jitter = 0.01;                   ///< of the coordinates, metres
  double across = 1.0;                    ///< spacing of the scan lines over that of the points
  double texture = 0.2;                   ///< of the ground, over its level, smooth over a metre
  std::optional<Eigen::Vector4d> bright;  ///< a rectangle: lower and upper corner
};

struct Measured {
  std::vector<TargetPoint> points;
  Eigen::Vector2d centre;  ///< true
};

Measured measured(const Ground& g, unsigned seed, double offset = 1.0) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Measured m;
  m.centre = {offset * uniform(random), offset * uniform(random)};
  const double turn = 3.0 * uniform(random), phase_x = uniform(random), phase_y = uniform(random);
  const double wave = 3.0 * uniform(random);
  const Eigen::Matrix2d rotation{{std::cos(turn), -std::sin(turn)},
                                 {std::sin(turn), std::cos(turn)}};
  const auto level = [&](const Eigen::Vector2d& at) {
    if ((at - m.centre).norm() < g.radius) return g.target;
    if (g.bright && at.x() > (*g.bright)[0] && at.y() > (*g.bright)[1] && at.x() < (*g.bright)[2] &&
        at.y() < (*g.bright)[3])
      return g.target;
    return g.ground *
           (1.0 + g.texture * std::sin(4.0 * at.x() + wave) * std::sin(3.0 * at.y() + 2.0 * wave));
  };
  const double dx = g.spacing / std::sqrt(g.across), dy = g.spacing * std::sqrt(g.across);
  const double reach = 2.0 + 4.5 * g.radius;  // holds the window, however it is turned
  for (double x = -reach; x < reach; x += dx) {
    for (double y = -reach; y < reach; y += dy) {
      const Eigen::Vector2d on_grid(x + dx * (phase_x + 0.15 * normal(random)),
                                    y + dy * (phase_y + 0.15 * normal(random)));
      const Eigen::Vector2d at = rotation * on_grid;
      constexpr int kSamples = 60;
      double sum = 0.0;
      for (int i = 0; i < kSamples; ++i)
        sum += level(at + g.footprint * Eigen::Vector2d(normal(random), normal(random)));
      const double intensity = sum / kSamples * (1.0 + g.noise * normal(random));
      m.points.push_back(
          {at + g.jitter * Eigen::Vector2d(normal(random), normal(random)), std::round(intensity)});
    }
  }
  return m;
}

TargetSearch searchFor(const Ground& g) {
  return {Eigen::Vector2d::Zero(), g.radius, 2.0, g.jitter, g.footprint};
}

/// Errors over standard deviations of many targets.
struct Outcome {
  double standardised = 0.0, rms = 0.0, std = 0.0;  ///< RMS per coordinate; metres
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();   ///< over the standard deviation of the mean
  int located = 0, tried = 0, wrong = 0;
};

Outcome outcomeOf(const Ground& g, int count, unsigned seed) {
  Outcome outcome;
  double squares = 0.0, errors = 0.0, variances = 0.0;
  for (int i = 0; i < count; ++i) {
    const Measured m = measured(g, seed + static_cast<unsigned>(i));
    const TargetLocation found = locateTarget(m.points, searchFor(g));
    ++outcome.tried;
    if (!found.located()) continue;
    ++outcome.located;
    const Eigen::Vector2d error = found.centre - m.centre;
    const double ratio = error.dot(found.covariance.inverse() * error);
    if (ratio > 25.0) ++outcome.wrong;
    squares += 0.5 * ratio;
    errors += 0.5 * error.squaredNorm();
    variances += 0.5 * found.covariance.trace();
    outcome.mean += error;
  }
  const double n = outcome.located;
  outcome.standardised = std::sqrt(squares / n);
  outcome.rms = std::sqrt(errors / n);
  outcome.std = std::sqrt(variances / n);
  outcome.mean *= std::sqrt(n) / n / outcome.rms;
  return outcome;
}

void print(const char* name, const Outcome& o) {
  std::printf(
      "%-28s %d of %d, error %.4f m, std %.4f m, error/std %.2f, mean %.1f %.1f, wrong %d\n", name,
      o.located, o.tried, o.rms, o.std, o.standardised, o.mean.x(), o.mean.y(), o.wrong);
}

struct Case {
  const char* name;
  Ground ground;
};

Ground with(double radius, double spacing, double footprint, double contrast, double noise,
            double jitter, double across) {
  Ground g;
  g.radius = radius;
  g.spacing = spacing;
  g.footprint = footprint;
  g.target = g.ground * contrast;
  g.noise = noise;
  g.jitter = jitter;
  g.across = across;
  return g;
}

const Case kCases[] = {
    {"dense", with(1.0, 0.2, 0.08, 4.0, 0.05, 0.01, 1.0)},
    {"drone", with(0.3, 0.1, 0.02, 4.0, 0.05, 0.01, 1.0)},
    {"two points a metre", with(1.0, 0.5, 0.08, 4.0, 0.05, 0.02, 1.0)},
    {"sharp edge", with(1.0, 0.5, 0.01, 4.0, 0.05, 0.0, 1.0)},
    {"scan lines far apart", with(1.0, 0.5, 0.08, 4.0, 0.05, 0.02, 2.5)},
    {"weak contrast", with(1.0, 0.4, 0.08, 2.5, 0.10, 0.01, 1.0)},
    {"dark target", with(1.0, 0.4, 0.08, 0.2, 0.05, 0.01, 1.0)},
    {"one point a metre", with(1.5, 1.0, 0.15, 5.0, 0.05, 0.03, 1.0)},
    {"wide footprint", with(1.0, 0.4, 0.25, 4.0, 0.05, 0.03, 1.0)},
};

TEST(TargetLocation, IsUnbiasedWithTrueCovariances) {
  for (const Case& c : kCases) {
    const Outcome o = outcomeOf(c.ground, 80, 1000);
    print(c.name, o);
    EXPECT_GT(o.located, 74) << c.name;
    EXPECT_GT(o.standardised, 0.70) << c.name;
    EXPECT_LT(o.standardised, 1.30) << c.name;
    EXPECT_LT(o.mean.cwiseAbs().maxCoeff(), 3.5) << c.name;
    EXPECT_LE(o.wrong, 1) << c.name;  // beyond five standard deviations
    EXPECT_LT(o.rms, 0.3 * c.ground.spacing) << c.name;
  }
}

TEST(TargetLocation, FindsNothingWithoutContrast) {
  Ground plain;
  plain.target = plain.ground;
  int located = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
    located += locateTarget(measured(plain, seed).points, searchFor(plain)).located() ? 1 : 0;
  EXPECT_LE(located, 1);
  Ground bare = plain;
  bare.texture = 0.0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const TargetLocation found = locateTarget(measured(bare, seed).points, searchFor(bare));
    EXPECT_EQ(found.status, TargetStatus::no_contrast) << seed;
  }
}

TEST(TargetLocation, ASecondBrightObjectIsNoTarget) {
  const Eigen::Vector4d objects[] = {
      {1.8, -2.0, 3.6, 2.0}, {-3.5, -4.5, -1.7, 0.0}, {-4.0, 1.9, 4.0, 6.0}};
  int located = 0;
  for (const Eigen::Vector4d& object : objects) {
    for (unsigned seed = 0; seed < 15; ++seed) {
      Ground g;
      g.bright = object;
      const Measured m = measured(g, seed, 0.5);
      const TargetLocation found = locateTarget(m.points, searchFor(g));
      if (!found.located()) continue;
      ++located;
      EXPECT_LT((found.centre - m.centre).norm(), 5.0 * std::sqrt(found.covariance.trace()))
          << "object at " << object.transpose() << ", seed " << seed;
    }
  }
  EXPECT_GT(located, 0);
  std::printf("with a second object: %d of 45\n", located);
}

TEST(TargetLocation, StatesWhyThereIsNone) {
  const Ground g;
  Measured m = measured(g, 1);
  TargetSearch beside = searchFor(g);
  beside.centre = m.centre + Eigen::Vector2d(2.1, 0.0);
  const TargetStatus away = locateTarget(m.points, beside).status;
  EXPECT_TRUE(away == TargetStatus::at_edge || away == TargetStatus::ambiguous ||
              away == TargetStatus::no_contrast);
  m.points.resize(10);
  EXPECT_EQ(locateTarget(m.points, searchFor(g)).status, TargetStatus::too_few_points);
  for (const TargetStatus status : {TargetStatus::too_few_points, TargetStatus::no_contrast,
                                    TargetStatus::ambiguous, TargetStatus::at_edge})
    EXPECT_FALSE(reasonOf(status).empty());
}

TEST(TargetLocation, CertainReturnsLieOnTheTarget) {
  std::size_t count = 0;
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Ground g;
    const Measured m = measured(g, seed);
    for (const int i : locateTarget(m.points, searchFor(g)).certain) {
      ++count;
      EXPECT_LT((m.points[static_cast<std::size_t>(i)].place - m.centre).norm(), g.radius);
    }
  }
  EXPECT_GT(count, 200U);
}

}  // namespace
}  // namespace pcl_als
