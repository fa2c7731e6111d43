// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <Eigen/Core>

namespace pcl_als {

/** \brief The double-precision origin to which the coordinates of a float cloud are relative, and
 * its CRS.
 *
 * ground = origin + local. A float of a cloud at UTM northing 5 200 000 m has steps of half a
 * metre; relative to an origin at most 4 km away they are under 0.25 mm. Axes are parallel to the
 * ground frame (east, north, up; metres).
 *
 * An origin made by around() is a multiple of 10 m. Such a value survives PCL's VIEWPOINT field
 * (floats, printed with six digits by pcl::PCDWriter) exactly for |coordinate| < 10 000 km, which
 * is how a PCD file keeps its frame.
 */
struct LocalFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< metres, ground frame
  /// WKT or "EPSG:…"; empty when unknown. The frame has the axes of this CRS and is in metres, even
  /// if the unit of the CRS is another one.
  std::string crs;

  /// Largest distance of points from the origin in plan, metres; loadStrips() divides strips that
  /// extend further.
  static constexpr double kMaximumExtent = 4000.0;

  /// A frame whose origin is the multiple of 10 m nearest to a ground point.
  static LocalFrame around(const Eigen::Vector3d& ground, std::string crs = {});

  Eigen::Vector3d toGround(const Eigen::Vector3f& local) const {
    return origin + local.cast<double>();
  }
  Eigen::Vector3f toLocal(const Eigen::Vector3d& ground) const {
    return (ground - origin).cast<float>();
  }
};

}  // namespace pcl_als
