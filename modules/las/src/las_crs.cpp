// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "las_crs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/crs/crs.h>

#include "geo_keys.h"
#include "las_bytes.h"

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

/// The first WKT record that can be used, as an empty one may stand before it.
StatedCrs wktOf(const LasFile& file) {
  StatedCrs stated;
  for (const LasVlrEntry& vlr : file.vlrs()) {
    if (vlr.user_id != kProjection || vlr.record_id != kWktRecord) continue;
    const std::vector<std::byte> bytes = file.payload(vlr, kLargestRecord);
    std::string wkt = textField(bytes.data(), bytes.size());
    while (!wkt.empty() && std::isspace(static_cast<unsigned char>(wkt.back())) != 0)
      wkt.pop_back();
    stated = usableCrs(wkt);
    if (!stated.crs.empty()) break;
  }
  return stated;
}

GeoKeys geoKeysOf(const LasFile& file) {
  const LasVlrEntry* directory = findRecord(file, kGeoKeyRecord);
  if (directory == nullptr) return {};
  const LasVlrEntry* doubles = findRecord(file, kGeoDoublesRecord);
  return readGeoKeys(
      file.payload(*directory, kLargestRecord),
      doubles == nullptr ? std::vector<std::byte>() : file.payload(*doubles, kLargestRecord));
}

LasReference referenceOfText(const std::string& wkt) {
  LasReference reference;
  reference.crs = wkt;
  reference.by_wkt = true;
  reference.kind = describeCrs(wkt).kind;
  reference.units = unitsOfCrs(wkt, "WKT");
  return reference;
}

/// The horizontal unit that keys state stands above the one that the CRS implies.
void setHorizontal(const StatedUnit& stated, LasReference& reference) {
  LinearUnits& units = reference.units;
  const LinearUnits implied = units;
  units.horizontal = stated.unit;
  units.source = stated.source;
  if (implied.known() && implied.horizontal.metres == stated.unit.metres) return;
  if (reference.crs.empty()) {
    if (!stated.unit.isMetre()) reference.crs = localCrs(stated.unit);
    return;
  }
  if (!implied.known()) return;
  units.source += "; " + reference.crs + " by itself counts in " + implied.horizontal.name;
  const std::string altered = crsInUnit(reference.crs, stated.unit);
  if (!altered.empty()) reference.crs = altered;
}

/// The vertical unit: that of the keys, else that of the CRS, else the horizontal one.
void setVertical(const GeoKeys& keys, LasReference& reference) {
  LinearUnits& units = reference.units;
  if (keys.vertical) {
    units.vertical = keys.vertical->unit;
    units.vertical_source = keys.vertical->source;
  } else if (!units.verticalKnown()) {
    units.vertical = units.horizontal;
  }
}

LasReference referenceOfKeys(const GeoKeys& keys) {
  LasReference reference;
  StatedCrs stated = usableCrs(keys.crs);
  reference.crs = std::move(stated.crs);
  reference.ignored = std::move(stated.ignored);
  reference.kind = keys.kind;
  if (keys.unknown) reference.ignored = "the definition in its GeoTIFF keys is not known";
  // A code says more than the model type beside it.
  const CrsKind kind = describeCrs(reference.crs).kind;
  if (kind != CrsKind::unknown) reference.kind = kind;
  if (reference.kind == CrsKind::geographic || reference.kind == CrsKind::geocentric)
    return reference;
  reference.units = unitsOfCrs(reference.crs);
  if (keys.horizontal) setHorizontal(*keys.horizontal, reference);
  setVertical(keys, reference);
  return reference;
}

/// The box of the first and last points in the unit of the file; that of the header where they
/// cannot be read.
Eigen::AlignedBox3d boxOfSomePoints(const LasFile& file) {
  const LasHeader& h = file.header();
  const Eigen::AlignedBox3d stated(h.minimum, h.maximum);
  const std::size_t length = h.record_length;
  const auto count = std::min<std::uint64_t>(h.point_count / 2 + 1, 256);
  std::vector<std::byte> records(2 * count * length);
  if (h.point_count == 0) return stated;
  try {
    file.readRanges({{0, count}, {h.point_count - count, count}}, records.data());
  } catch (const InputError&) {
    return stated;  // damaged points are refused where they are needed
  }
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < 2 * count; ++i) {
    Eigen::Vector3d raw;
    for (int axis = 0; axis < 3; ++axis)
      raw[axis] = loadLas<std::int32_t>(&records[i * length + 4 * static_cast<std::size_t>(axis)]);
    box.extend(Eigen::Vector3d(raw.cwiseProduct(h.scale) + h.offset));
  }
  return box;
}

/// By the points, because the box in the header may be wrong. Longitudes may run to 360 degrees.
bool mayBeDegrees(const LasFile& file) {
  const Eigen::AlignedBox3d box = boxOfSomePoints(file);
  return box.min().x() >= -360.0 && box.max().x() <= 360.0 && box.min().y() >= -90.0 &&
         box.max().y() <= 90.0;
}

