// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/orthographic_camera.h>

namespace pcl_als {

/** \brief Keeps for each pixel the point nearest to the camera; of equally near points the first.
 *
 * A picture therefore needs memory for its pixels (24 bytes each) and not for its points, and does
 * not depend on the division of the points into chunks. Points whose coordinates are not finite or
 * outside the picture are counted and excluded.
 */
class PixelThinning {
 public:
  struct Shown {
    Eigen::Vector3f position;  ///< relative to the camera's centre, metres
    float depth = -std::numeric_limits<float>::infinity();  ///< metres towards the camera
    float value = 0.0F;  ///< value by which the point is coloured; NaN: none
    bool used() const { return depth > -std::numeric_limits<float>::infinity(); }
  };

  explicit PixelThinning(const OrthographicCamera& camera);

  void add(const Eigen::Vector3d& ground, float value);

  const OrthographicCamera& camera() const { return camera_; }
  const std::vector<Shown>& pixels() const { return pixels_; }  ///< row by row from the upper left
  std::size_t seen() const { return seen_; }                    ///< points inside the picture
  std::size_t outside() const { return outside_; }              ///< finite ones that are not
  std::size_t invalid() const { return invalid_; }              ///< not finite
  std::size_t shown() const;                                    ///< pixels with a point

 private:
  OrthographicCamera camera_;
  std::vector<Shown> pixels_;
  std::size_t seen_ = 0, outside_ = 0, invalid_ = 0;
};

/// Brightness of each pixel (0 … 1, 1 where there is no point) by eye-dome lighting: a point is
/// darker the further its neighbours up to \a radius pixels away are in front of it, in units of
/// pixels.
std::vector<float> eyeDomeShade(const PixelThinning& points, int radius, double strength = 1.0);

/// Brightness by hillshade: light from the upper left at 45 degrees, slopes from the nearest pixels
/// with points in the four directions.
std::vector<float> hillShade(const PixelThinning& points, int radius);

}  // namespace pcl_als
