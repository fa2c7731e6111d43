// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Geodetic WGS 84 (ITRF) positions to a projected CRS, with PROJ.
 *
 * The result is in metres, whatever unit the CRS counts in.
 *
 * InputError when PROJ does not know the CRS, when it is not a projected one, or when its heights
 * need a geoid grid that is not installed. In a build without PROJ every construction is an
 * InputError that says so. An object is used by one thread at a time.
 */
class MapProjection {
 public:
  explicit MapProjection(const std::string& crs);  ///< anything PROJ accepts: EPSG:…, WKT
  ~MapProjection();
  MapProjection(const MapProjection&) = delete;
  MapProjection& operator=(const MapProjection&) = delete;

  struct Result {
    Eigen::Vector3d position;  ///< east, north, up; metres; not finite where PROJ has no answer
    double north_azimuth;      ///< of true north, clockwise from grid north, radians: minus the
                               ///< meridian convergence; grid heading = true heading + this
  };
  /// Latitude and longitude in radians, ellipsoidal height in metres.
  Result project(double latitude, double longitude, double height) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
