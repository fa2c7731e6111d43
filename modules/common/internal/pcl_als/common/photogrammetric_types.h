// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace pcl_als {

/** \brief Interior orientation of a frame camera with the distortion of Brown (1971).
 *
 * Image frame: origin in the middle of the image, x to the right, y up, z towards the sensor, mm;
 * the scene is at negative z. With (x, y) the measured coordinates minus the principal point and
 * r^2 = x^2 + y^2, the distortion that is subtracted is
 *   dx = x (k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 x^2) + 2 p2 x y,
 *   dy = y (k1 r^2 + k2 r^4 + k3 r^6) + p2 (r^2 + 2 y^2) + 2 p1 x y.
 */
struct FrameCamera {
  std::string name;
  double focal_length = 0.0;                                  ///< mm, > 0
  Eigen::Vector2d principal_point = Eigen::Vector2d::Zero();  ///< mm
  Eigen::Vector2d format = Eigen::Vector2d::Zero();           ///< width, height, mm
  std::array<double, 3> radial{};      ///< k1 (mm^-2), k2 (mm^-4), k3 (mm^-6)
  std::array<double, 2> tangential{};  ///< p1, p2 (mm^-1)
  /// Side of a pixel, mm. Above 0 files give coordinates in pixels (column to the right and row
  /// downwards from the upper left corner of the image), else in mm in the image frame.
  double pixel_size = 0.0;

  double unit() const { return pixel_size > 0.0 ? pixel_size : 1.0; }  ///< mm per unit of files
  const char* unitName() const { return pixel_size > 0.0 ? "px" : "mm"; }
  /// mm in the image frame, from the coordinates of a file, and back.
  Eigen::Vector2d fromFile(const Eigen::Vector2d& given) const {
    if (pixel_size <= 0.0) return given;
    return {given.x() * pixel_size - 0.5 * format.x(), 0.5 * format.y() - given.y() * pixel_size};
  }
  Eigen::Vector2d toFile(const Eigen::Vector2d& mm) const {
    if (pixel_size <= 0.0) return mm;
    return {(mm.x() + 0.5 * format.x()) / pixel_size, (0.5 * format.y() - mm.y()) / pixel_size};
  }
  /// Measured coordinates (mm) without principal point and distortion.
  Eigen::Vector2d reduced(const Eigen::Vector2d& measured) const {
    const Eigen::Vector2d p = measured - principal_point;
    const double r2 = p.squaredNorm();
    const double scale = r2 * (radial[0] + r2 * (radial[1] + r2 * radial[2]));
    const double xy = 2.0 * p.x() * p.y();
    const Eigen::Vector2d decentred(
        tangential[0] * (r2 + 2.0 * p.x() * p.x()) + tangential[1] * xy,
        tangential[1] * (r2 + 2.0 * p.y() * p.y()) + tangential[0] * xy);
    return p - scale * p - decentred;
  }
};

/// Exterior orientation of an image: perspective centre (metres, ground frame) and the angles
/// omega, phi, kappa (radians) of ground_from_image = Rx(omega) Ry(phi) Rz(kappa).
struct ImageOrientation {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();
  /// Standard deviations of position (metres) and angles (radians) where GNSS/INS gives them; 0:
  /// approximate values.
  double position_sigma = 0.0, angle_sigma = 0.0;
};

/// A place measured in an image: the image of a point, or any place on the image of a line.
struct ImageMeasurement {
  enum class Kind { point, line };
  std::string image, feature;  ///< ids
  Kind kind = Kind::point;
  Eigen::Vector2d position = Eigen::Vector2d::Zero();  ///< mm, image frame
  double sigma = 0.0;                                  ///< mm, of each coordinate
};

/// Horizontal unit vector to the left of a direction that is not vertical, and the one upwards
/// across both, as columns (3x2).
inline Eigen::Matrix<double, 3, 2> acrossLine(const Eigen::Vector3d& direction) {
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = Eigen::Vector3d(-direction.y(), direction.x(), 0.0).normalized();
  across.col(1) = direction.normalized().cross(across.col(0));
  return across;
}

/** \brief A straight line of the ground between two places.
 *
 * The places bound the part that was seen and are no identifiable points: the line is known across
 * its direction only, by the columns of acrossLine(end - start).
 */
struct ObjectLine {
  enum class Kind { ridge, valley, eave, unknown };
  std::string id;
  Kind kind = Kind::unknown;
  Eigen::Vector3d start = Eigen::Vector3d::Zero(), end = Eigen::Vector3d::Zero();  ///< metres
  /// Covariance (m^2) of the offsets of start to the left and upwards, then of end.
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  std::vector<std::string> strips;  ///< in which it was seen

  double length() const { return (end - start).norm(); }
};

}  // namespace pcl_als
