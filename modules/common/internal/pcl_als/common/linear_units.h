// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>

namespace pcl_als {

/// A unit of length and how long it is.
struct LengthUnit {
  std::string name = "metre";  ///< as the EPSG dataset calls it: "metre", "foot", "US survey foot"
  double metres = 1.0;         ///< length of one unit, metres, > 0

  bool isMetre() const { return metres == 1.0; }
};

/** \brief The unit of that length.
 *
 * Files store the length of a foot with 7 to 17 digits. A length that agrees with the metre, the
 * international foot (0.3048 m, EPSG:9002) or the US survey foot (12/39.37 m, EPSG:9003) to 5e-7,
 * a quarter of the difference between the two feet, is taken to be exactly that unit, so that two
 * files of one block are not 3 cm apart at 1000 km for the digits of their units. Any other length
 * keeps \a name; without a name it is called by its length.
 */
LengthUnit lengthUnitOf(double metres, const std::string& name = {});

/// "m", "ft" (international foot) or "us_ft" (US survey foot), as options name them; UsageError
/// "WHAT: …" for any other text.
LengthUnit lengthUnitNamed(const std::string& text, const std::string& what);

/** \brief The units that the coordinates of a point file count in.
 *
 * All computation and every report is in metres: coordinates are multiplied by metres() as they are
 * read and divided by it as they are written.
 */
struct LinearUnits {
  LengthUnit horizontal;  ///< of x and y
  LengthUnit vertical;    ///< of z
  std::string source;     ///< what states the horizontal unit; empty: metres are assumed
  std::string
      vertical_source;  ///< what states the vertical unit; empty: the horizontal one is taken

  bool known() const { return !source.empty(); }
  bool verticalKnown() const { return !vertical_source.empty(); }
  bool metric() const { return horizontal.isMetre() && vertical.isMetre(); }
  /// Length of one unit of x, y and z, metres.
  Eigen::Vector3d metres() const { return {horizontal.metres, horizontal.metres, vertical.metres}; }
};

}  // namespace pcl_als
