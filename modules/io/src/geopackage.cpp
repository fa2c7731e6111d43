// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>
#include <pcl_als/io/geopackage.h>

#ifdef PCL_ALS_HAVE_GDAL

#include <gdal_alg.h>
#include <ogr_api.h>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/crs/crs.h>

#include "gdal_handle.h"

namespace pcl_als {
namespace {

using detail::Dataset;
using detail::GdalReports;
using detail::SpatialReference;

/// A file of GDAL's in memory, with a name of its own.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& ending)
      : name_("/vsimem/pcl_als_" + std::to_string(reinterpret_cast<std::uintptr_t>(this)) +
              ending) {}
  ~MemoryFile() { VSIUnlink(name_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const char* name() const { return name_.c_str(); }

 private:
  std::string name_;
};

struct DestroyFeature {
  void operator()(void* feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<void, DestroyFeature>;

/// The lines of a table, as features without geometry.
class CsvLines {
 public:
  CsvLines(const GeoTable& table, const GdalReports& reports) : file_(".csv"), text_(table.csv) {
    VSILFILE* file = VSIFileFromMemBuffer(file_.name(), reinterpret_cast<GByte*>(text_.data()),
                                          text_.size(), FALSE);
    VSIFCloseL(file);
    const char* const drivers[] = {"CSV", nullptr};
    const char* const options[] = {"AUTODETECT_TYPE=YES", "AUTODETECT_SIZE_LIMIT=0",
                                   "EMPTY_STRING_AS_NULL=YES", nullptr};
    dataset_.reset(GDALOpenEx(file_.name(), GDAL_OF_VECTOR, drivers, options, nullptr));
    reports.check(dataset_ != nullptr, "cannot be written");
  }
  OGRLayerH layer() const { return GDALDatasetGetLayer(dataset_.get(), 0); }

 private:
  MemoryFile file_;
  std::string text_;
  Dataset dataset_;
};

OGRGeometryH pointOf(OGRFeatureH feature, double metres) {
  const int x = OGR_F_GetFieldIndex(feature, "x"), y = OGR_F_GetFieldIndex(feature, "y");
  if (x < 0 || y < 0 || !OGR_F_IsFieldSetAndNotNull(feature, x) ||
      !OGR_F_IsFieldSetAndNotNull(feature, y))
    return nullptr;
  const OGRGeometryH point = OGR_G_CreateGeometry(wkbPoint);
  OGR_G_SetPoint_2D(point, 0, OGR_F_GetFieldAsDouble(feature, x) / metres,
                    OGR_F_GetFieldAsDouble(feature, y) / metres);
  return point;
}

/// A dataset in memory for polygons; the name of the driver depends on the version of GDAL.
Dataset polygonsInMemory() {
  GDALDriverH driver = detail::gdalDriver("Memory");
  if (driver == nullptr) driver = detail::gdalDriver("MEM");
  return Dataset(GDALCreate(driver, "", 0, 0, 0, GDT_Unknown, nullptr));
}

/// The outlines of the cells that are not 0.
OGRGeometryH areaOf(const CodeRaster& raster, double metres, const GdalReports& reports) {
  const RasterGrid& grid = raster.grid;
  const Dataset cells(
      GDALCreate(detail::gdalDriver("MEM"), "", grid.columns, grid.rows, 1, GDT_Byte, nullptr));
  reports.check(cells != nullptr, "cannot be written");
  const double cell = grid.cell / metres;
  double transform[] = {grid.west / metres, cell, 0.0, grid.north / metres, 0.0, -cell};
  GDALSetGeoTransform(cells.get(), transform);
  const GDALRasterBandH band = GDALGetRasterBand(cells.get(), 1);
  std::vector<std::uint8_t> values = raster.values;
  for (std::uint8_t& value : values) value = value != 0 ? 1 : 0;
  reports.check(GDALRasterIO(band, GF_Write, 0, 0, grid.columns, grid.rows, values.data(),
                             grid.columns, grid.rows, GDT_Byte, 0, 0) == CE_None,
                "cannot be written");
  const Dataset found = polygonsInMemory();
  const OGRLayerH layer =
      GDALDatasetCreateLayer(found.get(), "areas", nullptr, wkbPolygon, nullptr);
  reports.check(layer != nullptr &&
                    GDALPolygonize(band, band, layer, -1, nullptr, nullptr, nullptr) == CE_None,
                "cannot be written");
  const OGRGeometryH area = OGR_G_CreateGeometry(wkbMultiPolygon);
  OGR_L_ResetReading(layer);
  while (const Feature polygon{OGR_L_GetNextFeature(layer)})
    OGR_G_AddGeometry(area, OGR_F_GetGeometryRef(polygon.get()));
  return area;
}

void addTable(GDALDatasetH package, const GeoTable& table, OGRSpatialReferenceH reference,
              double metres, const GdalReports& reports) {
  const CsvLines lines(table, reports);
  const auto count = static_cast<std::size_t>(OGR_L_GetFeatureCount(lines.layer(), TRUE));
  if (count == 0) return;
  if (!table.areas.empty() && table.areas.size() != count)
    throw UsageError("table " + table.name + ": has " + std::to_string(table.areas.size()) +
                     " areas for " + std::to_string(count) + " lines");
  const OGRLayerH layer =
      GDALDatasetCreateLayer(package, table.name.c_str(), reference,
                             table.areas.empty() ? wkbPoint : wkbMultiPolygon, nullptr);
  reports.check(layer != nullptr, "cannot be written");
  const OGRFeatureDefnH fields = OGR_L_GetLayerDefn(lines.layer());
  for (int i = 0; i < OGR_FD_GetFieldCount(fields); ++i)
    reports.check(OGR_L_CreateField(layer, OGR_FD_GetFieldDefn(fields, i), TRUE) == OGRERR_NONE,
                  "cannot be written");
  reports.check(OGR_L_StartTransaction(layer) == OGRERR_NONE, "cannot be written");
  OGR_L_ResetReading(lines.layer());
  for (std::size_t i = 0; i < count; ++i) {
    const Feature line(OGR_L_GetNextFeature(lines.layer()));
    const Feature feature(OGR_F_Create(OGR_L_GetLayerDefn(layer)));
    OGR_F_SetFrom(feature.get(), line.get(), TRUE);
    OGRGeometryH geometry =
        table.areas.empty() ? pointOf(line.get(), metres) : areaOf(table.areas[i], metres, reports);
    if (geometry != nullptr) OGR_F_SetGeometryDirectly(feature.get(), geometry);
    reports.check(OGR_L_CreateFeature(layer, feature.get()) == OGRERR_NONE, "cannot be written");
  }
  reports.check(OGR_L_CommitTransaction(layer) == OGRERR_NONE, "cannot be written");
}

}  // namespace

void writeGeoPackage(const std::filesystem::path& path, const std::vector<GeoTable>& tables,
                     const std::string& crs) {
  const MemoryFile file(".gpkg");
  const GdalReports reports(path, {file.name()});
  SpatialReference reference;
  if (!crs.empty()) reference = detail::referenceOf(crs, reports);
  Dataset package(
      GDALCreate(detail::gdalDriver("GPKG"), file.name(), 0, 0, 0, GDT_Unknown, nullptr));
  reports.check(package != nullptr, "cannot be written");
  for (const GeoTable& table : tables)
    addTable(package.get(), table, reference.get(), unitsOfCrs(crs).horizontal.metres, reports);
  package.reset();
  reports.check(true, "cannot be written");
  vsi_l_offset bytes = 0;
  const GByte* content = VSIGetMemFileBuffer(file.name(), &bytes, FALSE);
  reports.check(content != nullptr, "cannot be written");
  writeFile(path, {reinterpret_cast<const char*>(content), static_cast<std::size_t>(bytes)});
}

}  // namespace pcl_als

#else

namespace pcl_als {

void writeGeoPackage(const std::filesystem::path& path, const std::vector<GeoTable>& /*tables*/,
                     const std::string& /*crs*/) {
  throw InputError(path.string() +
                   ": GeoPackages need GDAL; build with -DPCL_ALS_WITH_GDAL=ON and libgdal-dev");
}

}  // namespace pcl_als

#endif
