// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>

#ifdef PCL_ALS_HAVE_PROJ
#include <proj_experimental.h>

#include "proj_object.h"
#endif

namespace pcl_als {
namespace {

/// A CRS is some kilobytes of WKT. What is longer is not handed to a parser.
constexpr std::size_t kLongestCrs = std::size_t{1} << 16;

#ifdef PCL_ALS_HAVE_PROJ

using detail::openCrs;
using detail::ProjContext;
using detail::ProjCrs;
using detail::ProjObject;
using detail::quietProjContext;

std::optional<LengthUnit> unitOfAxis(PJ_CONTEXT* context, const PJ* crs, int axis) {
  const ProjObject system(proj_crs_get_coordinate_system(context, crs));
  if (!system || axis >= proj_cs_get_axis_count(context, system.get())) return std::nullopt;
  double metres = 0.0;
  const char* name = nullptr;
  if (proj_cs_get_axis_info(context, system.get(), axis, nullptr, nullptr, nullptr, &metres, &name,
                            nullptr, nullptr) == 0)
    return std::nullopt;
  if (!(std::isfinite(metres) && metres > 0.0)) return std::nullopt;
  return lengthUnitOf(metres, name == nullptr ? "" : name);
}

CrsKind kindOf(PJ_TYPE type) {
  switch (type) {
    case PJ_TYPE_PROJECTED_CRS:
      return CrsKind::projected;
    case PJ_TYPE_ENGINEERING_CRS:
      return CrsKind::local;
    case PJ_TYPE_GEOGRAPHIC_2D_CRS:
    case PJ_TYPE_GEOGRAPHIC_3D_CRS:
      return CrsKind::geographic;
    case PJ_TYPE_GEOCENTRIC_CRS:
      return CrsKind::geocentric;
    default:
      return CrsKind::unknown;
  }
}

CrsDescription describeWithProj(const std::string& crs) {
  constexpr int kHeightAxis = 2;
  CrsDescription description;
  const ProjContext context = quietProjContext();
  const ProjCrs parts = openCrs(context.get(), crs);
  if (!parts.horizontal) return description;
  const PJ* const horizontal = parts.horizontal.get();
  description.kind = kindOf(proj_get_type(horizontal));
  if (const char* name = proj_get_name(horizontal)) description.name = name;
  if (proj_get_type(horizontal) == PJ_TYPE_VERTICAL_CRS)
    description.vertical = unitOfAxis(context.get(), horizontal, 0);
  if (description.kind == CrsKind::projected || description.kind == CrsKind::local) {
    description.horizontal = unitOfAxis(context.get(), horizontal, 0);
    description.vertical = unitOfAxis(context.get(), horizontal, kHeightAxis);
  }
  if (parts.vertical) description.vertical = unitOfAxis(context.get(), parts.vertical.get(), 0);
  return description;
}

ProjObject withUnit(PJ_CONTEXT* context, const PJ* crs, const LengthUnit& unit) {
  return ProjObject(proj_crs_alter_cs_linear_unit(context, crs, unit.name.c_str(), unit.metres,
                                                  nullptr, nullptr));
}

/// The horizontal part of a CRS with coordinates in metres; null where PROJ does not know it.
ProjObject inMetres(PJ_CONTEXT* context, const std::string& crs) {
  if (crs.size() > kLongestCrs) return {};
  const ProjCrs parts = openCrs(context, crs);
  return parts.horizontal ? withUnit(context, parts.horizontal.get(), LengthUnit()) : ProjObject();
}

bool areEquivalent(const ProjObject& a, const ProjObject& b) {
  return proj_is_equivalent_to(a.get(), b.get(), PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
}

bool isProjected(const ProjObject& crs) {
  return crs && proj_get_type(crs.get()) == PJ_TYPE_PROJECTED_CRS;
}

#endif

}  // namespace

CrsDescription describeCrs(const std::string& crs) {
  if (crs.empty() || crs.size() > kLongestCrs) return {};
#ifdef PCL_ALS_HAVE_PROJ
  constexpr std::size_t kMostKept = 64;
  static std::mutex mutex;
  static std::map<std::string, CrsDescription> known;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = known.find(crs);
  if (found != known.end()) return found->second;
  if (known.size() >= kMostKept) known.clear();
  return known[crs] = describeWithProj(crs);
#else
  return {};
#endif
}

LinearUnits unitsOfCrs(const std::string& crs, const std::string& source) {
  const CrsDescription description = describeCrs(crs);
  const std::string stated_by = source.empty() ? crs : source;
  LinearUnits units;
  if (description.horizontal) {
    units.horizontal = units.vertical = *description.horizontal;
    units.source = stated_by;
  }
  if (description.vertical) {
    units.vertical = *description.vertical;
    units.vertical_source = stated_by;
  }
  return units;
}

std::string crsInUnit(const std::string& crs, [[maybe_unused]] const LengthUnit& unit) {
  if (crs.empty() || crs.size() > kLongestCrs) return {};
#ifdef PCL_ALS_HAVE_PROJ
  const ProjContext context = quietProjContext();
  const ProjCrs parts = openCrs(context.get(), crs);
  if (!parts.horizontal) return {};
  const ProjObject altered = withUnit(context.get(), parts.horizontal.get(), unit);
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* text =
      altered ? proj_as_wkt(context.get(), altered.get(), PJ_WKT1_GDAL, options) : nullptr;
  return text == nullptr ? "" : text;
#else
  return {};
#endif
}

std::string horizontalCrs(const std::string& crs) {
#ifdef PCL_ALS_HAVE_PROJ
  if (!crs.empty() && crs.size() <= kLongestCrs) {
    const ProjContext context = quietProjContext();
    const ProjCrs parts = openCrs(context.get(), crs);
    const char* const options[] = {"MULTILINE=NO", nullptr};
    const char* text =
        parts.vertical ? proj_as_wkt(context.get(), parts.horizontal.get(), PJ_WKT2_2019, options)
                       : nullptr;
    if (text != nullptr) return text;
  }
#endif
  return crs;
}

std::string localCrs(const LengthUnit& unit) {
  char factor[40];
  std::snprintf(factor, sizeof factor, "%.17g", unit.metres);
  return "LOCAL_CS[\"unknown\",UNIT[\"" + unit.name + "\"," + factor + "]]";
}

bool sameGroundFrame(const std::string& a, const std::string& b) {
  if (a == b) return true;
#ifdef PCL_ALS_HAVE_PROJ
  const ProjContext context = quietProjContext();
  const ProjObject first = inMetres(context.get(), a), second = inMetres(context.get(), b);
  return first && second && areEquivalent(first, second);
#else
  return false;
#endif
}

bool coordinatesDiffer([[maybe_unused]] const std::string& a, [[maybe_unused]] const std::string& b,
                       [[maybe_unused]] const Eigen::Vector2d& place) {
#ifdef PCL_ALS_HAVE_PROJ
  constexpr double kSame = 1.0;  // metres: more than realisations of one datum differ
  const ProjContext context = quietProjContext();
  const ProjObject first = inMetres(context.get(), a), second = inMetres(context.get(), b);
  if (!isProjected(first) || !isProjected(second) || areEquivalent(first, second)) return false;
  const ProjObject between(
      proj_create_crs_to_crs_from_pj(context.get(), first.get(), second.get(), nullptr, nullptr));
  if (!between) return false;
  // East before north, whatever the order of the axes in the definitions.
  const ProjObject eastern(proj_normalize_for_visualization(context.get(), between.get()));
  if (!eastern) return false;
  const PJ_COORD there =
      proj_trans(eastern.get(), PJ_FWD, proj_coord(place.x(), place.y(), 0.0, HUGE_VAL));
  // Not finite: outside the area that the other projection can represent.
  return !(std::hypot(there.xy.x - place.x(), there.xy.y - place.y()) <= kSame);
#else
  return false;
#endif
}

void requireProjectedCrs([[maybe_unused]] const std::string& crs,
                         [[maybe_unused]] const std::string& what) {
#ifdef PCL_ALS_HAVE_PROJ
  const CrsDescription description = describeCrs(crs);
  if (description.kind == CrsKind::projected) return;
  const std::string name = what + ": '" + shortCrsName(crs) + "' ";
  if (description.name.empty())
    throw UsageError(name + "is not known to PROJ; give one as EPSG:CODE or WKT");
  throw UsageError(name + "(" + description.name +
                   ") is not a projected CRS; give one with coordinates in metres or feet");
#endif
}

void requireMapCoordinates(const PointFileInfo& info) {
  const bool geographic = info.crs_kind == CrsKind::geographic;
  if (!geographic && info.crs_kind != CrsKind::geocentric) return;
  std::string crs = info.crs.empty() ? "" : " (" + shortCrsName(info.crs) + ")";
  if (geographic && info.crs.empty()) crs = " by their range and steps";
  throw InputError(info.path.string() + ": its coordinates are " +
                   (geographic ? "degrees" : "geocentric") + crs +
                   "; reproject it to a map projection in metres or feet first");
}

std::string crsAsWkt([[maybe_unused]] const std::string& crs) {
#ifdef PCL_ALS_HAVE_PROJ
  const ProjContext context = quietProjContext();
  const ProjObject definition(proj_create(context.get(), crs.c_str()));
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* text =
      definition ? proj_as_wkt(context.get(), definition.get(), PJ_WKT1_GDAL, options) : nullptr;
  if (text == nullptr || *text == '\0') throw UsageError("CRS " + crs + ": is not known to PROJ");
  return text;
#else
  return {};
#endif
}

std::string projectedCrs([[maybe_unused]] const std::string& geographic,
                         [[maybe_unused]] unsigned projection,
                         [[maybe_unused]] const LengthUnit& unit) {
#ifdef PCL_ALS_HAVE_PROJ
  const ProjContext context = quietProjContext();
  PJ_CONTEXT* const c = context.get();
  const ProjObject base(proj_create(c, geographic.c_str()));
  const ProjObject conversion(proj_create_from_database(
      c, "EPSG", std::to_string(projection).c_str(), PJ_CATEGORY_COORDINATE_OPERATION, 0, nullptr));
  if (!base || !conversion || proj_get_type(conversion.get()) != PJ_TYPE_CONVERSION) return {};
  const ProjObject axes(
      proj_create_cartesian_2D_cs(c, PJ_CART2D_EASTING_NORTHING, unit.name.c_str(), unit.metres));
  const ProjObject crs(
      proj_create_projected_crs(c, "unknown", base.get(), conversion.get(), axes.get()));
  const char* const options[] = {"MULTILINE=NO", nullptr};
  const char* text = crs ? proj_as_wkt(c, crs.get(), PJ_WKT1_GDAL, options) : nullptr;
  return text == nullptr ? "" : text;
#else
  return {};
#endif
}

StatedCrs usableCrs(const std::string& stated) {
  const bool says_something = std::any_of(stated.begin(), stated.end(),
                                          [](unsigned char c) { return std::isalnum(c) != 0; });
  if (!says_something) return {};
#ifdef PCL_ALS_HAVE_PROJ
  if (stated.rfind("EPSG:", 0) == 0 && describeCrs(stated).name.empty())
    return {{}, stated + " is not known to PROJ"};
#endif
  return {stated, {}};
}

std::optional<LengthUnit> unitOfEpsgCode(unsigned code) {
  constexpr unsigned kMetre = 9001, kFoot = 9002, kSurveyFoot = 9003;
  if (code == kMetre) return LengthUnit();
  if (code == kFoot) return lengthUnitOf(0.3048);
  if (code == kSurveyFoot) return lengthUnitOf(12.0 / 39.37);
#ifdef PCL_ALS_HAVE_PROJ
  const ProjContext context = quietProjContext();
  const char *name = nullptr, *category = nullptr;
  double metres = 0.0;
  if (proj_uom_get_info_from_database(context.get(), "EPSG", std::to_string(code).c_str(), &name,
                                      &metres, &category) != 0 &&
      category != nullptr && std::string(category) == "linear" && std::isfinite(metres) &&
      metres > 0.0)
    return lengthUnitOf(metres, name == nullptr ? "" : name);
#endif
  return std::nullopt;
}

std::string shortCrsName(const std::string& crs) {
  constexpr std::size_t kLongest = 60;
  return crs.size() > kLongest ? crs.substr(0, kLongest) + "..." : crs;
}

}  // namespace pcl_als
