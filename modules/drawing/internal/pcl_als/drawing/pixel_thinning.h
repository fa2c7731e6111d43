// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// Extent shown by a camera: limits to the right, up and towards it, metres from a reference.
struct ViewExtent {
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());
  bool empty() const { return !(low.x() <= high.x()); }
};

/** \brief An orthographic camera: metres have the same length all over the picture.
 *
 * azimuth: the viewing direction, degrees clockwise from grid north; elevation: height of the
 * camera above the horizon, degrees; 90 views straight down, with the azimuth at the upper edge.
 */
class OrthographicCamera {
 public:
  /// UsageError for an elevation outside [0, 90] or an azimuth that is no number.
  explicit OrthographicCamera(double azimuth_deg = 0.0, double elevation_deg = 90.0);

  /// Fills a picture of width x height pixels with what a box of the ground frame shows, enlarged
  /// by \a zoom about its middle; a box without extent is given one metre. UsageError unless zoom
  /// is finite and positive.
  void frame(const Eigen::Vector3d& minimum, const Eigen::Vector3d& maximum, int width, int height,
             double zoom = 1.0);

  /// The same for the points that were added to an extent, which suits oblique views better.
  void frame(const ViewExtent& extent, int width, int height, double zoom = 1.0);
  /// Extends the extent by a ground point, if it is finite.
  void add(const Eigen::Vector3d& ground, ViewExtent& extent) const;

  double azimuth() const { return azimuth_; }
  double elevation() const { return elevation_; }
  bool isTopView() const { return elevation_ == 90.0 && azimuth_ == 0.0; }
  int width() const { return width_; }
  int height() const { return height_; }
  double metresPerPixel() const { return metres_per_pixel_; }
  const Eigen::Vector3d& center() const { return center_; }
  const Eigen::Vector3d& right() const { return right_; }
  const Eigen::Vector3d& up() const { return up_; }
  const Eigen::Vector3d& toCamera() const { return to_camera_; }

  /// Pixel coordinates (x right, y down from the upper left corner) and metres towards the camera.
  Eigen::Vector3d project(const Eigen::Vector3d& ground) const {
    const Eigen::Vector3d offset = ground - center_;
    return {0.5 * width_ + right_.dot(offset) / metres_per_pixel_,
            0.5 * height_ - up_.dot(offset) / metres_per_pixel_, to_camera_.dot(offset)};
  }

 private:
  double azimuth_, elevation_;
  int width_ = 1, height_ = 1;
  double metres_per_pixel_ = 1.0;
  Eigen::Vector3d center_ = Eigen::Vector3d::Zero(), right_, up_, to_camera_;
};

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
