// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/linear_units.h>

#include "geo_key_directory.h"

namespace pcl_als::detail {

/** \brief WKT of a projected CRS whose keys are user-defined: from its projection (key 3074), or
 * from its method and parameters (keys 3075 to 3096); empty where these define none.
 *
 * The geographic CRS is that of key 2048, of the datum (key 2050), or of the axes of the ellipsoid.
 * Parameters are searched under all keys with the same meaning (natural, false and projection
 * origin), because writers differ. Angles are in the unit of key 2054, lengths in \a unit.
 * Source: GeoTIFF 1.1, 7.4 and Annex C.
 */
std::string userDefinedProjection(const GeoKeyDirectory& keys, const LengthUnit& unit);

}  // namespace pcl_als::detail
