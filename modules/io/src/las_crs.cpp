// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cctype>

#include <pcl_als/common/errors.h>

#ifdef PCL_ALS_HAVE_PROJ
#include <proj.h>
#endif

#include "geo_keys.h"
#include "las_bytes.h"
#include "las_crs.h"

namespace pcl_als::detail {
namespace {

constexpr const char* kProjection = "LASF_Projection";
constexpr std::uint16_t kGeoDoublesRecord = 34736;
constexpr unsigned long kMostGeoCode = 32766;
constexpr std::size_t kLargestRecord = std::size_t{1} << 24;

const LasVlrEntry* findRecord(const LasFile& file, std::uint16_t id) {
  for (const LasVlrEntry& vlr : file.vlrs())
    if (vlr.user_id == kProjection && vlr.record_id == id) return &vlr;
  return nullptr;
}

std::string wktOf(const LasFile& file) {
  const LasVlrEntry* vlr = findRecord(file, kWktRecord);
  if (vlr == nullptr) return {};
  const std::vector<std::byte> bytes = file.payload(*vlr, kLargestRecord);
  std::string wkt = textField(bytes.data(), bytes.size());
  while (!wkt.empty() && std::isspace(static_cast<unsigned char>(wkt.back())) != 0) wkt.pop_back();
  return wkt;
}

std::string epsgOf(const LasFile& file) {
  const LasVlrEntry* directory = findRecord(file, kGeoKeyRecord);
  if (directory == nullptr) return {};
  const LasVlrEntry* doubles = findRecord(file, kGeoDoublesRecord);
  return epsgOfGeoKeys(
      file.payload(*directory, kLargestRecord),
      doubles == nullptr ? std::vector<std::byte>() : file.payload(*doubles, kLargestRecord));
}

bool isEpsg(const std::string& crs) {
  return crs.size() > 5 && crs.compare(0, 5, "EPSG:") == 0 &&
         std::all_of(crs.begin() + 5, crs.end(), [](unsigned char c) { return std::isdigit(c); });
}

LasVlr wktRecord(const std::string& wkt) {
  LasVlr vlr{kProjection, kWktRecord, "OGC coordinate system WKT", {}};
  const auto* bytes = reinterpret_cast<const std::byte*>(wkt.c_str());
  vlr.data.assign(bytes, bytes + wkt.size() + 1);
  return vlr;
}

#ifdef PCL_ALS_HAVE_PROJ
std::string wktFromProj(const std::string& crs) {
  PJ_CONTEXT* context = proj_context_create();
  proj_log_level(context, PJ_LOG_NONE);
  PJ* definition = proj_create(context, crs.c_str());
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* text =
      definition == nullptr ? nullptr : proj_as_wkt(context, definition, PJ_WKT1_GDAL, options);
  std::string wkt = text == nullptr ? "" : text;
  proj_destroy(definition);
  proj_context_destroy(context);
  if (wkt.empty()) throw UsageError("CRS " + crs + ": is not known to PROJ");
  return wkt;
}
#endif

}  // namespace

std::string readLasCrs(const LasFile& file) {
  if ((file.header().global_encoding & kLasWkt) != 0) {
    const std::string wkt = wktOf(file);
    return wkt.empty() ? epsgOf(file) : wkt;
  }
  const std::string epsg = epsgOf(file);
  return epsg.empty() ? wktOf(file) : epsg;
}

std::vector<LasVlr> lasCrsRecords(const std::string& crs, [[maybe_unused]] bool wkt_wanted) {
  if (crs.empty()) return {};
  if (!isEpsg(crs)) return {wktRecord(crs)};
  const unsigned long code = std::stoul(crs.substr(5, 6));
#ifdef PCL_ALS_HAVE_PROJ
  if (wkt_wanted || code > kMostGeoCode) return {wktRecord(wktFromProj(crs))};
#endif
  if (code > kMostGeoCode)
    throw UsageError("CRS " + crs + ": GeoTIFF keys hold codes up to 32766; give it as WKT");
  return {{kProjection, kGeoKeyRecord, "GeoTIFF GeoKeyDirectoryTag",
           geoKeysOfEpsg(static_cast<unsigned>(code))}};
}

}  // namespace pcl_als::detail
