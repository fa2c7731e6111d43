// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// User-defined projections of GeoTIFF keys against GDAL, which writes the keys, and reads them from
// the same file.
#include <cmath>
#include <memory>

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <pcl_als/las/las_file.h>

#include "file_bytes.h"
#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

using test::LasBytes;

struct Projection {
  const char* name;
  const char* proj;
  double longitude, latitude;  ///< of a place in its area, degrees
};

const Projection kProjections[] = {
    {"TransverseMercator",
     "+proj=tmerc +lat_0=49 +lon_0=-2 +k=0.9996012717 +x_0=400000 +y_0=-100000 +ellps=airy", -0.5,
     52},
    {"TransverseMercatorSurveyFeet",
     "+proj=tmerc +lat_0=36.6666666666667 +lon_0=-90.1666666666667 +k=0.999941177 "
     "+x_0=700000 +y_0=0 +datum=NAD83 +units=us-ft",
     -89, 40},
    {"SouthOriented", "+proj=tmerc +axis=wsu +lat_0=0 +lon_0=29 +k=1 +x_0=0 +y_0=0 +ellps=WGS84",
     28.2, -26},
    {"UtmOnAnotherEllipsoid", "+proj=utm +zone=33 +ellps=intl", 14, 48},
    {"LambertTwoParallels",
     "+proj=lcc +lat_0=41.75 +lon_0=-120.5 +lat_1=43 +lat_2=45.5 +x_0=400000 +y_0=0 "
     "+ellps=GRS80 +units=ft",
     -122, 44},
    {"LambertOneParallel",
     "+proj=lcc +lat_0=46.8 +lat_1=46.8 +lon_0=2.337229167 +k_0=0.99987742 +x_0=600000 "
     "+y_0=2200000 +ellps=clrk80ign",
     3, 47},
    {"MercatorScale", "+proj=merc +lon_0=110 +k=0.997 +x_0=3900000 +y_0=900000 +ellps=bessel", 108,
     -6},
    {"MercatorParallel", "+proj=merc +lat_ts=42 +lon_0=51 +x_0=0 +y_0=0 +ellps=krass", 50, 41},
    {"HotineA",
     "+proj=omerc +no_uoff +lat_0=4 +lonc=102.25 +alpha=323.0257905 +gamma=323.130102361111 "
     "+k=0.99984 +x_0=804670.24 +y_0=0 +ellps=GRS80",
     102, 4.5},
    {"HotineB",
     "+proj=omerc +lat_0=46.952405555 +lonc=7.439583333 +alpha=90 +gamma=90 +k=1 +x_0=2600000 "
     "+y_0=1200000 +ellps=bessel",
     8, 47},
    {"AzimuthalEqualArea", "+proj=laea +lat_0=52 +lon_0=10 +x_0=4321000 +y_0=3210000 +ellps=GRS80",
     12, 50},
    {"Albers", "+proj=aea +lat_0=23 +lon_0=-96 +lat_1=29.5 +lat_2=45.5 +x_0=0 +y_0=0 +ellps=GRS80",
     -95, 37},
    {"AzimuthalEquidistant",
     "+proj=aeqd +lat_0=53 +lon_0=24 +x_0=5837287.82 +y_0=2121415.696 +ellps=WGS84", 22, 51},
    {"EquidistantConic",
     "+proj=eqdc +lat_0=-32 +lon_0=-60 +lat_1=-5 +lat_2=-42 +x_0=0 +y_0=0 +ellps=GRS80", -58, -30},
    {"Stereographic", "+proj=stere +lat_0=52 +lon_0=19 +k=0.9998 +x_0=5e5 +y_0=3e5 +ellps=krass",
     20, 51},
    {"PolarScale", "+proj=stere +lat_0=90 +lon_0=0 +k=0.994 +x_0=2e6 +y_0=2e6 +ellps=WGS84", 15,
     80},
    {"PolarParallel", "+proj=stere +lat_0=-90 +lat_ts=-71 +lon_0=0 +x_0=0 +y_0=0 +ellps=WGS84", 165,
     -77},
    {"ObliqueStereographic",
     "+proj=sterea +lat_0=52.1561605555556 +lon_0=5.38763888888889 +k=0.9999079 +x_0=155000 "
     "+y_0=463000 +ellps=bessel",
     6, 53},
    {"Cassini",
     "+proj=cass +lat_0=10.4416666666667 +lon_0=-61.3333333333333 +x_0=86501.46 +y_0=65379.01 "
     "+a=6378293.63 +rf=294.26",
     -61, 10.6},
    {"Polyconic", "+proj=poly +lat_0=0 +lon_0=-54 +x_0=5e6 +y_0=1e7 +ellps=GRS80", -50, -20},
    {"CylindricalEqualArea", "+proj=cea +lat_ts=30 +lon_0=0 +x_0=0 +y_0=0 +ellps=WGS84", 4, 31},
    {"NewZealand", "+proj=nzmg +lat_0=-41 +lon_0=173 +x_0=2510000 +y_0=6023150 +ellps=intl", 174,
     -40},
};

