// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>

#include "test_files.h"

// Built with PROJ only: without it no CRS is known.
namespace pcl_als {
namespace {

constexpr double kSurveyFoot = 12.0 / 39.37;

TEST(Crs, TellsTheKindAndTheUnitsOfCodes) {
  const struct {
    const char* crs;
    CrsKind kind;
    double horizontal, vertical;  ///< metres; 0: none
  } cases[] = {
      {"EPSG:25832", CrsKind::projected, 1.0, 0.0},
      {"EPSG:2227", CrsKind::projected, kSurveyFoot, 0.0},  // California zone 3 (ftUS)
      {"EPSG:2222", CrsKind::projected, 0.3048, 0.0},       // Arizona East (ft)
      {"EPSG:2227+6360", CrsKind::projected, kSurveyFoot, kSurveyFoot},
      {"EPSG:2227+5703", CrsKind::projected, kSurveyFoot, 1.0},  // heights in metres
      {"EPSG:32610+8228", CrsKind::projected, 1.0, 0.3048},      // heights in feet
      {"EPSG:6360", CrsKind::unknown, 0.0, kSurveyFoot},         // heights only
      {"EPSG:4326", CrsKind::geographic, 0.0, 0.0},
      {"EPSG:4978", CrsKind::geocentric, 0.0, 0.0},
      {"EPSG:999999", CrsKind::unknown, 0.0, 0.0},
      {"nonsense", CrsKind::unknown, 0.0, 0.0},
      {"", CrsKind::unknown, 0.0, 0.0},
  };
  for (const auto& row : cases) {
    const CrsDescription found = describeCrs(row.crs);
    EXPECT_EQ(found.kind, row.kind) << row.crs;
    EXPECT_DOUBLE_EQ(found.horizontal ? found.horizontal->metres : 0.0, row.horizontal) << row.crs;
    EXPECT_DOUBLE_EQ(found.vertical ? found.vertical->metres : 0.0, row.vertical) << row.crs;
  }
  EXPECT_EQ(describeCrs("EPSG:2227").name, "NAD83 / California zone 3 (ftUS)");
}

/// WKT 1 as ESRI's and other programs write it, with a unit of its own.
std::string esriWkt(const std::string& unit) {
  return "PROJCS[\"Local_Mercator\",GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID["
         "\"WGS_1984\",6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\","
         "0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"False_Easting\","
         "500000.0],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",-117.0],"
         "PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0]," +
         unit + "]";
}

TEST(Crs, ReadsTheUnitsOfWkt) {
  EXPECT_EQ(unitsOfCrs(esriWkt("UNIT[\"Foot_US\",0.3048006096012192]")).horizontal.name,
            "US survey foot");
  EXPECT_EQ(unitsOfCrs(esriWkt("UNIT[\"Foot\",0.3048]")).horizontal.name, "foot");
  EXPECT_TRUE(unitsOfCrs(esriWkt("UNIT[\"Meter\",1.0]")).metric());
  const std::string compound =
      "COMPD_CS[\"both\"," + esriWkt("UNIT[\"Meter\",1.0]") +
      ",VERT_CS[\"NAVD88 (ft)\",VERT_DATUM[\"North American Vertical Datum 1988\",2005],UNIT["
      "\"foot\",0.3048],AXIS[\"Up\",UP]]]";
  const LinearUnits units = unitsOfCrs(compound);
  EXPECT_TRUE(units.horizontal.isMetre());
  EXPECT_EQ(units.vertical.metres, 0.3048);
  EXPECT_TRUE(units.verticalKnown());
}

TEST(Crs, HeightsTakeTheHorizontalUnitWhereNoneIsStated) {
  const LinearUnits units = unitsOfCrs("EPSG:2227");
  EXPECT_EQ(units.vertical.name, "US survey foot");
  EXPECT_FALSE(units.verticalKnown());
  EXPECT_TRUE(unitsOfCrs("nonsense").metric());
  EXPECT_FALSE(unitsOfCrs("nonsense").known());
}

TEST(Crs, ChangesTheUnitOfACrs) {
  const LengthUnit foot = lengthUnitOf(kSurveyFoot);
  const std::string wkt = crsInUnit("EPSG:32128", foot);
  EXPECT_DOUBLE_EQ(describeCrs(wkt).horizontal->metres, kSurveyFoot);
  EXPECT_TRUE(sameGroundFrame(wkt, "EPSG:2271"));  // the same zone, defined in feet
  EXPECT_EQ(crsInUnit("nonsense", foot), "");
  EXPECT_EQ(describeCrs(localCrs(foot)).kind, CrsKind::local);
  EXPECT_DOUBLE_EQ(describeCrs(localCrs(foot)).horizontal->metres, kSurveyFoot);
}

TEST(Crs, SystemsAreTheSameInMetresOrTheyAreNot) {
  EXPECT_TRUE(sameGroundFrame("EPSG:2271", "EPSG:32128"));
  EXPECT_TRUE(sameGroundFrame("EPSG:2227", "EPSG:26943"));
  EXPECT_TRUE(sameGroundFrame("EPSG:2227+6360", "EPSG:2227"));  // heights are not compared
  EXPECT_FALSE(sameGroundFrame("EPSG:2271", "EPSG:2272"));      // the next zone
  EXPECT_FALSE(sameGroundFrame("EPSG:32632", "EPSG:25832"));    // another datum
  EXPECT_FALSE(sameGroundFrame("EPSG:25832", "nonsense"));
}

/// WKT 1 of a zone of UTM on the ellipsoid GRS 1980, without any code.
std::string utmWkt(const std::string& datum, int meridian, const std::string& more = "") {
  return "PROJCS[\"a zone\",GEOGCS[\"its base\",DATUM[\"" + datum +
         "\",SPHEROID[\"GRS 1980\",6378137,298.257222101]" + more +
         "],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION["
         "\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],PARAMETER["
         "\"central_meridian\"," +
         std::to_string(meridian) +
         "],PARAMETER[\"scale_factor\",0.9996],PARAMETER[\"false_easting\",500000],PARAMETER["
         "\"false_northing\",0],UNIT[\"metre\",1]]";
}

/// Descriptions of one system, of which PROJ does not call all equivalent, and of others.
TEST(Crs, CoordinatesTellSystemsApart) {
  const Eigen::Vector2d place(600000.0, 5700000.0);
  for (const char* datum : {"European_Terrestrial_Reference_System_1989", "D_ETRS_1989", "unknown"})
    EXPECT_FALSE(coordinatesDiffer("EPSG:25832", utmWkt(datum, 9), place)) << datum;
  EXPECT_FALSE(
      coordinatesDiffer("EPSG:25832", utmWkt("unknown", 9, ",TOWGS84[0,0,0,0,0,0,0]"), place));
  EXPECT_TRUE(coordinatesDiffer("EPSG:25832", utmWkt("unknown", 15), place));
  EXPECT_TRUE(coordinatesDiffer(utmWkt("unknown", 3), utmWkt("unknown", 9), place));
  // The axes of EPSG:31467 are north and east; files mostly describe it by its parameters.
  const std::string gauss =
      "+proj=tmerc +lat_0=0 +lon_0=9 +k=1 +x_0=3500000 +y_0=0 +ellps=bessel "
      "+towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7 +units=m +type=crs";
  EXPECT_FALSE(coordinatesDiffer("EPSG:31467", gauss, {3500000.0, 5700000.0}));
  EXPECT_TRUE(coordinatesDiffer("EPSG:31467", "EPSG:25832", {3500000.0, 5700000.0}));
  EXPECT_FALSE(coordinatesDiffer("EPSG:25832", "nonsense", place));
  EXPECT_FALSE(coordinatesDiffer("EPSG:25832", "EPSG:4326", place));
  EXPECT_FALSE(coordinatesDiffer("EPSG:2271", "EPSG:32128", {600000.0, 100000.0}));
}

TEST(Crs, OnlyAProjectedCrsPasses) {
  const auto refusal = [](const std::string& crs) {
    return test::messageOf<UsageError>([&] { requireProjectedCrs(crs, "option -crs"); });
  };
  EXPECT_EQ(refusal("EPSG:25832"), "no error");
  EXPECT_EQ(refusal("EPSG:2227"), "no error");
  EXPECT_EQ(refusal("EPSG:999999"),
            "option -crs: 'EPSG:999999' is not known to PROJ; give one as EPSG:CODE or WKT");
  EXPECT_NE(refusal("").find("option -crs"), std::string::npos);
  EXPECT_NE(refusal("EPSG:4326").find("(WGS 84) is not a projected CRS"), std::string::npos);
}

}  // namespace
}  // namespace pcl_als
