// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/strip_group.h>

namespace pcl_als {
namespace {

using Strips = std::vector<std::string>;

TEST(StripGroup, ReadsIdsRangesAndChannels) {
  const StripGroup group = stripGroup("north=1,7-9,line2");
  EXPECT_EQ(group.name, "north");
  EXPECT_EQ(group.strips, (Strips{"1", "7", "8", "9", "line2"}));
  EXPECT_EQ(stripGroup("aft=3-4:1").strips, (Strips{"3.ch1", "4.ch1"}));
  EXPECT_EQ(stripGroup("a=flight-12").strips, (Strips{"flight-12"}));  // no range of numbers
}

TEST(StripGroup, RefusesOtherForms) {
  for (const char* text : {"", "north", "=1", "north=", "north=1,,2", "a=1:x", "a=1:256", "a=1:-1"})
    EXPECT_THROW(stripGroup(text), UsageError) << text;
}

TEST(StripGroup, KnowsThePassOfAChannel) {
  EXPECT_EQ(passOfStrip(channelStrip("3", 1)), "3");
  EXPECT_EQ(passOfStrip("3"), "3");
  EXPECT_EQ(passOfStrip("a.ch"), "a.ch");
  EXPECT_EQ(passOfStrip("a.chip"), "a.chip");
}

TEST(PerSystemParameters, ReadsNamesAndGroups) {
  using P = SystemParameter;
  const PerSystemParameters own = ownUnknowns("boresight,range_bias,offset");
  EXPECT_EQ(own.parameters, (std::vector<P>{P::boresight_pitch, P::boresight_roll,
                                            P::boresight_heading, P::range_bias}));
  EXPECT_TRUE(own.offset);
  EXPECT_EQ(ownUnknowns("lever_arm").parameters.size(), 3U);
  EXPECT_FALSE(ownUnknowns("range_bias").offset);
  EXPECT_THROW(ownUnknowns("bore"), UsageError);
  EXPECT_THROW(ownUnknowns(""), UsageError);
}

TEST(SystemLookup, FindsTheSystemOfSourceIdsChannelsAndFiles) {
  CalibrationResult calibration;
  calibration.systems.resize(2);
  calibration.systems[0].group = {"fore", {"1.ch0", "2", "tile"}};
  calibration.systems[1].group = {"aft", {"1.ch1"}};
  SystemLookup lookup(calibration);
  EXPECT_EQ(lookup.of(1, 0), 0);
  EXPECT_EQ(lookup.of(1, 1), 1);
  EXPECT_EQ(lookup.of(2, 5), 0);  // of all channels
  lookup.setStrip("tile");
  EXPECT_EQ(lookup.of(0, 0), 0);
  lookup.setStrip("other");
  EXPECT_THROW(lookup.of(0, 0), InputError);
  EXPECT_THROW(lookup.of(1, 2), InputError);
  EXPECT_TRUE(SystemLookup().single());
  EXPECT_EQ(SystemLookup().of(77, 3), 0);
}

TEST(SystemLookup, StatesWhatPointsLack) {
  EXPECT_EQ(SystemLookup().objection(false, false), "");
  CalibrationResult calibration;
  calibration.channel_field = "beam";
  calibration.systems.resize(2);
  calibration.systems[0].group = {"fore", {"1.ch0"}};
  calibration.systems[1].group = {"aft", {"1.ch1"}};
  SystemLookup lookup(calibration);
  EXPECT_EQ(lookup.channelField(), "beam");
  EXPECT_EQ(lookup.objection(true, true), "");
  EXPECT_NE(lookup.objection(true, false).find("field beam"), std::string::npos);
  EXPECT_NE(lookup.objection(false, true).find("point source id"), std::string::npos);
  lookup.setStrip("1");
  EXPECT_EQ(lookup.objection(false, true), "");
  // Points of one channel need no field for it.
  calibration.systems[1].group = {"aft", {"2.ch0"}};
  EXPECT_EQ(SystemLookup(calibration).objection(true, false), "");
}

TEST(StripGroup, AChannelIsANumberUpTo255) {
  EXPECT_EQ(channelOfValue(255.0, "field"), 255);
  for (const double value : {-1.0, 256.0, std::nan("")})
    EXPECT_THROW(channelOfValue(value, "field"), InputError) << value;
}

TEST(SystemLookup, FindsStripsThatWereHeldFixed) {
  CalibrationResult calibration;
  calibration.held.push_back({"dem.tif", {}});
  EXPECT_TRUE(SystemLookup(calibration).single());
  calibration.held.push_back({"fixed strips", {"4"}});
  const SystemLookup lookup(calibration);
  EXPECT_FALSE(lookup.single());
  EXPECT_EQ(lookup.of(4, 0), lookup.fixed());
  EXPECT_EQ(lookup.of(5, 0), 0);
  calibration.systems.resize(2);
  calibration.systems[1].group = {"aft", {"5"}};
  EXPECT_EQ(SystemLookup(calibration).of(4, 0), 2);
}

}  // namespace
}  // namespace pcl_als
