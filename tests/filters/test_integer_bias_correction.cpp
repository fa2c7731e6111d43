// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/integer_bias_correction.h>

#include "swath.h"

namespace pcl_als {
namespace {

using test::effectAt;
using test::flownNorth;
using test::kOrigin;
using test::swath;
using test::SwathPoint;
using test::typicalBiases;
using Records = std::vector<std::byte>;

/// Records of LAS point format 6 with 3 extra bytes: X Y Z at 0, time at 22.
const IntegerBiasCorrection::Layout kLayout{
    33,
    LasRecordLayout::of(6),
    {Eigen::Vector3d(0.001, 0.001, 0.01), Eigen::Vector3d(583000.0, 5283000.0, 0.0)},
    {}};

Records recordsOf(const std::vector<SwathPoint>& points) {
  Records records(points.size() * kLayout.record_length);
  for (std::size_t i = 0; i < records.size(); ++i) records[i] = static_cast<std::byte>(i * 31);
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::byte* record = &records[i * kLayout.record_length];
    for (int axis = 0; axis < 3; ++axis) {
      const auto raw = static_cast<std::int32_t>(std::lround(
          (points[i].ground[axis] - kLayout.metres.offset[axis]) / kLayout.metres.scale[axis]));
      std::memcpy(record + 4 * axis, &raw, sizeof raw);
    }
    std::memcpy(record + 22, &points[i].time, sizeof(double));
  }
  return records;
}

std::int32_t rawAt(const Records& records, std::size_t point, int axis) {
  std::int32_t raw;
  std::memcpy(&raw, &records[point * kLayout.record_length + 4 * static_cast<std::size_t>(axis)],
              sizeof raw);
  return raw;
}

SwathPoint recordedPoint(const Records& records, std::size_t point) {
  SwathPoint result{};
  for (int axis = 0; axis < 3; ++axis) {
    result.ground[axis] =
        rawAt(records, point, axis) * kLayout.metres.scale[axis] + kLayout.metres.offset[axis];
  }
  std::memcpy(&result.time, &records[point * kLayout.record_length + 22], sizeof(double));
  return result;
}

SystemCorrection systemCorrection(const SystemVector& biases, bool invert = false) {
  return {biases, flownNorth(kOrigin, 20.0), invert};
}

IntegerBiasCorrection correction(const SystemVector& biases, bool invert = false) {
  return {"strip.las", systemCorrection(biases, invert), kLayout};
}

TEST(IntegerBiasCorrection, MovesEachIntegerByTheRoundedEffect) {
  const Records before = recordsOf(swath(kOrigin, 20.0, 1000));
  Records after = before;
  const auto engine = correction(typicalBiases());
  const CoverageCount coverage = engine.apply(after.data(), 1000, 0);
  EXPECT_EQ(coverage.points, 1000U);
  EXPECT_EQ(coverage.missed(), 0U);
  const auto reference = flownNorth(kOrigin, 20.0);
  int moved = 0;
  for (std::size_t i = 0; i < 1000; ++i) {
    const Eigen::Vector3d effect = effectAt(*reference, recordedPoint(before, i), typicalBiases());
    for (int axis = 0; axis < 3; ++axis) {
      const int change = rawAt(after, i, axis) - rawAt(before, i, axis);
      // Half a unit, and 1e-7 of one for the way the effect is computed.
      EXPECT_NEAR(change, -effect[axis] / kLayout.metres.scale[axis], 0.5 + 1e-6);
      if (change != 0) ++moved;
    }
  }
  EXPECT_GT(moved, 2000);
}

TEST(IntegerBiasCorrection, ChangesNoByteBehindTheCoordinates) {
  const Records before = recordsOf(swath(kOrigin, 20.0, 1000));
  Records after = before;
  correction(typicalBiases()).apply(after.data(), 1000, 0);
  for (std::size_t i = 0; i < 1000; ++i) {
    const std::size_t at = i * kLayout.record_length + 12;
    ASSERT_EQ(std::memcmp(&before[at], &after[at], kLayout.record_length - 12), 0) << i;
  }
}

TEST(IntegerBiasCorrection, ZeroBiasesChangeNoByte) {
  const Records before = recordsOf(swath(kOrigin, 20.0, 1000));
  for (const bool invert : {false, true}) {
    Records after = before;
    correction(SystemVector::Zero(), invert).apply(after.data(), 1000, 0);
    EXPECT_EQ(before, after);
  }
}

TEST(IntegerBiasCorrection, InvertReturnsEveryIntegerToWithinOne) {
  const Records before = recordsOf(swath(kOrigin, 20.0, 5000));
  const SystemVector biases = 10.0 * typicalBiases();
  Records records = before;
  correction(biases).apply(records.data(), 5000, 0);
  correction(biases, true).apply(records.data(), 5000, 0);
  int exact = 0;
  for (std::size_t i = 0; i < 5000; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      const int difference = rawAt(records, i, axis) - rawAt(before, i, axis);
      ASSERT_LE(std::abs(difference), 1);
      if (difference == 0) ++exact;
    }
  }
  EXPECT_GT(exact, 14000);
}

