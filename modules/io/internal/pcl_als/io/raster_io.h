// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/point_file_info.h>
#include <pcl_als/common/raster.h>

namespace pcl_als {
namespace detail {
class OpenedRaster;
class WrittenRaster;
}  // namespace detail

// Target pcl_als::io_raster, a library of its own: GDAL costs a program 35 MB and 70 ms at its
// start, which tools that write no raster need not pay.

/// What a GeoTIFF holds beside its cells.
struct RasterLayout {
  enum class Type { float32, byte };

  RasterGrid grid;
  Type type = Type::float32;
  std::vector<std::string> bands;   ///< one name per band
  std::vector<CodeMeaning> legend;  ///< colours and names of the values of bytes; may be empty
  double no_data = -9999.0;         ///< in the file; in memory floats without value are NaN
  std::map<std::string, std::string> metadata;  ///< further items, name and text
};

struct RasterOptions {
  bool overviews = true;  ///< means of floats, commonest class of bytes, halving to 256 cells
  bool cloud_optimised =
      true;              ///< where the installed GDAL can (3.1); else plain tiles of 512 cells
  bool compress = true;  ///< without loss; cloud-optimised files always are
  int threads = 0;       ///< that compress; 0: as many as there are. The file does not depend on it
  std::filesystem::path named;  ///< of a scratch file: the output that messages name in its place
};

/** \brief Writes a GeoTIFF block by block, for rasters larger than memory.
 *
 * Places are given in metres and georeferenced in the unit of the CRS (unitsOfCrs()); values are
 * written as they are, heights in metres. The file has the CRS, the no-data value (bytes: 0), names
 * of bands, a colour table, overviews, is compressed without loss and appears under its name at
 * commit() only; see AtomicFile. Blocks come in any order, those of 512 rows in order are fastest;
 * cells never written have no value. Until commit() an uncompressed copy of the raster lies beside
 * the file.
 *
 * Memory: GDAL's cache of blocks (5 % of the machine's memory at most). Everything that fails is an
 * InputError that names the file; a CRS that PROJ does not know, too.
 */
class RasterWriter {
 public:
  RasterWriter(const std::filesystem::path& path, RasterLayout layout, RasterOptions options = {});
  ~RasterWriter();
  RasterWriter(const RasterWriter&) = delete;
  RasterWriter& operator=(const RasterWriter&) = delete;

  const RasterLayout& layout() const;
  /// Values of a window, row by row; UsageError for the other type of values or a window outside.
  void write(std::size_t band, const RasterWindow& window, const float* values);
  void write(std::size_t band, const RasterWindow& window, const std::uint8_t* values);
  void commit();

 private:
  std::unique_ptr<detail::WrittenRaster> file_;
};

/** \brief Reads a GeoTIFF window by window.
 *
 * Places are brought to metres from the unit of the file's CRS.
 * Bands of any number type are read as float (no-data as NaN; with the scale and offset that the
 * file states) or, those of bytes, as bytes.
 * InputError for a file that is no GeoTIFF, not north up, without georeference, whose cells are not
 * square, whose header declares more cells than such a file can hold (65536 per byte) or whose
 * blocks are larger than 512 MiB. A CRS that is an EPSG code is given as "EPSG:…", another as WKT.
 */
class RasterReader {
 public:
  explicit RasterReader(const std::filesystem::path& path);
  ~RasterReader();
  RasterReader(const RasterReader&) = delete;
  RasterReader& operator=(const RasterReader&) = delete;

  const RasterLayout& layout() const;
  /// CRS and units, as of a point file whose heights are the values of the first band: in the unit
  /// that the band states, else in that of the vertical axis of the CRS, else in metres. InputError
  /// for a unit that is no known unit of length.
  PointFileInfo info() const;
  int overviews() const;  ///< number of smaller copies of the first band
  void read(std::size_t band, const RasterWindow& window, float* values);
  void read(std::size_t band, const RasterWindow& window, std::uint8_t* values);
  /// A window of bytes as \a columns x \a rows of the commonest in each part, from overviews where
  /// there are some.
  void readReduced(std::size_t band, const RasterWindow& window, int columns, int rows,
                   std::uint8_t* values);

 private:
  std::unique_ptr<detail::OpenedRaster> file_;
};

/// Whole rasters that are in memory. InputError for a file that needs more than the machine has.
void writeRaster(const std::filesystem::path& path, const Raster& raster,
                 const RasterOptions& options = {});
Raster readRaster(const std::filesystem::path& path);
void writeCodeRaster(const std::filesystem::path& path, const CodeRaster& raster,
                     const RasterOptions& options = {});
/// \param largest_side when positive: a raster with a longer side is reduced by a whole factor to
/// the commonest class of each part, for pictures of rasters larger than memory
CodeRaster readCodeRaster(const std::filesystem::path& path, int largest_side = 0);

}  // namespace pcl_als
