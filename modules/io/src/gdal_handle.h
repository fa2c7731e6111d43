// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <cpl_error.h>
#include <gdal.h>
#include <ogr_srs_api.h>

namespace pcl_als::detail {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

struct DestroyReference {
  void operator()(void* reference) const { OSRDestroySpatialReference(reference); }
};
using SpatialReference = std::unique_ptr<void, DestroyReference>;

class GdalReports;
/// InputError for a CRS, WKT or "EPSG:…", that PROJ does not know.
SpatialReference referenceOf(const std::string& crs, const GdalReports& reports);

/// GDAL's driver of that short name, of those this module uses; null where GDAL lacks it.
GDALDriverH gdalDriver(const char* name);

/** \brief While it lives, what GDAL reports on this thread is kept here and not printed.
 *
 * GDAL has outcomes that it reports and does not return, a full disk at closing for one.
 */
class GdalReports {
 public:
  /// \param temporaries names that GDAL works under: reports name \a path in their place
  explicit GdalReports(std::filesystem::path path,
                       const std::vector<std::filesystem::path>& temporaries = {});
  ~GdalReports();
  GdalReports(const GdalReports&) = delete;
  GdalReports& operator=(const GdalReports&) = delete;

  /// InputError "path: what: GDAL's words" when a failure was reported or \a good is false.
  void check(bool good, const std::string& what) const;

 private:
  static void CPL_STDCALL report(CPLErr level, CPLErrorNum number, const char* text);

  std::filesystem::path path_;
  std::vector<std::string> temporaries_;
  std::string failure_;
};

}  // namespace pcl_als::detail
