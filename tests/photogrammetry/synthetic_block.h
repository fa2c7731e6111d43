// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/photogrammetry/image_block.h>

namespace pcl_als::test {

/// A block of vertical images over points and ridges, with its truth; by rotations of Eigen, not
/// by the equations under test.
struct SyntheticBlock {
  struct Options {
    int columns = 5, rows = 4, lines = 60, points = 160;
    double height = 1000.0, base = 220.0, spacing = 320.0;  ///< metres
    double image_sigma = 0.0;                               ///< mm, 0: exact
    double line_sigma = 0.0;                                ///< metres, 0: exact
    double direction_spread = M_PI;                    ///< radians, of the azimuths of the ridges
    double position_error = 2.0, angle_error = 0.002;  ///< of the approximate orientations
    Eigen::Vector3d origin{500000.0, 5400000.0, 200.0};
    unsigned seed = 1;
  };

  ImageBlock block;
  std::vector<ImageOrientation> images;  ///< truth
  std::vector<ObjectLine> lines;         ///< truth
  std::vector<Eigen::Vector3d> points;   ///< truth, P0 …

  explicit SyntheticBlock(const Options& options) : options_(options), random_(options.seed) {
    FrameCamera& camera = block.camera;
    camera.focal_length = 100.0;
    camera.format = {54.0, 40.0};
    for (int row = 0; row < options.rows; ++row)
      for (int column = 0; column < options.columns; ++column) addImage(column, row);
    for (int i = 0; i < options.lines; ++i) addLine(i);
    for (int i = 0; i < options.points; ++i) addPoint(i);
  }

  static Eigen::Matrix3d rotation(const Eigen::Vector3d& angles) {
    using Eigen::AngleAxisd;
    using Eigen::Vector3d;
    return (AngleAxisd(angles.x(), Vector3d::UnitX()) * AngleAxisd(angles.y(), Vector3d::UnitY()) *
            AngleAxisd(angles.z(), Vector3d::UnitZ()))
        .toRotationMatrix();
  }

  /// Image coordinates (mm) without errors.
  Eigen::Vector2d imageOf(const ImageOrientation& image, const Eigen::Vector3d& ground) const {
    const Eigen::Vector3d ray = rotation(image.angles).transpose() * (ground - image.position);
    return -block.camera.focal_length * ray.head<2>() / ray.z();
  }

  double normal() { return deviate_(random_); }
  double uniform(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0.0, 1.0)(random_);
  }

 private:
  static constexpr double kLeastSigma = 0.001;  ///< mm and metres, stated for exact values

  void addImage(int column, int row) {
    ImageOrientation image;
    image.id = "I" + std::to_string(images.size() + 1);
    image.position = options_.origin + Eigen::Vector3d(column * options_.spacing + 5.0 * normal(),
                                                       row * options_.base + 5.0 * normal(),
                                                       options_.height + 3.0 * normal());
    image.angles = {0.01 * normal(), 0.01 * normal(),
                    (column % 2 == 0 ? 0.0 : M_PI) + 0.02 * normal()};
    images.push_back(image);
    for (int i = 0; i < 3; ++i) {
      image.position[i] += options_.position_error * normal();
      image.angles[i] += options_.angle_error * normal();
    }
    block.images.push_back(image);
  }
  Eigen::Vector3d place() {
    return options_.origin +
           Eigen::Vector3d(uniform(-120.0, options_.spacing * (options_.columns - 1) + 120.0),
                           uniform(-90.0, options_.base * (options_.rows - 1) + 90.0),
                           uniform(-30.0, 30.0));
  }
  bool inside(const Eigen::Vector2d& at) const {
    return std::abs(at.x()) < 0.5 * block.camera.format.x() &&
           std::abs(at.y()) < 0.5 * block.camera.format.y();
  }
  void measure(const ImageOrientation& image, ImageMeasurement::Kind kind, const std::string& id,
               Eigen::Vector2d at) {
    for (int i = 0; i < 2; ++i) at[i] += options_.image_sigma * normal();
    block.measurements.push_back(
        {image.id, id, kind, at, options_.image_sigma > 0.0 ? options_.image_sigma : kLeastSigma});
  }
  void addLine(int number) {
    ObjectLine line;
    line.id = "L" + std::to_string(number);
    const double azimuth = uniform(0.0, options_.direction_spread), half = uniform(5.0, 9.0);
    const Eigen::Vector3d along(half * std::cos(azimuth), half * std::sin(azimuth),
                                half * 0.05 * normal());
    const Eigen::Vector3d middle = place();
    line.start = middle - along;
    line.end = middle + along;
    const double sigma = options_.line_sigma > 0.0 ? options_.line_sigma : kLeastSigma;
    line.covariance = sigma * sigma * Eigen::Matrix4d::Identity();
    lines.push_back(line);
    for (const ImageOrientation& image : images) {
      if (!inside(imageOf(image, line.start)) || !inside(imageOf(image, line.end))) continue;
      for (int i = 0; i < 3; ++i)
        measure(image, ImageMeasurement::Kind::line, line.id,
                imageOf(image, line.start + uniform(0.0, 1.0) * (line.end - line.start)));
    }
    // Ends as a lidar gives them: across with errors, along anywhere.
    const Eigen::Matrix<double, 3, 2> across = acrossLine(along);
    for (Eigen::Vector3d* end : {&line.start, &line.end})
      *end +=
          across * Eigen::Vector2d(options_.line_sigma * normal(), options_.line_sigma * normal());
    const Eigen::Vector3d direction = (line.end - line.start).normalized();
    line.start += 0.3 * direction;
    block.lines.push_back(line);
  }
  void addPoint(int number) {
    points.push_back(place());
    for (const ImageOrientation& image : images) {
      const Eigen::Vector2d at = imageOf(image, points.back());
      if (inside(at))
        measure(image, ImageMeasurement::Kind::point, "P" + std::to_string(number), at);
    }
  }

  Options options_;
  std::mt19937 random_;
  std::normal_distribution<double> deviate_;
};

/// Measurements with 2 micrometres, lines with 4 cm.
inline SyntheticBlock::Options noisy(unsigned seed) {
  SyntheticBlock::Options options;
  options.image_sigma = 0.002;
  options.line_sigma = 0.04;
  options.seed = seed;
  return options;
}

}  // namespace pcl_als::test
