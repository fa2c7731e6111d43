// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>
#include <pcl_als/io/point_reader.h>
#include <pcl_als/io/point_reference.h>
#include <pcl_als/las/las_file.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::Bytes;
using test::LasBytes;

constexpr double kSurveyFoot = 12.0 / 39.37;

struct Key {
  unsigned id, place, value;
};

/// A file of LAS 1.2 with GeoTIFF keys; keys of \a doubles have place 34736 and their index.
LasBytes withKeys(const std::vector<Key>& keys, const std::vector<double>& doubles = {}) {
  LasBytes las;
  las.minor = 2;
  las.format = 1;
  las.encoding = 0;
  Bytes directory, numbers;
  directory.u16(1).u16(1).u16(0).u16(static_cast<unsigned>(keys.size()));
  for (const Key& key : keys) directory.u16(key.id).u16(key.place).u16(1).u16(key.value);
  for (const double number : doubles) numbers.f64(number);
  las.vlrs = {LasBytes::vlr("LASF_Projection", 34735, directory.str()),
              LasBytes::vlr("LASF_Projection", 34736, numbers.str())};
  return las;
}

std::filesystem::path writeStrip(const LasBytes& las) {
  const auto path = test::scratch("las_units") / "strip.las";
  test::writeBytes(path, las.str());
  return path;
}

PointFileInfo infoOf(const LasBytes& las) {
  return LasFile(writeStrip(las)).info();
}

TEST(LasUnits, KeysStateHorizontalAndVerticalUnit) {
  const struct {
    const char* what;
    std::vector<Key> keys;
    std::vector<double> doubles;
    double horizontal, vertical;
    bool known, vertical_known;
  } cases[] = {
      {"nothing", {}, {}, 1.0, 1.0, false, false},
      {"US survey feet",
       {{1024, 0, 1}, {3072, 0, 32767}, {3076, 0, 9003}, {4099, 0, 9003}},
       {},
       kSurveyFoot,
       kSurveyFoot,
       true,
       true},
      {"feet, no vertical unit", {{1024, 0, 1}, {3076, 0, 9002}}, {}, 0.3048, 0.3048, true, false},
      {"metres, heights in feet",
       {{1024, 0, 1}, {3076, 0, 9001}, {4099, 0, 9002}},
       {},
       1.0,
       0.3048,
       true,
       true},
      {"user-defined length",
       {{1024, 0, 1}, {3076, 0, 32767}, {3077, 34736, 1}},
       {9.0, 0.3048006},
       kSurveyFoot,
       kSurveyFoot,
       true,
       false},
      {"user-defined length that is not there",
       {{1024, 0, 1}, {3076, 0, 32767}},
       {},
       1.0,
       1.0,
       false,
       false},
      {"user-defined length of no length",
       {{3076, 0, 32767}, {3077, 34736, 0}},
       {-2.0},
       1.0,
       1.0,
       false,
       false},
      {"geodetic unit, where there is no other",
       {{1024, 0, 1}, {2052, 0, 9003}},
       {},
       kSurveyFoot,
       kSurveyFoot,
       true,
       false},
      {"a unit of angles", {{1024, 0, 1}, {3076, 0, 9102}}, {}, 1.0, 1.0, false, false},
  };
  for (const auto& row : cases) {
    const LinearUnits units = infoOf(withKeys(row.keys, row.doubles)).units;
    EXPECT_DOUBLE_EQ(units.horizontal.metres, row.horizontal) << row.what;
    EXPECT_DOUBLE_EQ(units.vertical.metres, row.vertical) << row.what;
    EXPECT_EQ(units.known(), row.known) << row.what;
    EXPECT_EQ(units.verticalKnown(), row.vertical_known) << row.what;
  }
}

TEST(LasUnits, PointsAndExtentAreDeliveredInMetres) {
  LasBytes las = withKeys({{1024, 0, 1}, {3076, 0, 9002}, {4099, 0, 9003}});
  const auto path = writeStrip(las);
  const auto reader = PointReader::open(path);
  PointChunk chunk;
  ASSERT_TRUE(reader->read(chunk));
  const LasScaling scaling = LasFile(path).toMetres();
  for (unsigned i = 0; i < las.count; ++i) {
    // 1e-9: rounding of coordinates of 5e6 in another order of the products.
    EXPECT_NEAR(chunk.x[i], (LasBytes::X(i) * las.scale + las.offset_x) * 0.3048, 1e-9);
    EXPECT_NEAR(chunk.y[i], (LasBytes::Y(i) * las.scale + las.offset_y) * 0.3048, 2e-9);
    EXPECT_NEAR(chunk.z[i], (LasBytes::Z(i) * las.scale + las.offset_z) * kSurveyFoot, 1e-9);
    EXPECT_EQ(LasBytes::X(i) * scaling.scale.x() + scaling.offset.x(), chunk.x[i]);
  }
  const PointFileInfo& info = reader->info();
  EXPECT_DOUBLE_EQ(info.resolution.x(), 0.001 * 0.3048);
  EXPECT_DOUBLE_EQ(info.resolution.z(), 0.001 * kSurveyFoot);
  const LasHeader header = LasFile(path).header();
  EXPECT_EQ(header.scale.x(), 0.001);  // the header itself is as stored
  EXPECT_DOUBLE_EQ(info.minimum.x(), header.minimum.x() * 0.3048);
  EXPECT_DOUBLE_EQ(info.maximum.z(), header.maximum.z() * kSurveyFoot);
}

