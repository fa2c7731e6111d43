// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <unordered_map>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>

#include "image_geometry.h"

namespace pcl_als::photogrammetry {
namespace {

using Eigen::Vector3d;

/// Rays this far from a line are beyond the errors of any approximate orientation.
constexpr double kFarOff = 30.0 * kRadiansPerDegree;

/// Places on lines of an image.
struct ImageCounts {
  std::size_t places = 0, far = 0;
  double angle = 0.0;  ///< radians, of the first that is far
  std::string line;
};

/// Angle (radians) between the ray of a place and the direction to the middle of a line; NaN where
/// the coordinates overflow.
double angleBetween(const ImageMeasurement& place, const ImageOrientation& image,
                    const ObjectLine& line, const FrameCamera& camera) {
  const Eigen::Vector2d at = camera.reduced(place.position);
  const Vector3d ray =
      (groundFromImage(image.angles.data()) * Vector3d(at.x(), at.y(), -camera.focal_length))
          .normalized();
  const Vector3d to = (0.5 * (line.start + line.end) - image.position).normalized();
  return std::acos(std::clamp(ray.dot(to), -1.0, 1.0));
}

std::unordered_map<std::string, ImageCounts> countsOf(const ImageBlock& block) {
  std::unordered_map<std::string, const ImageOrientation*> images;
  std::unordered_map<std::string, const ObjectLine*> lines;
  for (const ImageOrientation& image : block.images) images[image.id] = &image;
  for (const ObjectLine& line : block.lines) lines[line.id] = &line;
  std::unordered_map<std::string, ImageCounts> by_image;
  for (const ImageMeasurement& m : block.measurements) {
    if (m.kind != ImageMeasurement::Kind::line) continue;
    const auto image = images.find(m.image);
    const auto line = lines.find(m.feature);
    if (image == images.end() || line == lines.end()) continue;
    ImageCounts& counts = by_image[m.image];
    ++counts.places;
    const double angle = angleBetween(m, *image->second, *line->second, block.camera);
    if (angle <= kFarOff) continue;
    if (counts.far++ > 0) continue;
    counts.angle = angle;
    counts.line = m.feature;
  }
  return by_image;
}

}  // namespace

void checkDirections(const ImageBlock& block) {
  const auto by_image = countsOf(block);
  std::size_t wrong = 0;
  const ImageOrientation* first = nullptr;
  for (const ImageOrientation& image : block.images) {
    const auto counts = by_image.find(image.id);
    if (counts == by_image.end() || 2 * counts->second.far <= counts->second.places) continue;
    if (wrong++ == 0) first = &image;
  }
  if (wrong == 0) return;
  const ImageCounts& counts = by_image.at(first->id);
  char text[360];
  std::snprintf(
      text, sizeof text,
      "images whose rays point elsewhere than to their control lines: %zu of %zu (in image "
      "%s, line %s is %.0f degrees from where it was measured): position or angles "
      "(omega, phi, kappa in degrees) of the images, or the lines, are in another system "
      "or unit",
      wrong, block.images.size(), first->id.c_str(), counts.line.c_str(),
      counts.angle / kRadiansPerDegree);
  throw InputError(text);
}

}  // namespace pcl_als::photogrammetry
