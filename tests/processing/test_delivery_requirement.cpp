// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/quality/accuracy_standards.h>

namespace pcl_als {
namespace {

CheckedPair pairOf(const char* a, const char* b, double rms) {
  CheckedPair pair;
  pair.a = a, pair.b = b;
  pair.overlap_area = 1e5;
  pair.assessment.status = PairAssessment::Status::judged;
  pair.assessment.vertical.rms = rms;
  pair.assessment.quality_level = swathQualityLevel(rms);
  return pair;
}

CheckedPair unmeasured(const char* a, const char* b, bool too_small) {
  CheckedPair pair;
  pair.a = a, pair.b = b;
  pair.too_small = too_small;
  pair.assessment.reason = "only 3 places";
  return pair;
}

ControlAssessment controlOf(std::size_t points, double rmse) {
  ControlAssessment control;
  control.points = points;
  if (points == 0) return control;
  control.accuracy = verticalAccuracy(rmse, 0.02, points);
  control.quality_level = absoluteQualityLevel(rmse);
  return control;
}

TEST(DeliveryRequirement, EveryPairIsWithinTheLimit) {
  CheckedBlock block;
  block.pairs = {pairOf("1", "2", 0.05), pairOf("2", "3", 0.08), unmeasured("1", "3", true)};
  const DeliveryRequirement kept = requireLevel(block, 2);
  EXPECT_TRUE(kept.kept);
  EXPECT_EQ(kept.pairs, 2U);
  EXPECT_EQ(kept.describe(), "the delivery keeps QL2");
  EXPECT_TRUE(requireLevel(block, 3).kept);
  const DeliveryRequirement missed = requireLevel(block, 0);  // 4 cm
  EXPECT_FALSE(missed.kept);
  EXPECT_EQ(missed.reasons.size(), 2U);
  EXPECT_EQ(missed.describe(),
            "the delivery does not keep QL0: strips 1 and 2: RMSDz 5.00 cm, more than the 4 cm "
            "that are allowed; strips 2 and 3: RMSDz 8.00 cm, more than the 4 cm that are allowed");
}

TEST(DeliveryRequirement, APairThatWasNotMeasuredDoesNotShowTheLevel) {
  CheckedBlock block;
  block.pairs = {pairOf("1", "2", 0.01), unmeasured("2", "3", false)};
  const DeliveryRequirement requirement = requireLevel(block, 3);
  EXPECT_FALSE(requirement.kept);
  EXPECT_EQ(requirement.describe(),
            "the delivery does not keep QL3: strips 2 and 3: not measured (only 3 places)");
  block.pairs = {unmeasured("1", "2", true)};
  EXPECT_EQ(requireLevel(block, 3).describe(),
            "the delivery does not keep QL3: nothing could be measured");
}

TEST(DeliveryRequirement, ControlIsPartOfItWhereItIsGiven) {
  CheckedBlock block;
  block.pairs = {pairOf("1", "2", 0.03)};
  block.control = controlOf(12, 0.07);
  EXPECT_TRUE(requireLevel(block, 2).kept);
  EXPECT_EQ(requireLevel(block, 2).control_points, 12U);
  EXPECT_EQ(requireLevel(block, 0).describe(),
            "the delivery does not keep QL0: control: RMSE 7.00 cm, more than the 5 cm that are "
            "allowed");
  block.control = controlOf(0, 0.0);
  EXPECT_EQ(requireLevel(block, 2).describe(),
            "the delivery does not keep QL2: no strip covers a control point");
  block.pairs.clear();
  block.control = controlOf(12, 0.07);  // one strip over control
  EXPECT_TRUE(requireLevel(block, 2).kept);
}

TEST(DeliveryRequirement, ALineNamesThreeReasonsAndCountsTheOthers) {
  CheckedBlock block;
  for (const char* b : {"2", "3", "4", "5", "6"}) block.pairs.push_back(pairOf("1", b, 0.5));
  const DeliveryRequirement requirement = requireLevel(block, 1);
  EXPECT_EQ(requirement.reasons.size(), 5U);
  EXPECT_NE(requirement.describe().find("; and 2 more reasons"), std::string::npos);
  EXPECT_THROW(requireLevel(block, 4), UsageError);
  EXPECT_THROW(requireLevel(block, -1), UsageError);
}

// Two flights of two strips that are 2.3 m apart, one pair under forest and one edge in common.
TEST(DeliveryRequirement, EveryOverlappingPairIsCounted) {
  CheckedBlock block;
  block.pairs = {pairOf("1", "2", 0.03), pairOf("3", "4", 0.03), unmeasured("2", "4", false),
                 unmeasured("1", "4", true)};
  for (const char* a : {"1", "2"}) {
    CheckedPair& pair = block.pairs.emplace_back(unmeasured(a, "3", false));
    pair.assessment.status = PairAssessment::Status::too_far;
    pair.assessment.apart = -2.304;
  }
  const PairCounts counts = countPairs(block.pairs);
  EXPECT_EQ(counts.measured, 2U);
  EXPECT_EQ(counts.too_far, 2U);
  EXPECT_EQ(counts.unmeasurable, 1U);
  EXPECT_EQ(counts.too_small, 1U);
  EXPECT_EQ(counts.all(), 5U);
  const auto sentences = unmeasuredPairs(block.pairs);
  ASSERT_EQ(sentences.size(), 2U);
  EXPECT_EQ(sentences[0],
            "2 overlapping pairs lie too far apart in height to be compared: strips 1 and 3 "
            "(2.30 m), 2 and 3 (2.30 m)");
  EXPECT_EQ(sentences[1],
            "1 overlapping pair could not be measured: strips 2 and 4 (only 3 places)");
  const DeliveryRequirement requirement = requireLevel(block, 3);
  EXPECT_FALSE(requirement.kept);
  ASSERT_EQ(requirement.reasons.size(), 3U);
  EXPECT_EQ(requirement.reasons[1],
            "strips 1 and 3: too far apart in height to be compared (2.30 m)");
}

TEST(DeliveryRequirement, ControlThatIsFarOffIsAReason) {
  CheckedBlock block;
  block.control = controlOf(12, 0.03);
  block.control->no_class = "4 of 12 control points lie more than 1 m above or below the strips";
  EXPECT_EQ(requireLevel(block, 3).describe(),
            "the delivery does not keep QL3: 4 of 12 control points lie more than 1 m above or "
            "below the strips");
}

}  // namespace
}  // namespace pcl_als
