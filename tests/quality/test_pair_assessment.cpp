// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/quality/pair_assessment.h>

#include "swath_scenes.h"

namespace pcl_als {
namespace {

/// Samples on a grid of 20 m cells; heights differ by value(x, y).
template <typename Value>
std::vector<OffsetSample> levelSamples(Value value, int side = 200) {
  std::vector<OffsetSample> samples;
  for (int y = 0; y < side; y += 2) {
    for (int x = 0; x < side; x += 2) {
      OffsetSample s;
      s.position = test::kOrigin + Eigen::Vector3d(x, y, 0.0);
      s.level = s.conjugate = true;
      s.vertical = s.normal_distance = value(x, y);
      samples.push_back(s);
    }
  }
  return samples;
}

// Half the places 1 cm, half 7 cm: mean 4, sd 3 (with n - 1: 3.0002), RMS sqrt(25) = 5 cm.
TEST(PairAssessment, VerticalFiguresByHand) {
  const auto samples =
      levelSamples([](int x, int y) { return (x / 2 + y / 2) % 2 == 0 ? 0.01 : 0.07; });
  const PairAssessment pair = assessPair(samples, {}, {});
  EXPECT_EQ(pair.status, PairAssessment::Status::judged);
  EXPECT_EQ(pair.vertical.count, 10000U);
  EXPECT_NEAR(pair.vertical.mean, 0.04, 1e-12);
  EXPECT_NEAR(pair.vertical.rms, 0.05, 1e-12);
  EXPECT_NEAR(pair.vertical.std, 0.03, 1e-5);
  EXPECT_NEAR(pair.vertical.percentile_95, 0.07, 1e-12);
  EXPECT_EQ(pair.quality_level, 1);  // more than 4, at most 8 cm
  // Neighbours cancel: cells of 25 m all have about the mean.
  EXPECT_NEAR(pair.vertical_cells.rms, 0.04, 1e-3);
  EXPECT_LT(pair.vertical.std_of_mean, 1e-3);
}

// 20 blocks of 50 m with errors of 3 cm each: the mean is known to 3 cm / sqrt(16) at best, not to
// 3 cm / sqrt(10000).
TEST(PairAssessment, StandardDeviationOfTheMeanKnowsNeighboursErrTogether) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise(0.0, 0.03);
  double squares = 0.0, stds = 0.0;
  constexpr int kBlocks = 100;
  for (int block = 0; block < kBlocks; ++block) {
    double cell[8][8];
    for (auto& row : cell)
      for (double& value : row) value = noise(random);
    const auto samples = levelSamples([&](int x, int y) { return cell[y / 25][x / 25]; });
    const PairAssessment pair = assessPair(samples, {}, {});
    squares += pair.vertical.mean * pair.vertical.mean / kBlocks;
    stds += pair.vertical.std_of_mean / kBlocks;
  }
  // 64 cells: 3 cm / 8 = 3.75 mm; a hundred blocks know it to 7 %, three of which are 21 %.
  EXPECT_NEAR(stds / std::sqrt(squares), 1.0, 0.25);
  EXPECT_NEAR(stds, 0.00375, 0.0006);
}

// Strips tilted against each other by 0.4 mm per metre: the means of the western and the eastern
// half differ by 4 cm. With cells taken as independent, each was known to 2 mm.
TEST(PairAssessment, StandardDeviationOfTheMeanKnowsTiltedStrips) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.02);
  OffsetSummary halves[2];
  for (int half = 0; half < 2; ++half) {
    const auto samples =
        levelSamples([&](int x, int) { return 4e-4 * (x + 100.0 * half) + noise(random); }, 100);
    halves[half] = assessPair(samples, {}, {}).vertical;
  }
  const double difference = halves[1].mean - halves[0].mean;
  EXPECT_NEAR(difference, 0.04, 0.002);
  const double std = std::hypot(halves[0].std_of_mean, halves[1].std_of_mean);
  // Adjacent halves of a uniform tilt: 1 / (sqrt(2) sqrt(1/12)) = 2.45 standard deviations.
  EXPECT_LT(difference / std, 2.6);
  EXPECT_GT(difference / std, 1.0);
}

TEST(PairAssessment, HorizontalShiftFromRoofs) {
  using namespace test;
  Flight first, other;
  first.noise = other.noise = 0.01;
  other.seed = 2;
  other.shift = {0.12, -0.07, 0.03};  // b is east of a: a has to go there
  const AreaOffsets area = areaOf(fly(village, first, kOrigin), fly(village, other, kOrigin));
  const PairAssessment pair = assessPair(area.offsets(0, 1), {}, {});
  ASSERT_TRUE(pair.horizontal.determined) << pair.horizontal.reason;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(pair.horizontal.shift[i], other.shift[i],
                4.0 * pair.horizontal.std[i] + 0.002)  // 2 mm: patches smooth ridges
        << i;
    EXPECT_LT(pair.horizontal.std[i], 0.01);
  }
  // Signs by class: b moved east by e lies lower under a on slopes that fall to the east? A point
  // of a on an east slope is n_x * (-0.12) above b: negative; on a west slope positive.
  double east = 0.0, west = 0.0;
  for (const SlopeAspectClass& c : pair.classes) {
    if (c.slope_from != 30.0) continue;
    if (c.aspect == 2) east = c.mean;
    if (c.aspect == 6) west = c.mean;
  }
  const double slope = std::atan(0.6);
  EXPECT_NEAR(east, -0.12 * std::sin(slope) - 0.03 * std::cos(slope), 0.005);
  EXPECT_NEAR(west, 0.12 * std::sin(slope) - 0.03 * std::cos(slope), 0.005);
}