TEST(LasUnits, DescribesWhatIsKnown) {
  EXPECT_EQ(describeUnits(infoOf(withKeys({}))), "not stated, taken as metre");
  EXPECT_EQ(describeUnits(infoOf(withKeys({{3076, 0, 9003}}))),
            "US survey foot (GeoTIFF key 3076), heights as well (not stated, assumed)");
  EXPECT_EQ(describeUnits(infoOf(withKeys({{3076, 0, 9001}, {4099, 0, 9002}}))),
            "metre (GeoTIFF key 3076), heights in foot (GeoTIFF key 4099)");
}

#ifdef PCL_ALS_HAVE_PROJ

TEST(LasUnits, ACodeImpliesItsUnit) {
  const PointFileInfo info = infoOf(withKeys({{1024, 0, 1}, {3072, 0, 2227}, {4096, 0, 8228}}));
  EXPECT_EQ(info.crs, "EPSG:2227");
  EXPECT_EQ(info.crs_kind, CrsKind::projected);
  EXPECT_DOUBLE_EQ(info.units.horizontal.metres, kSurveyFoot);
  EXPECT_EQ(info.units.source, "EPSG:2227");
  EXPECT_EQ(info.units.vertical.metres, 0.3048);  // NAVD88 height (ft)
  EXPECT_EQ(info.units.vertical_source, "GeoTIFF key 4096 (EPSG:8228)");
  EXPECT_FALSE(infoOf(withKeys({{3072, 0, 2227}, {4096, 0, 5103}})).units.verticalKnown());
}

TEST(LasUnits, OtherUnitsOfTheEpsgDatasetAreLookedUp) {
  // 9005: Clarke's foot. PROJ's database gives 0.3047972654 m.
  const LinearUnits units = infoOf(withKeys({{1024, 0, 1}, {3076, 0, 9005}})).units;
  EXPECT_EQ(units.horizontal.name, "Clarke's foot");
  EXPECT_DOUBLE_EQ(units.horizontal.metres, 0.3047972654);
}

// As deliveries have it: the code of the zone in metres, and a key that says feet.
TEST(LasUnits, AStatedUnitStandsAboveThatOfTheCode) {
  const PointFileInfo info = infoOf(withKeys({{1024, 0, 1}, {3072, 0, 32128}, {3076, 0, 9003}}));
  EXPECT_DOUBLE_EQ(info.units.horizontal.metres, kSurveyFoot);
  EXPECT_NE(info.units.source.find("EPSG:32128 by itself counts in metre"), std::string::npos);
  EXPECT_DOUBLE_EQ(describeCrs(info.crs).horizontal->metres, kSurveyFoot);
  EXPECT_TRUE(sameGroundFrame(info.crs, "EPSG:2271"));
}

TEST(LasUnits, AUnitWithoutACrsIsALocalSystem) {
  const PointFileInfo info = infoOf(withKeys({{1024, 0, 1}, {3072, 0, 32767}, {3076, 0, 9002}}));
  EXPECT_EQ(describeCrs(info.crs).kind, CrsKind::local);
  EXPECT_EQ(describeCrs(info.crs).horizontal->metres, 0.3048);
  EXPECT_EQ(infoOf(withKeys({{1024, 0, 1}, {3076, 0, 9001}})).crs, "");
}