/// Whether the points lie near the ellipsoid, seen from the centre of the Earth.
bool mayBeGeocentric(const LasFile& file) {
  constexpr double kEquator = 6378137.0, kFlattening = 1.0 / 298.257;  // metres
  constexpr double kMaximumHeight = 2e4;  // metres: mountains, and areas of some hundred kilometres
  const Eigen::Vector3d centre = boxOfSomePoints(file).center();
  const double distance = centre.norm(), sine = centre.z() / distance;
  return std::abs(distance - kEquator * (1.0 - kFlattening * sine * sine)) < kMaximumHeight;
}

/// Coordinates in steps of a micrometre with heights in steps of a millimetre are no lengths.
bool hasStepsOfDegrees(const LasHeader& h) {
  constexpr double kLargestStep = 1e-6, kLeastRatio = 1e3;
  const Eigen::Vector3d steps = h.scale.cwiseAbs();
  const double step = std::max(steps.x(), steps.y());
  return step <= kLargestStep && steps.z() >= kLeastRatio * step;
}

/// The records that the encoding does not prefer may tell what the others leave open.
LasReference referenceOfWkt(const std::string& wkt, const GeoKeys& keys) {
  LasReference reference = referenceOfText(wkt);
  if (reference.kind == CrsKind::unknown && (!keys.crs.empty() || keys.horizontal)) {
    const LasReference by_keys = referenceOfKeys(keys);
    reference.kind = by_keys.kind;
    reference.units = by_keys.units;
  }
  if (!reference.units.verticalKnown()) setVertical(keys, reference);
  if (keys.horizontal && reference.units.known() &&
      keys.horizontal->unit.metres != reference.units.horizontal.metres)
    reference.units.source +=
        "; " + keys.horizontal->source + " states " + keys.horizontal->unit.name + ", not used";
  return reference;
}

/// A CRS that the coordinates contradict is not used.
void checkCoordinates(const LasFile& file, LasReference& reference) {
  const bool degrees = reference.kind == CrsKind::geographic && !mayBeDegrees(file);
  if (degrees || (reference.kind == CrsKind::geocentric && !mayBeGeocentric(file))) {
    const std::string stated =
        reference.crs.empty() ? "the CRS of its GeoTIFF keys" : shortCrsName(reference.crs);
    reference = LasReference();
    reference.ignored =
        stated + (degrees ? " is in degrees, which the coordinates cannot be"
                          : " is geocentric, but the points are not at the surface of the Earth");
  } else if (reference.kind == CrsKind::unknown && !reference.units.known() &&
             hasStepsOfDegrees(file.header()) && mayBeDegrees(file)) {
    reference.kind = CrsKind::geographic;
  }
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

}  // namespace

LasReference readLasReference(const LasFile& file) {
  const bool prefers_wkt = (file.header().global_encoding & kLasWkt) != 0;
  const StatedCrs wkt = wktOf(file);
  const GeoKeys keys = geoKeysOf(file);
  const bool has_keys = !usableCrs(keys.crs).crs.empty();
  const bool by_wkt = !wkt.crs.empty() && (prefers_wkt || !has_keys);
  LasReference reference = by_wkt ? referenceOfWkt(wkt.crs, keys) : referenceOfKeys(keys);
  if (!by_wkt && reference.crs.empty() && !wkt.ignored.empty()) reference.ignored = wkt.ignored;
  checkCoordinates(file, reference);
  const bool has_other = by_wkt ? has_keys : !wkt.crs.empty();
  if (!reference.crs.empty() || reference.ignored.empty() || !has_other) return reference;
  // The coordinates contradict what the encoding prefers: the other record may be right.
  LasReference other = by_wkt ? referenceOfKeys(keys) : referenceOfWkt(wkt.crs, keys);
  checkCoordinates(file, other);
  if (other.crs.empty()) return reference;
  other.ignored = std::move(reference.ignored);
  return other;
}

std::vector<LasVlr> lasCrsRecords(const std::string& crs, bool wkt_wanted) {
  if (crs.empty()) return {};
  if (!isEpsg(crs)) return {wktRecord(crs)};
  const unsigned long code = std::stoul(crs.substr(5, 6));
  if (wkt_wanted || code > kMostGeoCode) {
    const std::string wkt = crsAsWkt(crs);
    if (!wkt.empty()) return {wktRecord(wkt)};
  }
  if (code > kMostGeoCode)
    throw UsageError("CRS " + crs + ": GeoTIFF keys hold codes up to 32766; give it as WKT");
  return {{kProjection, kGeoKeyRecord, "GeoTIFF GeoKeyDirectoryTag",
           geoKeysOfEpsg(static_cast<unsigned>(code))}};
}

}  // namespace pcl_als::detail
