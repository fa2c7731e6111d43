// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Positions of another CRS, by default geodetic WGS 84 (ITRF), to a projected CRS, with
 * PROJ.
 *
 * The result is in metres, whatever unit the CRS counts in. Heights change only between systems
 * with a vertical part.
 *
 * InputError when PROJ does not know a CRS, when the target is not a projected one, when there is
 * no transformation between them, or when heights need a geoid grid that is not installed. In a
 * build without PROJ every construction is an InputError that says so. An object is used by one
 * thread at a time.
 */
class MapProjection {
 public:
  /// \a crs, \a source: anything PROJ accepts: EPSG:…, WKT. \a source: geographic, geocentric or
  /// projected; empty: WGS 84 with ellipsoidal heights (EPSG:4979)
  explicit MapProjection(const std::string& crs, const std::string& source = {});
  ~MapProjection();
  MapProjection(const MapProjection&) = delete;
  MapProjection& operator=(const MapProjection&) = delete;

  struct Result {
    Eigen::Vector3d position;  ///< east, north, up; metres; not finite where PROJ has no answer
    double north_azimuth;      ///< of the north of the source (true north, or that of its grid),
                               ///< clockwise from grid north, radians: for true north minus the
                               ///< meridian convergence; grid heading = heading + this
  };
  /// Latitude and longitude in radians, ellipsoidal height in metres.
  Result project(double latitude, double longitude, double height) const;
  /// A position of the source: latitude, longitude (radians) and height; X, Y, Z; or easting,
  /// northing and height (metres).
  Result project(const Eigen::Vector3d& position) const;
  /// Latitude and longitude in radians and height of a position of the CRS, metres, where the
  /// source is geographic.
  Eigen::Vector3d unproject(const Eigen::Vector3d& position) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Undulations of a geoid above the ellipsoid, from a grid that PROJ reads (.gtx, .tif). InputError
/// for another file, and in a build without PROJ.
class GeoidGrid {
 public:
  explicit GeoidGrid(const std::string& path);
  ~GeoidGrid();
  GeoidGrid(const GeoidGrid&) = delete;
  GeoidGrid& operator=(const GeoidGrid&) = delete;

  /// Metres; latitude and longitude in radians. Not finite outside the grid.
  double undulation(double latitude, double longitude) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