TEST(LasUnits, WktStatesThem) {
  LasBytes las;
  las.encoding = 17;
  const std::string wkt =
      "COMPD_CS[\"a\",PROJCS[\"b\",GEOGCS[\"NAD83\",DATUM[\"North_American_Datum_1983\",SPHEROID["
      "\"GRS 1980\",6378137,298.257222101]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\","
      "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\","
      "31],PARAMETER[\"central_meridian\",-110.166666666667],PARAMETER[\"scale_factor\",0.9999],"
      "PARAMETER[\"false_easting\",700000],PARAMETER[\"false_northing\",0],UNIT[\"foot\",0.3048]],"
      "VERT_CS[\"NAVD88 height (ftUS)\",VERT_DATUM[\"North American Vertical Datum 1988\",2005],"
      "UNIT[\"US survey foot\",0.304800609601219],AXIS[\"Up\",UP]]]";
  las.vlrs = {LasBytes::vlr("LASF_Projection", 2112, wkt + '\0')};
  const PointFileInfo info = infoOf(las);
  EXPECT_EQ(info.units.horizontal.metres, 0.3048);
  EXPECT_DOUBLE_EQ(info.units.vertical.metres, kSurveyFoot);
  EXPECT_EQ(info.units.source, "WKT");
}

TEST(LasUnits, KeysTellWhatAWktDoesNot) {
  LasBytes las = withKeys({{1024, 0, 1}, {3072, 0, 2222}, {4099, 0, 9002}});
  las.minor = 4;
  las.format = 6;
  las.encoding = 17;
  las.vlrs.push_back(LasBytes::vlr("LASF_Projection", 2112, std::string("PROJCS[x]\0", 10)));
  const PointFileInfo info = infoOf(las);
  EXPECT_EQ(info.crs, "PROJCS[x]");
  EXPECT_EQ(info.units.horizontal.metres, 0.3048);
  EXPECT_EQ(info.units.vertical.metres, 0.3048);
}

/// Longitude and latitude in steps of 1e-7 degrees, heights in millimetres.
LasBytes inDegrees(const std::vector<Key>& keys) {
  LasBytes las = withKeys(keys);
  las.scale = 1e-7;
  las.offset_x = 8.0;
  las.offset_y = 50.0;
  las.offset_z = 100.0;
  return las;
}

TEST(LasUnits, RefusesDegreesWithTheRemedy) {
  const auto path = writeStrip(inDegrees({{1024, 0, 2}, {2048, 0, 4326}}));
  EXPECT_EQ(LasFile(path).crsKind(), CrsKind::geographic);
  const auto refusal = [&](const std::function<void()>& action) {
    return test::messageOf<InputError>(action);
  };
  for (const std::string& message :
       {refusal([&] { PointReader::open(path); }), refusal([&] { LasFile(path).toMetres(); })}) {
    EXPECT_NE(message.find("strip.las: its coordinates are degrees (EPSG:4326)"), std::string::npos)
        << message;
    EXPECT_NE(message.find("reproject it to a map projection"), std::string::npos);
  }
  const auto reader = PointReader::open(path, PointReader::OtherCoordinates::as_stored);
  PointChunk chunk;
  ASSERT_TRUE(reader->read(chunk));
  EXPECT_NEAR(chunk.x[0], 8.0 + 1e-7 * LasBytes::X(0), 1e-12);
}

TEST(LasUnits, RefusesGeocentricCoordinates) {
  LasBytes las = withKeys({{1024, 0, 3}, {2048, 0, 4326}});
  las.offset_x = 3924687.0, las.offset_y = 301132.0, las.offset_z = 5001910.0;  // Delft
  const auto path = writeStrip(las);
  EXPECT_NE(test::messageOf<InputError>([&] { PointReader::open(path); }).find("geocentric"),
            std::string::npos);
}

TEST(LasUnits, ACrsInDegreesIsNotBelievedOfLargeCoordinates) {
  const PointFileInfo info = infoOf(withKeys({{1024, 0, 2}, {2048, 0, 4326}}));
  EXPECT_EQ(info.crs_kind, CrsKind::unknown);
  EXPECT_EQ(info.crs, "");
  EXPECT_FALSE(info.units.known());
}

#endif

TEST(LasUnits, DegreesShowInTheSteps) {
  LasBytes las;
  las.offset_x = 8.0;
  las.offset_y = 50.0;
  std::string bytes = las.str();
  const double fine = 1e-7, low = -1.0, high = 1.0;
  for (const std::size_t at : {131U, 139U}) std::memcpy(&bytes[at], &fine, sizeof fine);
  for (const std::size_t at : {179U, 195U}) std::memcpy(&bytes[at], &high, sizeof high);
  for (const std::size_t at : {187U, 203U}) std::memcpy(&bytes[at], &low, sizeof low);
  const auto path = test::scratch("las_units") / "steps.las";
  test::writeBytes(path, bytes);
  EXPECT_EQ(LasFile(path).crsKind(), CrsKind::geographic);
  EXPECT_NE(test::messageOf<InputError>([&] {
              PointReader::open(path);
            }).find("degrees by their range and steps"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als