// True errors over reported deviations, RMS over 40 noise seeds: 1 if they are honest; four houses
// and a field are so few cells of ground that anything from 0.6 to 1.3 is.
TEST(PairAssessment, StandardDeviationsCoverTheNoise) {
  using namespace test;
  double shift = 0.0, height = 0.0;
  constexpr int kSeeds = 40;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    Flight first, other;
    first.noise = other.noise = 0.02;
    first.seed = 2 * seed;
    other.seed = 2 * seed + 1;
    const AreaOffsets area = areaOf(fly(village, first, kOrigin), fly(village, other, kOrigin));
    const PairAssessment pair = assessPair(area.offsets(0, 1), {}, {});
    ASSERT_TRUE(pair.horizontal.determined);
    shift += pair.horizontal.shift.cwiseQuotient(pair.horizontal.std).squaredNorm() / (3 * kSeeds);
    height += std::pow(pair.vertical.mean / pair.vertical.std_of_mean, 2) / kSeeds;
  }
  EXPECT_LT(std::sqrt(shift), 1.3);
  EXPECT_GT(std::sqrt(shift), 0.6);
  EXPECT_LT(std::sqrt(height), 1.3);
  EXPECT_GT(std::sqrt(height), 0.6);
}

TEST(PairAssessment, SlopesOfOneDirectionDetermineNoShift) {
  std::vector<OffsetSample> samples = levelSamples([](int, int) { return 0.02; });
  for (OffsetSample& s : samples) {
    s.slope = 0.4F;
    s.normal = Eigen::Vector3d(std::sin(0.4), 0.0, std::cos(0.4));
  }
  const PairAssessment pair = assessPair(samples, {}, {});
  EXPECT_FALSE(pair.horizontal.determined);
  EXPECT_NE(pair.horizontal.reason, "");
}

TEST(PairAssessment, TooLittleAndCopiesAreNotJudged) {
  EXPECT_EQ(assessPair({}, {}, {}).status, PairAssessment::Status::too_little);
  const auto few = levelSamples([](int, int) { return 0.02; }, 12);  // 36 places
  const PairAssessment pair = assessPair(few, {}, {});
  EXPECT_EQ(pair.status, PairAssessment::Status::too_little);
  EXPECT_NE(pair.reason.find("36 places"), std::string::npos) << pair.reason;
  EXPECT_FALSE(pair.quality_level);
  auto copy = levelSamples([](int, int) { return 0.0; });
  for (OffsetSample& s : copy) s.identical = true;
  EXPECT_EQ(assessPair(copy, {}, {}).status, PairAssessment::Status::copy);
}

// Over the ground that all three see (x < 100) offsets are consistent; elsewhere they need not be.
TEST(PairAssessment, TrianglesCloseOnCommonGround) {
  const auto ab = levelSamples([](int x, int) { return x < 100 ? 0.02 : 0.5; });
  auto bc = levelSamples([](int, int) { return 0.03; }), ac = bc;
  for (OffsetSample& s : ac) s.vertical = 0.06;  // 1 cm too much
  const auto west = [](const OffsetSample& s) { return s.position.x() < test::kOrigin.x() + 100; };
  std::vector<OffsetSample> bc_west;
  for (const OffsetSample& s : bc)
    if (west(s)) bc_west.push_back(s);
  const auto closed = closeTriangles(
      {{"7", "8", cellMeans(ab)}, {"8", "9", cellMeans(bc_west)}, {"7", "9", cellMeans(ac)}});
  ASSERT_EQ(closed.size(), 1U);
  EXPECT_EQ(closed[0].a + closed[0].b + closed[0].c, "789");
  EXPECT_NEAR(closed[0].closure, 0.02 + 0.03 - 0.06, 1e-12);
  EXPECT_NEAR(closed[0].std, 0.0, 1e-12);
  // Named the other way round, a pair has the other sign.
  for (OffsetSample& s : ac) s.vertical = -0.06;
  const auto turned = closeTriangles(
      {{"7", "8", cellMeans(ab)}, {"9", "7", cellMeans(ac)}, {"8", "9", cellMeans(bc_west)}});
  ASSERT_EQ(turned.size(), 1U);
  EXPECT_NEAR(turned[0].closure, -0.01, 1e-12);
  EXPECT_TRUE(closeTriangles({{"7", "8", cellMeans(ab)}, {"8", "9", cellMeans(bc)}}).empty());
}

}  // namespace
}  // namespace pcl_als
