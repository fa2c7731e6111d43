// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "raster_georeference.h"

#include <cmath>
#include <cstdlib>
#include <cstring>

#include <cpl_conv.h>
#include <cpl_string.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>

namespace pcl_als::detail {
namespace {

// TIFF has no place for the names of values; GDAL would put them into a second file.
constexpr const char* kClassItem = "CLASS_";
// A square cell as other programs write it may differ in the last digits of its sides.
constexpr double kSquareTolerance = 1e-9;

/// Length of the unit that places count in in a file of that CRS, metres.
double metresPerUnit(const std::string& crs) {
  return unitsOfCrs(crs).horizontal.metres;
}

void setReference(GDALDatasetH dataset, const RasterGrid& grid, const GdalReports& reports) {
  const double metres = metresPerUnit(grid.crs), cell = grid.cell / metres;
  double transform[] = {grid.west / metres, cell, 0.0, grid.north / metres, 0.0, -cell};
  reports.check(GDALSetGeoTransform(dataset, transform) == CE_None, "cannot be georeferenced");
  if (grid.crs.empty()) return;
  const SpatialReference reference = referenceOf(grid.crs, reports);
  reports.check(GDALSetSpatialRef(dataset, reference.get()) == CE_None, "cannot keep its CRS");
}

void setLegend(GDALDatasetH dataset, GDALRasterBandH band, const std::vector<CodeMeaning>& legend) {
  const std::unique_ptr<void, void (*)(void*)> table(GDALCreateColorTable(GPI_RGB),
                                                     GDALDestroyColorTable);
  const GDALColorEntry transparent{0, 0, 0, 0};
  GDALSetColorEntry(table.get(), 0, &transparent);
  for (const CodeMeaning& entry : legend) {
    const GDALColorEntry colour{entry.colour[0], entry.colour[1], entry.colour[2], 255};
    GDALSetColorEntry(table.get(), entry.value, &colour);
    GDALSetMetadataItem(dataset, (kClassItem + std::to_string(entry.value)).c_str(),
                        entry.name.c_str(), nullptr);
  }
  GDALSetRasterColorTable(band, table.get());
}

std::vector<CodeMeaning> legendOf(GDALDatasetH dataset) {
  std::vector<CodeMeaning> legend;
  const GDALColorTableH table = GDALGetRasterColorTable(GDALGetRasterBand(dataset, 1));
  for (int value = 0; value < 256; ++value) {
    const char* name =
        GDALGetMetadataItem(dataset, (kClassItem + std::to_string(value)).c_str(), nullptr);
    if (name == nullptr) continue;
    CodeMeaning entry{static_cast<std::uint8_t>(value), name, {}};
    const GDALColorEntry* colour = table == nullptr || value >= GDALGetColorEntryCount(table)
                                       ? nullptr
                                       : GDALGetColorEntry(table, value);
    if (colour != nullptr)
      entry.colour = {static_cast<std::uint8_t>(colour->c1), static_cast<std::uint8_t>(colour->c2),
                      static_cast<std::uint8_t>(colour->c3)};
    legend.push_back(entry);
  }
  return legend;
}

std::string crsOf(GDALDatasetH dataset) {
  const OGRSpatialReferenceH reference = GDALGetSpatialRef(dataset);
  if (reference == nullptr) return {};
  const char* authority = OSRGetAuthorityName(reference, nullptr);
  const char* code = OSRGetAuthorityCode(reference, nullptr);
  if (authority != nullptr && code != nullptr && std::strcmp(authority, "EPSG") == 0)
    return std::string("EPSG:") + code;
  char* text = nullptr;
  const std::string wkt = OSRExportToWkt(reference, &text) == OGRERR_NONE ? text : "";
  CPLFree(text);
  return wkt;
}

RasterGrid gridOf(GDALDatasetH dataset, const GdalReports& reports) {
  double transform[6];
  reports.check(GDALGetGeoTransform(dataset, transform) == CE_None, "has no georeference");
  reports.check(
      transform[2] == 0.0 && transform[4] == 0.0 && transform[1] > 0.0 && transform[5] < 0.0,
      "is rotated or not north up; warp it first");
  reports.check(std::abs(transform[1] + transform[5]) <= kSquareTolerance * transform[1],
                "its cells are not square; warp it first");
  RasterGrid grid;
  grid.crs = crsOf(dataset);
  const double metres = metresPerUnit(grid.crs);
  grid.west = transform[0] * metres;
  grid.north = transform[3] * metres;
  grid.cell = transform[1] * metres;
  grid.columns = GDALGetRasterXSize(dataset);
  grid.rows = GDALGetRasterYSize(dataset);
  return grid;
}

void readMetadata(GDALDatasetH dataset, RasterLayout& layout) {
  char** items = GDALGetMetadata(dataset, nullptr);
  for (int i = 0; i < CSLCount(items); ++i) {
    char* key = nullptr;
    const char* value = CPLParseNameValue(items[i], &key);
    if (key != nullptr && value != nullptr && std::strncmp(key, kClassItem, 6) != 0)
      layout.metadata[key] = value;
    CPLFree(key);
  }
}

}  // namespace

void describeDataset(GDALDatasetH dataset, const RasterLayout& layout, const GdalReports& reports) {
  setReference(dataset, layout.grid, reports);
  for (const auto& [name, text] : layout.metadata)
    GDALSetMetadataItem(dataset, name.c_str(), text.c_str(), nullptr);
  const bool bytes = layout.type == RasterLayout::Type::byte;
  for (std::size_t i = 0; i < layout.bands.size(); ++i) {
    const GDALRasterBandH band = GDALGetRasterBand(dataset, static_cast<int>(i) + 1);
    if (!layout.bands[i].empty()) GDALSetDescription(band, layout.bands[i].c_str());
    GDALSetRasterNoDataValue(band, bytes ? CodeRaster::kNoClass : layout.no_data);
  }
  if (bytes && !layout.legend.empty())
    setLegend(dataset, GDALGetRasterBand(dataset, 1), layout.legend);
  reports.check(true, "cannot be written");
}

RasterLayout layoutOf(GDALDatasetH dataset, const GdalReports& reports) {
  RasterLayout layout;
  layout.grid = gridOf(dataset, reports);
  const int bands = GDALGetRasterCount(dataset);
  reports.check(bands > 0, "has no bands");
  for (int i = 1; i <= bands; ++i)
    layout.bands.emplace_back(GDALGetDescription(GDALGetRasterBand(dataset, i)));
  const GDALRasterBandH first = GDALGetRasterBand(dataset, 1);
  if (GDALGetRasterDataType(first) == GDT_Byte) layout.type = RasterLayout::Type::byte;
  int has_no_data = 0;
  const double no_data = GDALGetRasterNoDataValue(first, &has_no_data);
  layout.no_data = has_no_data != 0 ? no_data : std::nan("");
  layout.legend = legendOf(dataset);
  readMetadata(dataset, layout);
  return layout;
}

void checkWindow(const RasterLayout& layout, std::size_t band, const RasterWindow& window) {
  if (band >= layout.bands.size())
    throw UsageError("band " + std::to_string(band) + " of a raster of " +
                     std::to_string(layout.bands.size()) + " bands");
  const bool inside = window.column >= 0 && window.row >= 0 && window.columns > 0 &&
                      window.rows > 0 && window.columns <= layout.grid.columns - window.column &&
                      window.rows <= layout.grid.rows - window.row;
  if (!inside) throw UsageError("a window of cells that is not within its raster");
}

}  // namespace pcl_als::detail
