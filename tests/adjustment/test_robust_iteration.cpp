// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/adjustment/robust_iteration.h>

namespace pcl_als {
namespace {

using End = RobustOutcome::End;

/// An iteration whose solutions change by given amounts, and the calls: s(olve), w(eigh).
struct Scripted {
  std::vector<std::optional<double>> changes;
  std::string calls;

  RobustOutcome run(int most_passes, double limit) {
    std::size_t next = 0;
    return reweight(
        most_passes, limit,
        [&] {
          calls += 's';
          return changes.at(next++);
        },
        [&] { calls += 'w'; });
  }
};

TEST(Reweight, EndsWhenTheSolutionNoLongerChanges) {
  Scripted iteration{{0.0, 0.5, 0.2, 0.05}, ""};  // the first change is that from nothing
  const RobustOutcome outcome = iteration.run(10, 0.1);
  EXPECT_TRUE(outcome.converged());
  EXPECT_EQ(outcome.passes, 4);
  EXPECT_EQ(iteration.calls, "swswsws");  // the weights stay those of the last solution
  EXPECT_STREQ(outcome.reason(), "");
}

TEST(Reweight, SaysWhyItDidNot) {
  Scripted slow{{1.0, 0.9, 0.8, 0.7}, ""};
  const RobustOutcome outcome = slow.run(3, 0.1);
  EXPECT_EQ(outcome.end, End::passes_used);
  EXPECT_TRUE(outcome.solved());
  EXPECT_FALSE(outcome.converged());
  EXPECT_EQ(slow.calls, "swsws");
  EXPECT_STREQ(outcome.reason(), "the adjustment did not converge");
  Scripted singular{{1.0, std::nullopt}, ""};
  EXPECT_FALSE(singular.run(3, 0.1).solved());
  EXPECT_EQ(singular.calls, "sws");
  EXPECT_STREQ(RobustOutcome().reason(), "the equations are singular");
}

/// The mean of values, by weighted least squares.
struct Mean {
  std::vector<double> values;
  double mean = 0.0;

  RobustFit fit(const RobustSettings& settings = {}) {
    return fitRobustly(values.size(), settings, [this](const auto& weights, auto& residuals) {
      const Eigen::Map<const Eigen::VectorXd> all(values.data(), weights.size());
      const double change = weights.dot(all) / weights.sum() - mean;
      mean += change;
      residuals = all.array() - mean;
      return std::optional<double>(change * weights.sum() * change);
    });
  }
};

// The scale is 1.4826 * 1.5, whatever the mean: half of the values are within 1.5 of their median
// of 0.5. Only 100 exceeds 1.5 scales: 5 mean = 1.5 scales.
TEST(FitRobustly, MeanByHand) {
  Mean mean{{-2.0, -1.0, 0.0, 1.0, 2.0, 100.0}};
  const RobustFit fit = mean.fit();
  const double scale = 1.4826 * 1.5;
  EXPECT_TRUE(fit.converged());
  EXPECT_DOUBLE_EQ(fit.scale, scale);
  EXPECT_NEAR(mean.mean, 0.3 * scale, 2.0 * kConvergedChange * scale);
  EXPECT_EQ(fit.weights[0], 1.0);
  EXPECT_NEAR(fit.weights[5], 1.5 * scale / (100.0 - mean.mean), 1e-5);
  EXPECT_DOUBLE_EQ(fit.residuals[5], 100.0 - mean.mean);
}

// With a limit near 0, the sum of absolute values is least: at the median.
TEST(FitRobustly, LeastAbsoluteValues) {
  Mean mean{{1.0, 2.0, 4.0, 8.0, 16.0}};
  RobustSettings settings;
  settings.huber = 0.01;
  EXPECT_TRUE(mean.fit(settings).converged());
  EXPECT_NEAR(mean.mean, 4.0, 0.05);
}

TEST(FitRobustly, OnePassIsLeastSquares) {
  Mean mean{{1.0, 2.0, 6.0}};
  RobustSettings settings;
  settings.most_passes = 1;
  const RobustFit fit = mean.fit(settings);
  EXPECT_DOUBLE_EQ(mean.mean, 3.0);
  EXPECT_EQ(fit.weights, Eigen::VectorXd::Ones(3));
}

TEST(FitRobustly, EqualValuesHaveTheLeastScale) {
  Mean mean{std::vector<double>(10, 7.0)};
  const RobustFit fit = mean.fit();
  EXPECT_TRUE(fit.converged());
  EXPECT_EQ(fit.passes, 2);
  EXPECT_EQ(fit.scale, RobustSettings().least_scale);
}

// A scale that grows from pass to pass: it stays after the tenth, so that the iteration can end.
TEST(FitRobustly, TheScaleStaysAtLast) {
  static int calls;
  calls = 0;
  RobustSettings settings;
  settings.most_passes = 30;
  settings.scale = [](std::vector<double>) { return static_cast<double>(++calls); };
  const RobustFit fit =
      fitRobustly(1, settings, [](const auto&, auto&) { return std::optional<double>(1.0); });
  EXPECT_EQ(fit.end, End::passes_used);
  EXPECT_EQ(fit.passes, 30);
  EXPECT_EQ(fit.scale, kScalePasses);
}

}  // namespace
}  // namespace pcl_als
