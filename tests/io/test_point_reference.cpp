// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/las/las_writer.h>

#include "test_files.h"

// Built with PROJ only: without it no CRS states a unit.
namespace pcl_als {
namespace {

PointFileInfo fileIn(const std::string& name, const std::string& crs) {
  PointFileInfo info;
  info.path = "block/" + name;
  info.crs = crs;
  info.crs_kind = describeCrs(crs).kind;
  info.units = unitsOfCrs(crs);
  return info;
}

std::string refusalOfReferences(const std::vector<PointFileInfo>& files) {
  return test::messageOf<InputError>([&] { commonReference(files); });
}

TEST(PointReference, SaysNothingOfMetres) {
  const PointReference common =
      commonReference({fileIn("a.las", "EPSG:25832"), fileIn("b.las", "EPSG:25832")});
  EXPECT_EQ(common.crs, "EPSG:25832");
  EXPECT_TRUE(common.remarks.empty());
}

TEST(PointReference, SaysOnceWhatIsConvertedOrAssumed) {
  const PointReference feet = commonReference(
      {fileIn("a.las", "EPSG:2227"), fileIn("b.las", "EPSG:2227"), fileIn("c.las", "EPSG:2227")});
  ASSERT_EQ(feet.remarks.size(), 1U);
  EXPECT_EQ(feet.remarks[0],
            "a.las and 2 more: coordinates in US survey foot (EPSG:2227), heights as well (not "
            "stated, assumed) are brought to metres; point files are written in their own units");
  const PointReference unknown = commonReference({fileIn("a.las", ""), fileIn("b.las", "")});
  ASSERT_EQ(unknown.remarks.size(), 1U);
  EXPECT_EQ(unknown.remarks[0],
            "a.las and 1 more: no CRS and no unit of length are stated; coordinates are taken as "
            "metres");
  EXPECT_NE(commonReference({fileIn("a.las", "EPSG:999999")}).remarks[0].find("EPSG:999999"),
            std::string::npos);
}

TEST(PointReference, NamesFilesWithTheSamePoints) {
  std::vector<PointFileInfo> files{fileIn("a.las", "EPSG:25832"), fileIn("b.las", "EPSG:25832"),
                                   fileIn("c.las", "EPSG:25832")};
  for (PointFileInfo& file : files) {
    file.point_count = 12345;
    file.maximum = {100.0, 200.0, 30.0};
  }
  files[1].maximum.z() = 30.001;
  const PointReference common = commonReference(files);
  ASSERT_EQ(common.remarks.size(), 1U);
  EXPECT_EQ(common.remarks[0],
            "block/c.las and block/a.las hold the same points by their headers (12 345 in the same "
            "box): give one of them, so that none counts twice");
}

TEST(PointReference, OneZoneInFeetAndInMetresBelongsTogether) {
  const PointReference common =
      commonReference({fileIn("a.las", "EPSG:2271"), fileIn("b.las", "EPSG:32128")});
  EXPECT_EQ(common.crs, "EPSG:2271");
  EXPECT_EQ(common.remarks.size(), 1U);
}

TEST(PointReference, RefusesWhatDoesNotBelongTogether) {
  EXPECT_EQ(refusalOfReferences({fileIn("a.las", "EPSG:25832"), fileIn("b.las", "EPSG:25833")}),
            "block/b.las: is in EPSG:25833 but block/a.las in EPSG:25832; reproject one of them");
  EXPECT_NE(refusalOfReferences({fileIn("a.las", "EPSG:4326")}).find("degrees"), std::string::npos);
  EXPECT_EQ(refusalOfReferences({fileIn("a.las", "EPSG:2227"), fileIn("b.las", "")}),
            "block/b.las: states no unit of length, but block/a.las is in US survey foot; give "
            "both files their CRS");
  EXPECT_EQ(refusalOfReferences({fileIn("a.las", "EPSG:25832"), fileIn("b.las", "")}), "no error");
}

/// Without a code the coordinates tell: EPSG:25832 as WKT without one, and its neighbour.
TEST(PointReference, ComparesDescriptionsWithoutACode) {
  const auto zone = [](const std::string& name, const std::string& meridian) {
    PointFileInfo info = fileIn(name, "+proj=tmerc +lon_0=" + meridian +
                                          " +k=0.9996 +x_0=500000 +ellps=GRS80 +units=m +type=crs");
    info.minimum << 600000.0, 5700000.0, 0.0;
    info.maximum << 601000.0, 5701000.0, 100.0;
    return info;
  };
  EXPECT_EQ(refusalOfReferences({fileIn("a.las", "EPSG:25832"), zone("b.las", "9")}), "no error");
  EXPECT_EQ(refusalOfReferences({zone("a.las", "9"), zone("b.las", "9")}), "no error");
  const std::string other =
      refusalOfReferences({fileIn("a.las", "EPSG:25832"), zone("b.las", "15")});
  EXPECT_NE(other.find("block/b.las: is in "), std::string::npos) << other;
  EXPECT_NE(other.find("but block/a.las in EPSG:25832; reproject one of them"), std::string::npos);
  EXPECT_NE(refusalOfReferences({zone("a.las", "9"), zone("b.las", "15")}), "no error");
}

/// A file of two points in that CRS.
std::filesystem::path writeTwoPoints(const std::filesystem::path& path, const std::string& crs) {
  LasWriterOptions options;
  options.crs = crs;
  options.offset = Eigen::Vector3d(600000.0, 100000.0, 0.0) / unitsOfCrs(crs).horizontal.metres;
  options.scale.setConstant(1e-4);
  LasWriter writer(path, options);
  PointChunk points;
  points.resize(2);
  points.x = {600010.0, 600020.0};
  points.y = {100010.0, 100020.0};
  points.z = {300.0, 310.0};
  for (auto* numbers : {&points.return_number, &points.number_of_returns}) *numbers = {1, 1};
  points.point_source_id = {1, 1};
  writer.append(points);
  writer.finish();
  return path;
}

TEST(PointReference, StripsOfBothUnitsLieOnEachOther) {
  const auto folder = test::scratch("point_reference");
  const auto strips = loadStrips({writeTwoPoints(folder / "feet.las", "EPSG:2271"),
                                  writeTwoPoints(folder / "metres.las", "EPSG:32128")});
  ASSERT_EQ(strips.size(), 2U);
  for (const auto& strip : strips) {
    const Eigen::Vector3d first = strip.frame.toGround((*strip.cloud)[0].getVector3fMap());
    // 2e-4 m: half a step of the file, and that of a float 10 m from its origin.
    EXPECT_NEAR(first.x(), 600010.0, 2e-4);
    EXPECT_NEAR(first.y(), 100010.0, 2e-4);
    EXPECT_NEAR(first.z(), 300.0, 2e-4);
  }
}

}  // namespace
}  // namespace pcl_als
