// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include <pcl_als/photogrammetry/image_block.h>

#include "image_geometry.h"

namespace pcl_als {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using photogrammetry::inImage;
using photogrammetry::projected;

/// A place measured in an image with its orientation.
struct Place {
  Vector2d reduced;                   ///< mm
  Eigen::Matrix<double, 6, 1> image;  ///< position, angles
};

/// Distance (metres on the ground) of a place from the image of a line, which counts beyond its
/// ends as well; infinite where the line is not in front of the image.
double distanceOf(const Place& place, const ObjectLine& line, double focal_length) {
  const Vector3d a = inImage<double>(place.image.data(), line.start);
  const Vector3d b = inImage<double>(place.image.data(), line.end);
  if (a.z() > -1.0 || b.z() > -1.0) return std::numeric_limits<double>::infinity();
  const Vector2d from = projected(a, focal_length), to = projected(b, focal_length);
  const Vector2d along = (to - from).normalized(), offset = place.reduced - from;
  const double at = along.dot(offset), length = (to - from).norm();
  const double beyond = std::max({0.0, -at, at - length});
  const double metres = -0.5 * (a.z() + b.z()) / focal_length;
  return metres * std::hypot(along.x() * offset.y() - along.y() * offset.x(), beyond);
}

/// RMS of the distances of all places; stops where the first is far away.
double distanceOf(const std::vector<Place>& places, const ObjectLine& line, double focal_length,
                  double limit) {
  double sum = 0.0;
  for (const Place& place : places) {
    const double distance = distanceOf(place, line, focal_length);
    if (distance > 4.0 * limit) return std::numeric_limits<double>::infinity();
    sum += distance * distance;
  }
  return std::sqrt(sum / static_cast<double>(places.size()));
}

/// The only object line nearby.
std::optional<LineAssignment> nearestTo(const std::vector<Place>& places, const ImageBlock& block,
                                        double distance) {
  LineAssignment best;
  double nearest = 2.0 * distance, second = 2.0 * distance;
  for (const ObjectLine& line : block.lines) {
    const double here = distanceOf(places, line, block.camera.focal_length, distance);
    if (here < nearest) {
      second = nearest;
      nearest = here;
      best.object_line = line.id;
    } else {
      second = std::min(second, here);
    }
  }
  if (nearest > distance || second < 2.0 * nearest) return std::nullopt;
  best.distance = nearest;
  return best;
}

}  // namespace

std::vector<LineAssignment> assignLines(ImageBlock& block, double distance) {
  std::set<std::string> known;
  for (const ObjectLine& line : block.lines) known.insert(line.id);
  std::unordered_map<std::string, const ImageOrientation*> images;
  for (const ImageOrientation& image : block.images) images[image.id] = &image;
  std::map<std::string, std::vector<std::size_t>> unknown;
  for (std::size_t m = 0; m < block.measurements.size(); ++m) {
    const ImageMeasurement& place = block.measurements[m];
    if (place.kind == ImageMeasurement::Kind::line && known.count(place.feature) == 0 &&
        images.count(place.image) > 0)
      unknown[place.feature].push_back(m);
  }
  std::vector<LineAssignment> assignments;
  for (const auto& [id, members] : unknown) {
    std::vector<Place> places;
    for (const std::size_t m : members) {
      const ImageOrientation& image = *images[block.measurements[m].image];
      Place& place = places.emplace_back();
      place.reduced = block.camera.reduced(block.measurements[m].position);
      place.image << image.position, image.angles;
    }
    auto assignment = nearestTo(places, block, distance);
    if (!assignment) continue;
    assignment->image_line = id;
    assignments.push_back(*assignment);
    for (const std::size_t m : members) block.measurements[m].feature = assignment->object_line;
  }
  return assignments;
}

}  // namespace pcl_als
