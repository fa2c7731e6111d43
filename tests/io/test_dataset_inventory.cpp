// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/las/las_writer.h>

#include "las_bytes.h"
#include "real_data.h"
#include "test_files.h"

namespace pcl_als {
namespace {

/// A rectangle of points about 0.5 m apart (four per m2), one row after the other, 100 points a
/// second. Each lies anywhere within 0.2 m of its place, as points on a grid are rounded ones.
PointChunk field(double x, double y, double width, double height, std::uint16_t id,
                 double first_time = 1000.0) {
  PointChunk p;
  const int columns = static_cast<int>(width * 2), rows = static_cast<int>(height * 2);
  p.resize(static_cast<std::size_t>(columns) * rows);
  const auto shift = [](std::size_t i, double irrational) {
    return 0.4 * (std::fmod(static_cast<double>(i) * irrational, 1.0) - 0.5);
  };
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t row = i / columns, column = i % columns;
    p.x[i] = x + 0.25 + 0.5 * static_cast<double>(column) + shift(i, std::sqrt(2.0));
    p.y[i] = y + 0.25 + 0.5 * static_cast<double>(row) + shift(i, std::sqrt(3.0));
    p.z[i] = 10.0;
    p.gps_time[i] = first_time + 0.01 * static_cast<double>(i);
    p.intensity[i] = 100.0F;
    p.point_source_id[i] = id;
    p.return_number[i] = p.number_of_returns[i] = 1;
    p.classification[i] = 2;
  }
  return p;
}

std::filesystem::path writeLas(const std::filesystem::path& path,
                               const std::vector<PointChunk>& parts,
                               TimeKind kind = TimeKind::week_seconds) {
  LasWriterOptions options;
  options.time_kind = kind;
  options.crs = "LOCAL_CS[\"metres\"]";
  LasWriter writer(path, options);
  for (const PointChunk& part : parts) writer.append(part);
  writer.finish();
  return path;
}

/// Whether a remark has that text, and that hint.
bool has(const Warnings& remarks, const std::string& part, Hint hint = Hint::none) {
  return std::any_of(remarks.begin(), remarks.end(), [&](const Warning& remark) {
    return remark.text.find(part) != std::string::npos && remark.hint == hint;
  });
}

TEST(DatasetInventory, CountsStripsDensityAndOverlap) {
  const auto folder = test::scratch("census_overlap");
  // 100 m x 50 m and, over its eastern 40 m, 60 m x 50 m; cells of 5 m fit both exactly.
  const auto a = writeLas(folder / "a.las", {field(0, 0, 100, 50, 1)});
  const auto b = writeLas(folder / "b.las", {field(60, 0, 60, 50, 2, 5000.0)});
  const DatasetInventory survey = takeInventory({a, b}, 5.0);
  ASSERT_EQ(survey.strips.size(), 2U);
  EXPECT_EQ(survey.strips[0].id, "1");
  EXPECT_EQ(survey.strips[0].statistics.points, 20000U);
  EXPECT_EQ(survey.strips[0].area, 5000.0);
  EXPECT_EQ(survey.strips[0].density, 4.0);
  EXPECT_EQ(survey.strips[0].statistics.classes[2], 20000U);
  EXPECT_EQ(survey.strips[0].statistics.single_returns, 20000U);
  EXPECT_EQ(survey.strips[1].area, 3000.0);
  ASSERT_EQ(survey.overlaps.size(), 1U);
  EXPECT_EQ(survey.overlaps[0].area, 2000.0);
  EXPECT_EQ(survey.area_by_strips, (std::vector<double>{4000.0, 2000.0}));
  EXPECT_EQ(survey.duplicates, 0U);
  EXPECT_TRUE(survey.remarks.empty());
  EXPECT_TRUE(survey.files[0].remarks.empty());
}

TEST(DatasetInventory, DensityIsThatOfTheInnerCells) {
  const auto folder = test::scratch("census_density");
  // A field with a dense pile of points and ragged edges: the median does not see them.
  PointChunk pile = field(20, 20, 1, 1, 1, 2000.0);
  std::vector<PointChunk> parts(1, field(1.3, 2.1, 100, 50, 1));
  for (int i = 0; i < 50; ++i) parts.push_back(pile);
  const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", parts)}, 5.0);
  EXPECT_EQ(survey.strips[0].density, 4.0);
}

TEST(DatasetInventory, FindsGapsInTime) {
  const auto folder = test::scratch("census_gaps");
  const auto path = writeLas(folder / "a.las", {field(0, 0, 10, 10, 1, 1000.0),   // to 1003.99
                                                field(10, 0, 10, 10, 1, 1004.9),  // 0.91 s later
                                                field(20, 0, 10, 10, 1, 1010.0)});
  const StripInventory strip = takeInventory({path}).strips[0];
  ASSERT_EQ(strip.gaps.size(), 1U);
  EXPECT_NEAR(strip.gaps[0].from, 1008.89, 1e-9);
  EXPECT_NEAR(strip.gaps[0].to, 1010.0, 1e-9);
  EXPECT_TRUE(has(strip.remarks, "has 1 gap in time"));
}

TEST(DatasetInventory, AGapInWhichAnAircraftMayTurnSeparatesLines) {
  const auto folder = test::scratch("census_lines");
  const auto path =
      writeLas(folder / "a.las", {field(0, 0, 20, 20, 1, 1000.0), field(0, 30, 20, 20, 1, 1100.0)});
  EXPECT_TRUE(has(takeInventory({path}).strips[0].remarks, "the longest of 84 s", Hint::split));
}

TEST(DatasetInventory, StripsOfTheSameTimesAreNamed) {
  const auto folder = test::scratch("census_simultaneous");
  // Ids 1 and 2 share 24 of 32 seconds; 3 follows within a second of 2's end, 4 is flown later.
  const auto path = writeLas(folder / "a.las",
                             {field(0, 0, 40, 20, 1, 1000.0), field(0, 30, 40, 20, 2, 1008.0),
                              field(0, 60, 40, 20, 3, 1040.0), field(0, 90, 40, 20, 4, 2000.0)});
  const DatasetInventory survey = takeInventory({path});
  ASSERT_EQ(survey.strips.size(), 4U);
  EXPECT_EQ(survey.strips[0].recorded_with, std::optional<std::size_t>(1));
  EXPECT_EQ(survey.strips[1].recorded_with, std::optional<std::size_t>(0));
  EXPECT_FALSE(survey.strips[2].recorded_with || survey.strips[3].recorded_with);
  EXPECT_TRUE(
      has(survey.remarks, "2 strips were recorded at the times of others (1 with 2)", Hint::split));
}

TEST(DatasetInventory, NumbersOfPulsesAreNoFlightLines) {
  const auto folder = test::scratch("census_ids");
  PointChunk points = field(0, 0, 60, 60, 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.point_source_id[i] = static_cast<std::uint16_t>(1 + i % 1500);
  const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", {points})});
  EXPECT_TRUE(has(survey.remarks, "there are 1 500 point source ids", Hint::split));
  EXPECT_FALSE(has(survey.remarks, "recorded at the times", Hint::split));
  // A million pairs of them, or a thousand million of what number pulses, tell nothing.
  EXPECT_TRUE(survey.overlaps.empty());
  EXPECT_FALSE(has(survey.remarks, "no two strips overlap"));
}

TEST(DatasetInventory, ChannelsOfTheScannerAreNamed) {
  const auto folder = test::scratch("census_channels");
  PointChunk points = field(0, 0, 20, 20, 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    points.flags[i] = static_cast<std::uint8_t>((i % 2) << 6U);
  const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", {points})});
  EXPECT_EQ(survey.files[0].statistics.channels, (std::array<std::uint64_t, 4>{800, 800, 0, 0}));
  EXPECT_TRUE(
      has(survey.remarks, "1 strip has points of several scanner channels", Hint::channels));
  EXPECT_FALSE(has(takeInventory({writeLas(folder / "b.las", {field(0, 0, 20, 20, 1)})}).remarks,
                   "scanner channels", Hint::channels));
}

TEST(DatasetInventory, JoinsTilesOfAStrip) {
  const auto folder = test::scratch("census_tiles");
  const auto a = writeLas(folder / "a.las", {field(0, 0, 20, 20, 7, 1000.0)});
  const auto b = writeLas(folder / "b.las", {field(20, 0, 20, 20, 7, 1016.0)});
  const DatasetInventory survey = takeInventory({a, b}, 5.0);
  ASSERT_EQ(survey.strips.size(), 1U);
  EXPECT_EQ(survey.strips[0].statistics.points, 3200U);
  EXPECT_EQ(survey.strips[0].area, 800.0);
  EXPECT_EQ(survey.strips[0].statistics.maximum.x(), 39.949);
  EXPECT_EQ(survey.files[1].statistics.points, 1600U);
  EXPECT_TRUE(has(survey.remarks, "one strip only", Hint::split));
}

TEST(DatasetInventory, CountsDuplicates) {
  const auto folder = test::scratch("census_duplicates");
  const auto a = writeLas(folder / "a.las", {field(0, 0, 20, 20, 1)});
  const auto b =
      writeLas(folder / "b.las", {field(0, 0, 20, 5, 1), field(0, 30, 20, 5, 1, 3000.0)});
  const DatasetInventory survey = takeInventory({a, b});
  EXPECT_EQ(survey.duplicates, 400U);
  EXPECT_FALSE(survey.duplicates_estimated);
  EXPECT_TRUE(has(survey.remarks, "400 points repeat"));
}

TEST(DatasetInventory, EstimatesDuplicatesOfManyPoints) {
  const auto folder = test::scratch("census_many");
  const auto a = writeLas(folder / "a.las", {field(0, 0, 800, 500, 1)});  // 1.6 million
  const DatasetInventory survey = takeInventory({a, a});
  EXPECT_TRUE(survey.duplicates_estimated);
  // A sample of at least 262144 points: 1 % is five standard deviations of its size.
  EXPECT_NEAR(static_cast<double>(survey.duplicates), 1.6e6, 1.6e4);
}

TEST(DatasetInventory, CellsGrowWherePointsAreSpreadTooWidely) {
  const auto folder = test::scratch("census_spread");
  PointChunk p = field(0, 0, 250, 200, 1);  // 200000 points
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::size_t row = i / 2000, column = i % 2000;
    p.x[i] = 1000.0 * static_cast<double>(column);
    p.y[i] = 1000.0 * static_cast<double>(row);
  }
  const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", {p})}, 1.0);
  EXPECT_GT(survey.cell, 1.0);
  EXPECT_EQ(survey.strips[0].statistics.points, 200000U);
}

TEST(DatasetInventory, SaysWhatIsSuspiciousAboutTimes) {
  const auto folder = test::scratch("census_times");
  const auto remarksFor = [&](const std::function<void(PointChunk&)>& spoil, TimeKind kind) {
    PointChunk p = field(0, 0, 20, 20, 1);
    spoil(p);
    return takeInventory({writeLas(folder / "a.las", {p}, kind)}).files[0].remarks;
  };
  const auto week = TimeKind::week_seconds, standard = TimeKind::adjusted_standard;
  const auto keep = [](PointChunk&) {};
  const auto zero = [](PointChunk& p) { std::fill(p.gps_time.begin(), p.gps_time.end(), 0.0); };
  EXPECT_TRUE(has(remarksFor(zero, week), "every GPS time is zero"));
  EXPECT_TRUE(has(remarksFor([](PointChunk& p) { p.gps_time[3] = 0.0; }, week),
                  "1 point (0.0625 %) has GPS time zero"));
  EXPECT_TRUE(has(remarksFor([](PointChunk& p) { p.gps_time[3] = NAN; }, week),
                  "GPS time that is no number"));
  EXPECT_TRUE(has(remarksFor(keep, standard), "look like seconds of the GPS week"));
  EXPECT_TRUE(has(remarksFor([](PointChunk& p) { p.gps_time[3] = 3e8; }, week),
                  "look like adjusted standard GPS time"));
  const auto shifted = [](double by) {
    return [by](PointChunk& p) {
      for (double& time : p.gps_time) time += by;
    };
  };
  EXPECT_TRUE(has(remarksFor(shifted(1.39e9), week),
                  "look like GPS seconds (2024-01-22), not like seconds of the GPS week"));
  EXPECT_TRUE(has(remarksFor(shifted(1.39e9), standard), "not like adjusted standard GPS time"));
  EXPECT_TRUE(remarksFor(keep, week).empty());
}

TEST(DatasetInventory, RecognisesUnixTimes) {
  const auto folder = test::scratch("census_unix");
  for (const double units : {1.0, 1e3, 1e9}) {
    PointChunk p = field(0, 0, 20, 20, 1, 1756080000.0);
    for (double& time : p.gps_time) time *= units;
    const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", {p})});
    EXPECT_TRUE(has(survey.files[0].remarks, "look like Unix time")) << units;
    EXPECT_TRUE(has(survey.files[0].remarks, "2025-08-25")) << units;
    EXPECT_EQ(has(survey.files[0].remarks, "nanoseconds"), units == 1e9);
    EXPECT_EQ(survey.files[0].statistics.invalid_times, 0U);
    EXPECT_NEAR(survey.strips[0].statistics.first_time, 1756080000.0, 1e-6);
    EXPECT_NEAR(survey.strips[0].statistics.last_time, 1756080015.99, 1e-3);
    EXPECT_TRUE(survey.strips[0].gaps.empty());
  }
}

TEST(DatasetInventory, LinesGoOnThroughTheEndOfTheWeek) {
  const auto folder = test::scratch("census_rollover");
  PointChunk p = field(0, 0, 20, 20, 1, 604792.0);
  for (double& time : p.gps_time) time = std::fmod(time, 604800.0);
  const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", {p})});
  const PointStatistics& s = survey.strips[0].statistics;
  EXPECT_NEAR(s.first_time, 604792.0, 1e-6);
  EXPECT_NEAR(s.last_time, 604807.99, 1e-6);
  EXPECT_NEAR(survey.files[0].statistics.last_time, 604807.99, 1e-6);
  EXPECT_TRUE(survey.strips[0].gaps.empty());
  EXPECT_EQ(s.unsorted_times, 0U);
  EXPECT_TRUE(has(survey.remarks, "end of a GPS week"));
}

TEST(DatasetInventory, SaysWhatIsSuspiciousAboutPoints) {
  const auto folder = test::scratch("census_points");
  PointChunk p = field(0, 0, 10, 10, 1);
  p.return_number[5] = 3;
  p.flags[6] = kWithheld;
  std::fill(p.intensity.begin(), p.intensity.end(), 0.0F);
  std::swap(p.gps_time[7], p.gps_time[8]);
  const DatasetInventory survey = takeInventory({writeLas(folder / "a.las", {p})});
  EXPECT_TRUE(has(survey.files[0].remarks, "1 point (0.25 %) has return number zero"));
  EXPECT_TRUE(has(survey.files[0].remarks, "flagged as withheld"));
  EXPECT_TRUE(has(survey.files[0].remarks, "every intensity is zero"));
  EXPECT_TRUE(has(survey.strips[0].remarks, "only 400 points"));
  EXPECT_EQ(survey.strips[0].statistics.unsorted_times, 1U);
}

TEST(DatasetInventory, RemarksTimesInWholeSeconds) {
  const auto folder = test::scratch("census_whole_seconds");
  PointChunk rounded = field(0, 0, 50, 20, 1);
  for (double& time : rounded.gps_time) time = std::floor(time);
  const DatasetInventory survey = takeInventory({writeLas(folder / "rounded.las", {rounded})});
  // 4000 points at 100 a second are 40 s.
  EXPECT_TRUE(has(survey.strips[0].remarks, "in whole seconds (40 distinct values in 4000"));
  const DatasetInventory fine =
      takeInventory({writeLas(folder / "fine.las", {field(0, 0, 50, 20, 1)})});
  EXPECT_FALSE(has(fine.strips[0].remarks, "whole seconds"));
}

TEST(DatasetInventory, RemarksLargeScanAngles) {
  const auto folder = test::scratch("census_scan_angles");
  PointChunk points = field(0, 0, 50, 20, 1);
  points.scan_angle[7] = 59.0F;
  const DatasetInventory usual = takeInventory({writeLas(folder / "usual.las", {points})});
  EXPECT_FALSE(has(usual.strips[0].remarks, "scan angles"));
  points.scan_angle[8] = -106.0F;
  const DatasetInventory large = takeInventory({writeLas(folder / "large.las", {points})});
  EXPECT_TRUE(has(large.strips[0].remarks, "scan angles of -106 to 59 degrees"));
}

TEST(DatasetInventory, SaysWhatIsWrongInTheHeader) {
  const auto folder = test::scratch("census_header");
  test::LasBytes las;
  std::string bytes = las.str();
  const double wrong = 1e6;
  std::memcpy(&bytes[179], &wrong, sizeof wrong);  // largest x
  bytes[255] = 99;                                 // points of return 1
  test::writeBytes(folder / "a.las", bytes);
  const auto remarks = takeInventory({folder / "a.las"}).files[0].remarks;
  EXPECT_TRUE(has(remarks, "bounding box is wrong: it says"));
  EXPECT_TRUE(has(remarks, "return 1: it says 99, there are 2"));
  EXPECT_TRUE(has(remarks, "coordinate reference system is unknown", Hint::crs));
  las.count = 0;
  test::writeBytes(folder / "none.las", las.str());
  const DatasetInventory none = takeInventory({folder / "none.las"});
  EXPECT_TRUE(has(none.files[0].remarks, "holds no points"));
  EXPECT_TRUE(none.strips.empty());
}

TEST(DatasetInventory, RefusesACellThatIsNoSize) {
  EXPECT_THROW(takeInventory({}, -1.0), UsageError);
  EXPECT_THROW(takeInventory({}, NAN), UsageError);
}

TEST(DatasetInventory, KnowsTheRealTiles) {
  const auto one = test::unpacked("delft_ahn3/ahn3_cropped_1.las.xz");
  const auto two = test::unpacked("delft_ahn3/ahn3_cropped_2.las.xz");
  PCL_ALS_REQUIRE_DATA(one);
  PCL_ALS_REQUIRE_DATA(two);
  const DatasetInventory survey = takeInventory({*one, *two});
  ASSERT_EQ(survey.strips.size(), 4U);
  EXPECT_EQ(survey.strips[2].id, "57139");
  EXPECT_EQ(survey.strips[2].statistics.points, 593468U);
  // What comes with the data, rounded there: times to 0.1 s, scan angles to a degree.
  EXPECT_NEAR(survey.strips[2].statistics.first_time, 230038.2, 0.06);
  EXPECT_NEAR(survey.strips[2].statistics.last_time, 230042.5, 0.06);
  EXPECT_EQ(survey.strips[2].statistics.least_scan_angle, -15.0F);
  EXPECT_EQ(survey.strips[2].statistics.largest_scan_angle, 16.0F);
  // 18000 m2 seen by two strips or more, 4900 by three; cells at the edges count whole.
  EXPECT_NEAR(survey.area_by_strips[1] + survey.area_by_strips[2], 18000.0, 900.0);
  EXPECT_NEAR(survey.area_by_strips[2], 4900.0, 250.0);
  EXPECT_TRUE(has(survey.strips[3].remarks, "only 50 points"));
}

}  // namespace
}  // namespace pcl_als
