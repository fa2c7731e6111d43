// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/field_table.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/geopackage.h>
#include <pcl_als/report/quality_layers.h>

namespace pcl_als {
namespace {

/// The cells that all of these strips cover.
CodeRaster cellsOf(const StripCoverage& coverage, const std::vector<std::size_t>& strips) {
  CodeRaster raster;
  RasterGrid& grid = raster.grid;
  grid.cell = coverage.cell();
  grid.columns = coverage.columns();
  grid.rows = coverage.rows();
  grid.west = coverage.minimum().x();
  grid.north = coverage.minimum().y() + grid.rows * grid.cell;
  raster.values.resize(grid.cells());
  for (int row = 0; row < grid.rows; ++row) {
    for (int column = 0; column < grid.columns; ++column) {
      const bool covered = std::all_of(strips.begin(), strips.end(), [&](std::size_t strip) {
        return strip < coverage.strips() && coverage.covers(strip, column, grid.rows - 1 - row);
      });
      raster.values[grid.index(column, row)] = covered ? 1 : 0;
    }
  }
  return raster;
}

GeoTable stripTable(const StripCoverage& coverage, const std::vector<std::string>& names) {
  GeoTable table{"strips", "strip,area_m2\n"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    table.areas.push_back(cellsOf(coverage, {i}));
    const std::vector<std::uint8_t>& cells = table.areas.back().values;
    const auto covered = static_cast<double>(std::count(cells.begin(), cells.end(), 1));
    table.csv +=
        csvCell(names[i]) + ',' + numberText(covered * coverage.cell() * coverage.cell(), 0) + '\n';
  }
  return table;
}

/// In the order of the lines of pairs.csv.
GeoTable pairTable(const QualityReport& report, std::string csv, const StripCoverage& coverage,
                   const std::vector<std::string>& names) {
  GeoTable table{"pairs", std::move(csv)};
  const auto indexOf = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  for (const CheckedBlock* block : {report.before ? &*report.before : nullptr, &report.block}) {
    if (block == nullptr) continue;
    for (const CheckedPair& pair : block->pairs)
      table.areas.push_back(cellsOf(coverage, {indexOf(pair.a), indexOf(pair.b)}));
  }
  return table;
}

}  // namespace

void writeQualityLayers(const std::filesystem::path& path, const QualityReport& report,
                        const StripCoverage& coverage, const std::vector<std::string>& names,
                        const std::string& crs) {
  std::map<std::string, std::string> csv = qualityCsvTables(report);
  std::vector<GeoTable> tables{stripTable(coverage, names),
                               pairTable(report, std::move(csv["pairs"]), coverage, names),
                               {"offsets", std::move(csv["offsets"])}};
  if (report.block.control) tables.push_back({"control", std::move(csv["control"])});
  writeGeoPackage(path, tables, crs);
}

}  // namespace pcl_als
