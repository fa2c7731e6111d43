// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <functional>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/class_io.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

fs::path fileOf(const std::string& name, const std::string& text) {
  const fs::path folder = fs::path(PCL_ALS_TEST_SCRATCH) / "class_io";
  fs::create_directories(folder);
  test::writeBytes(folder / name, text);
  return folder / name;
}

TEST(ClassSites, OfCsv) {
  const auto sites =
      readClassSites(fileOf("a.csv", "class;x;y\ntree;512000.5;5403000\nsoil;1;2\n"));
  ASSERT_EQ(sites.size(), 2U);
  EXPECT_EQ(sites[0].name, "tree");
  EXPECT_EQ(sites[0].place, Eigen::Vector2d(512000.5, 5403000));
  EXPECT_FALSE(sites[0].isArea());
  EXPECT_NE(test::messageOf<InputError>([] {
              readClassSites(fileOf("b.csv", "x,y,class\n1,2,\n"));
            }).find("line 2"),
            std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([] {
              readClassSites(fileOf("c.csv", "x,y\n1,2\n"));
            }).find("column 'class'"),
            std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([] {
              readClassSites(fileOf("d.csv", "x,y,class\n"));
            }).find("no sites"),
            std::string::npos);
}

std::string feature(const std::string& geometry, const std::string& label = R"("grass")") {
  return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"class":)" +
         label + R"(},"geometry":)" + geometry + "}]}";
}

TEST(ClassSites, OfGeoJson) {
  const std::string ring = "[[500,0],[510,0],[510,10],[500,0]]";
  const auto area = readClassSites(
      fileOf("a.geojson", feature(R"({"type":"Polygon","coordinates":[)" + ring + "]}")));
  ASSERT_EQ(area.size(), 1U);
  EXPECT_TRUE(area[0].isArea());
  EXPECT_EQ(area[0].rings[0].size(), 4U);
  const auto areas = readClassSites(fileOf(
      "b.geojson",
      feature(R"({"type":"MultiPolygon","coordinates":[[)" + ring + "],[" + ring + "]]}", "7")));
  ASSERT_EQ(areas.size(), 2U);
  EXPECT_EQ(areas[1].name, "7");
  EXPECT_EQ(readClassSites(fileOf("c.geojson", feature(R"({"type":"MultiPoint","coordinates":[[
            500,1],[2,3]]})")))
                .size(),
            2U);
}

TEST(ClassSites, BadGeoJsonIsNamed) {
  const auto refused = [](const std::string& text) {
    return test::messageOf<InputError>([&] { readClassSites(fileOf("bad.geojson", text)); });
  };
  EXPECT_NE(refused("{").find("no GeoJSON"), std::string::npos);
  EXPECT_NE(refused(R"({"features":[{"geometry":null}]})").find("feature 1"), std::string::npos);
  EXPECT_NE(refused(feature(R"({"type":"Point","coordinates":[8.5,48.1]})")).find("degrees"),
            std::string::npos);
  EXPECT_NE(refused(feature(R"({"type":"LineString","coordinates":[[500,1],[2,3]]})")).find("Line"),
            std::string::npos);
  EXPECT_NE(
      refused(feature(R"({"type":"Polygon","coordinates":[[[500,1],[2,3]]]})")).find("closed"),
      std::string::npos);
  EXPECT_NE(refused(feature(R"({"type":"Point","coordinates":["a",3]})")).find("numbers"),
            std::string::npos);
}

TEST(ClassNames, AreWhatTheFilesCanKeep) {
  for (const char* good :
       {"tree", "built-up", "B\xC3\xA4ume", "\xE2\x82\xAC \xF0\x9F\x8C\xB3", "7", "#x"})
    EXPECT_EQ(classNameFault(good), "") << good;
  const std::pair<std::string, const char*> bad[] = {
      {"", "must name"},
      {"a,b", "comma"},
      {"a;b", "semicolon"},
      {"a\"b", "quote"},
      {"a\nb", "control"},
      {"a\x7F", "control"},
      {std::string("a\0b", 3), "control"},
      {"B\xE4ume", "UTF-8"},          // Latin-1
      {"\xC3", "UTF-8"},              // cut short
      {"\xC0\xAF", "UTF-8"},          // overlong
      {"\xED\xA0\x80", "UTF-8"},      // a surrogate
      {"\xF4\x90\x80\x80", "UTF-8"},  // beyond U+10FFFF
      {std::string(101, 'x'), "shorter"}};
  for (const auto& [name, part] : bad)
    EXPECT_NE(classNameFault(name).find(part), std::string::npos) << name;
}

