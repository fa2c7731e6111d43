// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>

#include <Eigen/Core>

namespace pcl_als::photogrammetry {

/// ground_from_image = Rx(omega) Ry(phi) Rz(kappa), 3x3, of three angles in radians.
template <typename T>
Eigen::Matrix<T, 3, 3> groundFromImage(const T* angles) {
  using std::cos;
  using std::sin;
  const T co = cos(angles[0]), so = sin(angles[0]), cp = cos(angles[1]), sp = sin(angles[1]),
          ck = cos(angles[2]), sk = sin(angles[2]);
  Eigen::Matrix<T, 3, 3> r;
  r << cp * ck, -cp * sk, sp,                                    //
      co * sk + so * sp * ck, co * ck - so * sp * sk, -so * cp,  //
      so * sk - co * sp * ck, so * ck + co * sp * sk, co * cp;
  return r;
}

/// A ground point in the frame of an image, metres. \a image: position (3) and angles (3).
template <typename T>
Eigen::Matrix<T, 3, 1> inImage(const T* image, const Eigen::Matrix<T, 3, 1>& ground) {
  const Eigen::Matrix<T, 3, 1> from(ground[0] - image[0], ground[1] - image[1],
                                    ground[2] - image[2]);
  return groundFromImage(image + 3).transpose() * from;
}

/// Image coordinates (mm) of a point in the frame of the image, by collinearity.
template <typename T>
Eigen::Matrix<T, 2, 1> projected(const Eigen::Matrix<T, 3, 1>& point, double focal_length) {
  return {-focal_length * point[0] / point[2], -focal_length * point[1] / point[2]};
}

/// Normal in the frame of the image of the plane through the perspective centre and two points.
template <typename T>
Eigen::Matrix<T, 3, 1> planeOf(const Eigen::Matrix<T, 3, 1>& a, const Eigen::Matrix<T, 3, 1>& b) {
  return a.cross(b);
}

/// Distance (mm) of a reduced image place from the image of the line whose plane has the normal.
template <typename T>
T distanceFromLine(const Eigen::Matrix<T, 3, 1>& normal, const Eigen::Vector2d& place,
                   double focal_length) {
  using std::sqrt;
  const T length = sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
  return (normal[0] * place[0] + normal[1] * place[1] - normal[2] * focal_length) / length;
}

}  // namespace pcl_als::photogrammetry