TEST(IntegerBiasCorrection, BlocksOfTilesGiveTheSameBytes) {
  const Records before = recordsOf(swath(kOrigin, 20.0, 3000));
  for (const bool invert : {false, true}) {
    const auto engine = correction(typicalBiases(), invert);
    Records whole = before, parts = before;
    engine.apply(whole.data(), 3000, 0);
    const std::size_t block = 2 * IntegerBiasCorrection::kTile;
    for (std::size_t first = 0; first < 3000; first += block) {
      engine.apply(&parts[first * kLayout.record_length], std::min(block, 3000 - first), first);
    }
    EXPECT_EQ(whole, parts);
  }
}

TEST(IntegerBiasCorrection, HundredKilometresAreRightToAMillimetre) {
  constexpr double kSeconds = 100000.0 / 60.0;
  const auto trajectory = flownNorth(kOrigin, kSeconds);
  const auto points = swath(kOrigin, kSeconds, 60000);
  Records records = recordsOf(points);
  const Records before = records;
  IntegerBiasCorrection("strip.las", SystemCorrection(typicalBiases(), trajectory), kLayout)
      .apply(records.data(), points.size(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SwathPoint biased = recordedPoint(before, i);
    const Eigen::Vector3d expected = biased.ground - effectAt(*trajectory, biased, typicalBiases());
    const Eigen::Vector3d off = (recordedPoint(records, i).ground - expected).cwiseAbs();
    // Half a unit of the scale: 1 mm in plan, 1 cm in height here.
    ASSERT_LT(off.head<2>().maxCoeff(), 0.000501) << i;
    ASSERT_LT(off.z(), 0.005001) << i;
  }
}

TEST(IntegerBiasCorrection, PointsWithoutTrajectoryAreCountedAndStay) {
  auto points = swath(kOrigin, 20.0, 600);
  points[5].time = -1.0, points[300].time = 1e9;
  const Records before = recordsOf(points);
  Records after = before;
  const CoverageCount coverage = correction(typicalBiases()).apply(after.data(), 600, 0);
  EXPECT_EQ(coverage.before_start, 1U);
  EXPECT_EQ(coverage.after_end, 1U);
  EXPECT_EQ(rawAt(before, 300, 0), rawAt(after, 300, 0));
  EXPECT_NE(rawAt(before, 301, 0), rawAt(after, 301, 0));
}

TEST(IntegerBiasCorrection, TimesAreAlignedAndKept) {
  const Records before = recordsOf(swath(kOrigin, 20.0, 600));
  Records expected = before, after = before;
  correction(typicalBiases()).apply(expected.data(), 600, 0);
  for (std::size_t i = 0; i < 600; ++i) {
    const double shifted = recordedPoint(before, i).time + 604800.0;
    std::memcpy(&after[i * kLayout.record_length + 22], &shifted, sizeof shifted);
  }
  TimeAlignment alignment;
  alignment.offset = -604800.0;
  SystemCorrection aligned = systemCorrection(typicalBiases());
  aligned.setTimeAlignment(alignment);
  IntegerBiasCorrection("strip.las", aligned, kLayout).apply(after.data(), 600, 0);
  for (std::size_t i = 0; i < 600; ++i) {
    EXPECT_GE(recordedPoint(after, i).time, 604800.0);
    // Times of 6e5 s are rounded to 1e-10 s: 6e-9 m.
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(rawAt(after, i, axis), rawAt(expected, i, axis), 1) << i;
    }
  }
}

TEST(IntegerBiasCorrection, NamesThePointThatNoLongerFits) {
  for (const bool above : {false, true}) {
    Records records = recordsOf(swath(kOrigin, 20.0, 600));
    const std::int32_t raw =
        above ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int32_t>::min();
    std::memcpy(&records[400 * kLayout.record_length + 4], &raw, sizeof raw);
    const SystemVector biases = SystemVector::Unit(1) * (above ? -1.0 : 1.0);
    try {
      correction(biases).apply(records.data(), 600, 1000000);
      FAIL();
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find("strip.las: point 1000400: y = "), std::string::npos) << text;
    }
  }
}

TEST(IntegerBiasCorrection, ExtremeIntegersThatFitAreRight) {
  Records records = recordsOf(swath(kOrigin, 20.0, 4));
  const std::int32_t lowest = std::numeric_limits<std::int32_t>::min();
  const std::int32_t highest = std::numeric_limits<std::int32_t>::max();
  std::memcpy(&records[4], &lowest, sizeof lowest);
  std::memcpy(&records[kLayout.record_length + 4], &highest, sizeof highest);
  const Records before = records;
  correction(SystemVector::Zero()).apply(records.data(), 4, 0);
  EXPECT_EQ(before, records);
}

TEST(IntegerBiasCorrection, RefusesAScaleThatIsNone) {
  for (const double scale : {0.0, -1e-12, std::nan(""), std::numeric_limits<double>::infinity()}) {
    auto layout = kLayout;
    layout.metres.scale.y() = scale;
    EXPECT_THROW(IntegerBiasCorrection("a.las", systemCorrection(typicalBiases()), layout),
                 InputError);
  }
  EXPECT_THROW(SystemCorrection(typicalBiases(), nullptr), UsageError);
}

}  // namespace
}  // namespace pcl_als