TEST(ClassNames, FaultsAreToldWithTheirPlace) {
  EXPECT_NE(test::messageOf<InputError>([] {
              readClassSites(fileOf("latin1.csv", "x,y,class\n1,2,tree\n3,4,B\xE4ume\n"));
            }).find("line 3, column 'class': 'B?ume' is not UTF-8"),
            std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([] {
              readClassSites(
                  fileOf("comma.geojson",
                         feature(R"({"type":"Point","coordinates":[500,1]})", R"("roof, flat")")));
            }).find("feature 1: its class name has a comma"),
            std::string::npos);
  EXPECT_NE(test::messageOf<InputError>([] {
              readClassSites(fileOf("list.geojson",
                                    feature(R"({"type":"Point","coordinates":[500,1]})", "[1]")));
            }).find("neither text nor number"),
            std::string::npos);
  EXPECT_EQ(
      readClassSites(fileOf("blanks.geojson",
                            feature(R"({"type":"Point","coordinates":[500,1]})", R"(" tree ")")))[0]
          .name,
      "tree");
}

TEST(CountTable, ReadsRowsInAnyOrder) {
  const CountTable table = readCountTable(fileOf("m.csv", "is,Tree,Soil\nSoil,3,4\nTree,1,2\n"));
  EXPECT_EQ(table.classes, (std::vector<std::string>{"Tree", "Soil"}));
  EXPECT_EQ(table.counts[0], (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(table.counts[1], (std::vector<std::int64_t>{3, 4}));
  for (const char* bad :
       {"is,a,b\na,1,2\n", "is,a,b\na,1,2\na,3,4\n", "is,a,b\na,1,2\nc,3,4\n",
        "is,a,b\na,1,x\nb,3,4\n", "is,a,b\na,1,-2\nb,3,4\n", "is,a\na,1\n",
        "is,a,b\na,1,1.5\nb,3,4\n", "is,a,b\na,1,1000000000001\nb,3,4\n", "is,a,\na,1,2\nb,3,4\n"})
    EXPECT_NE(test::messageOf<InputError>([&] { readCountTable(fileOf("bad.csv", bad)); }),
              "no error")
        << bad;
}

TEST(CheckedSites, ComeBackAsTheyWere) {
  const fs::path path = fileOf("checked.csv", "");
  writeCheckedSites(path, {{{512000.125, 5403000.5}, "tree", "soil"}, {{1, 2}, "soil", ""}});
  EXPECT_TRUE(holdsCheckedSites(path));
  EXPECT_FALSE(holdsCheckedSites(fileOf("m2.csv", "is,a,b\na,1,2\nb,3,4\n")));
  const auto sites = readCheckedSites(path);
  ASSERT_EQ(sites.size(), 2U);
  EXPECT_EQ(sites[0].place, Eigen::Vector2d(512000.125, 5403000.5));
  EXPECT_EQ(sites[0].classified, "soil");
  EXPECT_EQ(sites[1].classified, "");
}

TEST(CountTable, OfNumberedClassesHasAHeader) {
  EXPECT_EQ(readCountTable(fileOf("n.csv", ",1,2\n1,5,6\n2,7,8\n")).classes,
            (std::vector<std::string>{"1", "2"}));
  EXPECT_EQ(readCountTable(fileOf("n.csv", "class,1,2\n1,5,6\n2,7,8\n")).classes.size(), 2U);
  EXPECT_NE(test::messageOf<InputError>([&] {
              readCountTable(fileOf("n.csv", "5,6\n7,8\n"));
            }).find("line 1 holds 2 numbers, but the file has no header line"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als