/// The bytes of a tag in the first directory of a little-endian TIFF; empty without it.
std::string tag(const std::string& tiff, std::uint16_t wanted) {
  const auto directory = test::valueAt<std::uint32_t>(tiff, 4);
  for (std::size_t i = 0; i < test::valueAt<std::uint16_t>(tiff, directory); ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (test::valueAt<std::uint16_t>(tiff, entry) != wanted) continue;
    const std::size_t size = test::valueAt<std::uint16_t>(tiff, entry + 2) == 12 ? 8 : 2;
    const std::size_t bytes = size * test::valueAt<std::uint32_t>(tiff, entry + 4);
    return tiff.substr(bytes <= 4 ? entry + 8 : test::valueAt<std::uint32_t>(tiff, entry + 8),
                       bytes);
  }
  return {};
}

/// Easting and northing of a place that is given in the geographic system of the CRS itself.
std::pair<double, double> project(OGRSpatialReference crs, double longitude, double latitude) {
  std::unique_ptr<OGRSpatialReference> geographic(crs.CloneGeogCS());
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  geographic->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  std::unique_ptr<OGRCoordinateTransformation> to(
      OGRCreateCoordinateTransformation(geographic.get(), &crs));
  EXPECT_TRUE(to && to->Transform(1, &longitude, &latitude));
  return {longitude, latitude};
}

class GeoKeyProjections : public testing::TestWithParam<Projection> {};

TEST_P(GeoKeyProjections, GiveTheCoordinatesThatGdalGives) {
  const Projection& p = GetParam();
  const auto folder = test::scratch("geo_key_projections") / p.name;
  std::filesystem::create_directories(folder);
  GDALAllRegister();
  OGRSpatialReference stated;
  ASSERT_EQ(stated.SetFromUserInput(p.proj), OGRERR_NONE);
  const std::string tiff = (folder / "keys.tif").string();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  std::unique_ptr<GDALDataset> written(driver->Create(tiff.c_str(), 1, 1, 1, GDT_Byte, nullptr));
  written->SetSpatialRef(&stated);
  double place[6] = {0, 1, 0, 0, 0, -1};
  written->SetGeoTransform(place);
  written.reset();
  std::filesystem::remove(tiff + ".aux.xml");  // the CRS in full, beside the keys
  const std::unique_ptr<GDALDataset> read(
      static_cast<GDALDataset*>(GDALOpen(tiff.c_str(), GA_ReadOnly)));
  ASSERT_TRUE(read && read->GetSpatialRef() != nullptr);

  const std::string bytes = test::readBytes(tiff);
  ASSERT_EQ(bytes.substr(0, 2), "II");
  LasBytes las;
  las.vlrs = {LasBytes::vlr("LASF_Projection", 34735, tag(bytes, 34735)),
              LasBytes::vlr("LASF_Projection", 34736, tag(bytes, 34736))};
  test::writeBytes(folder / "keys.las", las.str());
  const LasFile file(folder / "keys.las");
  OGRSpatialReference ours;
  ASSERT_EQ(ours.SetFromUserInput(file.crs().c_str()), OGRERR_NONE) << file.crs();
  EXPECT_EQ(file.crsKind(), CrsKind::projected);
  const auto [x, y] = project(ours, p.longitude, p.latitude);
  const auto [gdal_x, gdal_y] = project(*read->GetSpatialRef(), p.longitude, p.latitude);
  EXPECT_NEAR(x, gdal_x, 1e-3) << file.crs();
  EXPECT_NEAR(y, gdal_y, 1e-3) << file.crs();
  EXPECT_NEAR(file.units().horizontal.metres, stated.GetLinearUnits(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Table, GeoKeyProjections, testing::ValuesIn(kProjections),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace pcl_als
