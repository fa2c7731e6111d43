// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/point_file_info.h>

namespace pcl_als {

/// A coordinate reference system as PROJ describes it.
struct CrsDescription {
  CrsKind kind = CrsKind::unknown;
  std::string name;                      ///< "NAD83 / California zone 3 (ftUS)"
  std::optional<LengthUnit> horizontal;  ///< of a projected or local system
  std::optional<LengthUnit> vertical;    ///< where the system has a vertical axis
};

/** \brief Describes a CRS: "EPSG:n", "EPSG:n+m", WKT 1 or 2 (of ESRI, too), anything PROJ accepts.
 *
 * The horizontal and the vertical part of a compound system are described separately. A text that
 * PROJ does not know, or any text in a build without PROJ, is of kind unknown. Descriptions are
 * kept: PROJ takes milliseconds for one.
 */
CrsDescription describeCrs(const std::string& crs);

/** \brief The units that a CRS states; one without a vertical axis takes the horizontal unit for
 * heights. A CRS that states none counts in metres.
 *
 * \param source what states the units, for messages; default: the CRS itself
 */
LinearUnits unitsOfCrs(const std::string& crs, const std::string& source = {});

/** \brief The same horizontal CRS with axes that count in another unit, as WKT; empty where PROJ
 * cannot tell.
 *
 * For files that name a CRS in metres and state beside it that their coordinates are in feet.
 */
std::string crsInUnit(const std::string& crs, const LengthUnit& unit);

/// A CRS without its vertical part: of a compound one the horizontal part as WKT, any other text as
/// it is.
std::string horizontalCrs(const std::string& crs);

/// WKT of a local system of which nothing but the unit is known.
std::string localCrs(const LengthUnit& unit);

/** \brief Whether coordinates of both, brought to metres, are coordinates of one system.
 *
 * The same projection in feet and in metres (EPSG:2271 and EPSG:32128) is one system; vertical
 * parts are not compared. Without PROJ, texts are compared.
 */
bool sameGroundFrame(const std::string& a, const std::string& b);

/** \brief Whether two map projections, however they are described, give different coordinates to a
 * place: by more than one metre.
 *
 * For descriptions without a common code: WKT of several dialects, with or without names of the
 * datum, an axis order or a shift to WGS 84, may be of one system. Differences between realisations
 * of a datum are below a metre, and are not always known to PROJ. False where either text is not
 * known to PROJ or no map projection, and in a build without PROJ.
 *
 * \param place coordinates in both systems, metres
 */
bool coordinatesDiffer(const std::string& a, const std::string& b, const Eigen::Vector2d& place);

/** \brief Refuses a CRS that PROJ does not know, or that is not projected, with a UsageError:
 * "WHAT: …". A build without PROJ accepts every text.
 *
 * \param what the option or field that gives it
 */
void requireProjectedCrs(const std::string& crs, const std::string& what);

/// InputError with the hint for a file whose coordinates are degrees or geocentric.
void requireMapCoordinates(const PointFileInfo& info);

/** \brief A CRS as WKT 1 of one line; empty in a build without PROJ. UsageError for a text that
 * PROJ does not know.
 */
std::string crsAsWkt(const std::string& crs);

/** \brief WKT 1 of a projected CRS from a geographic one (WKT) and the EPSG code of a projection
 * (16031: UTM zone 31N), with axes in that unit; empty where PROJ does not know them, and in a
 * build without PROJ.
 */
std::string projectedCrs(const std::string& geographic, unsigned projection,
                         const LengthUnit& unit);

/// The CRS that a file states, where it can be used.
struct StatedCrs {
  std::string crs;      ///< empty where none can be used
  std::string ignored;  ///< what is stated and why it is not used; empty otherwise
};

/// A text without a letter or digit states no CRS, and an EPSG code that PROJ does not know none
/// that can be used. Other texts are kept, also those that PROJ does not know.
StatedCrs usableCrs(const std::string& stated);

/// The unit of an EPSG code of units of length (9001 is the metre); without PROJ those of metre,
/// foot and US survey foot.
std::optional<LengthUnit> unitOfEpsgCode(unsigned code);

/// The CRS as it appears in messages: of a long WKT, the beginning.
std::string shortCrsName(const std::string& crs);

}  // namespace pcl_als
