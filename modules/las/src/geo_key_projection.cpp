// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "geo_key_projection.h"

#include <cmath>
#include <cstdio>
#include <initializer_list>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/crs/crs.h>

namespace pcl_als::detail {
namespace {

/// The parameters of projections.
enum class Parameter {
  latitude,
  longitude,
  parallel_1,
  parallel_2,
  scale,
  azimuth,
  rectified_angle,
};

/// A parameter and its name in WKT 1.
struct NamedParameter {
  Parameter parameter;
  const char* name;
};

constexpr NamedParameter kOriginLatitude{Parameter::latitude, "latitude_of_origin"};
constexpr NamedParameter kMeridian{Parameter::longitude, "central_meridian"};
constexpr NamedParameter kCentreLatitude{Parameter::latitude, "latitude_of_center"};
constexpr NamedParameter kCentreLongitude{Parameter::longitude, "longitude_of_center"};
constexpr NamedParameter kParallel1{Parameter::parallel_1, "standard_parallel_1"};
constexpr NamedParameter kParallel2{Parameter::parallel_2, "standard_parallel_2"};
constexpr NamedParameter kScale{Parameter::scale, "scale_factor"};
constexpr NamedParameter kAzimuth{Parameter::azimuth, "azimuth"};
constexpr NamedParameter kRectified{Parameter::rectified_angle, "rectified_grid_angle"};

/// A method by its code of key 3075 (GeoTIFF 1.1, Annex C.3).
struct Method {
  std::uint16_t code;
  const char* name;  ///< in WKT 1
  std::initializer_list<NamedParameter> parameters;
};

constexpr std::uint16_t kMercatorCode = 7;
const Method kMercatorOfParallel = {kMercatorCode, "Mercator_2SP", {kParallel1, kMeridian}};
const Method kMethods[] = {
    {1, "Transverse_Mercator", {kOriginLatitude, kMeridian, kScale}},
    {3,
     "Hotine_Oblique_Mercator",
     {kCentreLatitude, kCentreLongitude, kAzimuth, kRectified, kScale}},
    {kMercatorCode, "Mercator_1SP", {kOriginLatitude, kMeridian, kScale}},
    {8, "Lambert_Conformal_Conic_2SP", {kParallel1, kParallel2, kOriginLatitude, kMeridian}},
    {9, "Lambert_Conformal_Conic_1SP", {kOriginLatitude, kMeridian, kScale}},
    {10, "Lambert_Azimuthal_Equal_Area", {kCentreLatitude, kCentreLongitude}},
    {11, "Albers_Conic_Equal_Area", {kParallel1, kParallel2, kCentreLatitude, kCentreLongitude}},
    {12, "Azimuthal_Equidistant", {kCentreLatitude, kCentreLongitude}},
    {13, "Equidistant_Conic", {kParallel1, kParallel2, kCentreLatitude, kCentreLongitude}},
    {14, "Stereographic", {kOriginLatitude, kMeridian, kScale}},
    {15, "Polar_Stereographic", {kOriginLatitude, kMeridian, kScale}},
    {16, "Oblique_Stereographic", {kOriginLatitude, kMeridian, kScale}},
    {18, "Cassini_Soldner", {kOriginLatitude, kMeridian}},
    {22, "Polyconic", {kOriginLatitude, kMeridian}},
    {26, "New_Zealand_Map_Grid", {kOriginLatitude, kMeridian}},
    {27, "Transverse_Mercator_South_Orientated", {kOriginLatitude, kMeridian, kScale}},
    {28, "Cylindrical_Equal_Area", {kParallel1, kMeridian}},
    {9815,
     "Hotine_Oblique_Mercator_Azimuth_Center",
     {kCentreLatitude, kCentreLongitude, kAzimuth, kRectified, kScale}},
};

std::optional<double> firstOf(const GeoKeyDirectory& keys,
                              std::initializer_list<std::uint16_t> candidates) {
  for (const std::uint16_t key : candidates)
    if (const auto value = keys.number(key)) return value;
  return std::nullopt;
}

/// The value of a parameter; none where no key states it.
std::optional<double> valueOf(const GeoKeyDirectory& keys, Parameter parameter) {
  switch (parameter) {
    case Parameter::latitude:  // natural origin, false origin, centre
      return firstOf(keys, {3081, 3085, 3089});
    case Parameter::longitude:  // and the meridian that is straight from the pole
      return firstOf(keys, {3080, 3084, 3088, 3095});
    case Parameter::parallel_1:
      return keys.number(3078);
    case Parameter::parallel_2:
      return keys.number(3079);
    case Parameter::scale:  // at the natural origin, at the centre
      return firstOf(keys, {3092, 3093});
    case Parameter::azimuth:
      return keys.number(3094);
    case Parameter::rectified_angle:
      break;
  }
  return firstOf(keys, {3096, 3094});
}

std::string exact(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// A geographic CRS of its own, on the ellipsoid whose axes the keys state.
std::string geographicOfAxes(const GeoKeyDirectory& keys) {
  const auto major = keys.number(geo_key::kSemiMajorAxis);
  if (!major || !(*major > 0.0)) return {};
  double inverse = keys.number(geo_key::kInverseFlattening).value_or(0.0);
  const double minor = keys.number(geo_key::kSemiMinorAxis).value_or(*major);
  if (inverse == 0.0 && minor != *major) inverse = *major / (*major - minor);
  const double meridian = keys.number(geo_key::kPrimeMeridianLongitude).value_or(0.0);
  return "GEOGCS[\"unknown\",DATUM[\"unknown\",SPHEROID[\"unknown\"," + exact(*major) + "," +
         exact(inverse) + "]],PRIMEM[\"" + (meridian == 0.0 ? "Greenwich" : "unknown") + "\"," +
         exact(meridian) + "],UNIT[\"degree\",0.0174532925199433]]";
}

/// WKT of the geographic CRS: by its code, by that of its datum or ellipsoid, or by the axes.
std::string geographicOf(const GeoKeyDirectory& keys) {
  const auto ofCode = [](unsigned code) {
    const std::string crs = "EPSG:" + std::to_string(code);
    return describeCrs(crs).kind == CrsKind::geographic ? crsAsWkt(crs) : std::string();
  };
  constexpr unsigned kDatumAboveCrs = 2000,
                     kEllipsoidAboveCrs = 3000;  // 6152 and 4152, 7030 and 4030
  const unsigned code = keys.code(geo_key::kGeographic), datum = keys.code(geo_key::kDatum);
  std::string wkt;
  if (code != 0 && code != kUserDefinedKey) wkt = ofCode(code);
  if (wkt.empty() && datum > kDatumAboveCrs && datum != kUserDefinedKey)
    wkt = ofCode(datum - kDatumAboveCrs);
  if (wkt.empty()) wkt = geographicOfAxes(keys);
  const unsigned ellipsoid = keys.code(geo_key::kEllipsoid);
  if (wkt.empty() && ellipsoid > kEllipsoidAboveCrs && ellipsoid != kUserDefinedKey)
    wkt = ofCode(ellipsoid - kEllipsoidAboveCrs);
  return wkt;
}

/// Radians of the unit in which the parameters are stated.
double angularUnit(const GeoKeyDirectory& keys) {
  constexpr std::uint16_t kRadian = 9101, kGrad = 9105, kGon = 9106;
  const std::uint16_t code = keys.code(geo_key::kAngularUnit);
  if (code == kRadian) return 1.0;
  if (code == kGrad || code == kGon) return kPi / 200.0;
  const auto size = keys.number(geo_key::kAngularUnitSize);
  if (code == kUserDefinedKey && size && *size > 0.0) return *size;
  return kRadiansPerDegree;
}

/// Radians of the unit of a geographic CRS, in which WKT 1 has the angles of the projection.
double angularUnit(const std::string& geographic) {
  const std::size_t unit = geographic.rfind("UNIT["), comma = geographic.find("\",", unit);
  if (unit == std::string::npos || comma == std::string::npos) return kRadiansPerDegree;
  const double radians = std::strtod(geographic.c_str() + comma + 2, nullptr);
  return radians > 0.0 ? radians : kRadiansPerDegree;
}

const Method* methodOf(const GeoKeyDirectory& keys) {
  const std::uint16_t code = keys.code(geo_key::kMethod);
  if (code == kMercatorCode && keys.number(3078) && !firstOf(keys, {3092}))
    return &kMercatorOfParallel;
  for (const Method& method : kMethods)
    if (method.code == code) return &method;
  return nullptr;
}

}  // namespace

std::string userDefinedProjection(const GeoKeyDirectory& keys, const LengthUnit& unit) {
  const std::string geographic = geographicOf(keys);
  if (geographic.empty()) return {};
  const unsigned projection = keys.code(geo_key::kProjection);
  if (projection != 0 && projection != kUserDefinedKey)
    return projectedCrs(geographic, projection, unit);
  const Method* method = methodOf(keys);
  if (method == nullptr) return {};
  const double per_unit = angularUnit(keys) / angularUnit(geographic);
  std::string text = "PROJCS[\"unknown\"," + geographic + ",PROJECTION[\"" + method->name + "\"]";
  const auto add = [&text](const char* name, double value) {
    text.append(",PARAMETER[\"").append(name).append("\"," + exact(value) + "]");
  };
  for (const auto& [parameter, name] : method->parameters) {
    const bool is_scale = parameter == Parameter::scale;
    const double value = valueOf(keys, parameter).value_or(is_scale ? 1.0 : 0.0);
    add(name, is_scale ? value : value * per_unit);
  }
  add("false_easting", firstOf(keys, {3082, 3086, 3090}).value_or(0.0));
  add("false_northing", firstOf(keys, {3083, 3087, 3091}).value_or(0.0));
  return text + ",UNIT[\"" + unit.name + "\"," + exact(unit.metres) + "]]";
}

}  // namespace pcl_als::detail
