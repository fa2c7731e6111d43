// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "gdal_handle.h"

#include <mutex>
#include <utility>

#include <gdal_frmts.h>
#include <gdal_version.h>
#include <ogrsf_frmts.h>

#include <pcl_als/common/errors.h>

namespace pcl_als::detail {

GDALDriverH gdalDriver(const char* name) {
  // Not GDALAllRegister: it loads plugins, and a file should not be taken for one of 200 formats.
  static std::once_flag once;
  std::call_once(once, [] {
    GDALRegister_GTiff();
    GDALRegister_MEM();
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 1, 0)
    GDALRegister_COG();
#endif
#if GDAL_VERSION_NUM < GDAL_COMPUTE_VERSION(3, 11, 0)
    RegisterOGRMEM();
#endif
    RegisterOGRCSV();
    RegisterOGRGeoPackage();
  });
  return GDALGetDriverByName(name);
}

SpatialReference referenceOf(const std::string& crs, const GdalReports& reports) {
  SpatialReference reference(OSRNewSpatialReference(nullptr));
  const bool known = OSRSetFromUserInput(reference.get(), crs.c_str()) == OGRERR_NONE;
  const std::string name = crs.substr(0, 60) + (crs.size() > 60 ? "…" : "");
  reports.check(known, "the CRS " + name + " is not known to PROJ");
  return reference;
}

GdalReports::GdalReports(std::filesystem::path path,
                         const std::vector<std::filesystem::path>& temporaries)
    : path_(std::move(path)) {
  // Drivers name the file with its folder or without.
  for (const std::filesystem::path& temporary : temporaries)
    for (const std::string& name : {temporary.string(), temporary.filename().string()})
      temporaries_.push_back(name);
  CPLErrorReset();
  CPLPushErrorHandlerEx(&GdalReports::report, this);
}

GdalReports::~GdalReports() {
  CPLPopErrorHandler();
}

void GdalReports::report(CPLErr level, CPLErrorNum, const char* text) {
  auto* self = static_cast<GdalReports*>(CPLGetErrorHandlerUserData());
  if (level < CE_Failure || self == nullptr || !self->failure_.empty()) return;
  self->failure_ = text;
  for (char& letter : self->failure_)
    if (letter == '\n' || letter == '\r') letter = ' ';
}

void GdalReports::check(bool good, const std::string& what) const {
  if (good && failure_.empty()) return;
  std::string words = failure_;
  for (const std::string& name : temporaries_)
    for (std::size_t at = words.find(name); at != std::string::npos; at = words.find(name))
      words.replace(at, name.size(), path_.filename().string());
  throw InputError(path_.string() + ": " + what + (words.empty() ? "" : ": " + words));
}

}  // namespace pcl_als::detail
