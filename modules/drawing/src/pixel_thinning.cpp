// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/drawing/pixel_thinning.h>

namespace pcl_als {
namespace {

constexpr float kNothing = -std::numeric_limits<float>::infinity();

/// Depth at a pixel; kNothing outside the picture and where there is no point.
class DepthMap {
 public:
  explicit DepthMap(const PixelThinning& points)
      : pixels_(points.pixels()),
        width_(points.camera().width()),
        height_(points.camera().height()) {}

  float at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return kNothing;
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)]
        .depth;
  }
  /// The first point from (x, y) in a direction, at most radius pixels away: its distance in pixels
  /// (0: none) and depth.
  int search(int x, int y, int dx, int dy, int radius, float& depth) const {
    for (int step = 1; step <= radius; ++step) {
      depth = at(x + step * dx, y + step * dy);
      if (depth > kNothing) return step;
    }
    return 0;
  }

 private:
  const std::vector<PixelThinning::Shown>& pixels_;
  int width_, height_;
};

/// Slope of the depth per pixel along a direction, 0 where it is unknown.
double slopeAlong(const DepthMap& map, int x, int y, int dx, int dy, int radius) {
  const float here = map.at(x, y);
  float before = 0.0F, after = 0.0F;
  const int back = map.search(x, y, -dx, -dy, radius, before);
  const int ahead = map.search(x, y, dx, dy, radius, after);
  if (back + ahead == 0) return 0.0;
  const double rise = (ahead > 0 ? after : here) - (back > 0 ? before : here);
  return rise / (back + ahead);
}

template <typename Brightness>
std::vector<float> shade(const PixelThinning& points, const Brightness& brightness) {
  std::vector<float> shades(points.pixels().size(), 1.0F);
  const int width = points.camera().width();
  for (int y = 0; y < points.camera().height(); ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(x);
      if (points.pixels()[i].used()) shades[i] = static_cast<float>(brightness(x, y));
    }
  }
  return shades;
}

}  // namespace

PixelThinning::PixelThinning(const OrthographicCamera& camera)
    : camera_(camera),
      pixels_(static_cast<std::size_t>(camera.width()) *
              static_cast<std::size_t>(camera.height())) {}

void PixelThinning::add(const Eigen::Vector3d& ground, float value) {
  if (!ground.allFinite()) {
    ++invalid_;
    return;
  }
  const Eigen::Vector3d projected = camera_.project(ground);
  const double x = std::floor(projected.x()), y = std::floor(projected.y());
  if (!(x >= 0.0 && y >= 0.0 && x < camera_.width() && y < camera_.height())) {
    ++outside_;
    return;
  }
  ++seen_;
  Shown& pixel = pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width()) +
                         static_cast<std::size_t>(x)];
  const auto depth = static_cast<float>(projected.z());
  if (depth <= pixel.depth) return;
  pixel = {(ground - camera_.center()).cast<float>(), depth, value};
}

std::size_t PixelThinning::shown() const {
  return static_cast<std::size_t>(
      std::count_if(pixels_.begin(), pixels_.end(), [](const Shown& p) { return p.used(); }));
}

std::vector<float> eyeDomeShade(const PixelThinning& points, int radius, double strength) {
  const DepthMap map(points);
  const double metres = points.camera().metresPerPixel();
  static constexpr std::array<std::array<int, 2>, 8> kDirections = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  return shade(points, [&](int x, int y) {
    const float here = map.at(x, y);
    double sum = 0.0;
    for (const auto& direction : kDirections) {
      float depth = 0.0F;
      const int steps = map.search(x, y, direction[0], direction[1], radius, depth);
      if (steps > 0) sum += std::max(0.0, (depth - here) / (metres * steps));
    }
    // Logarithm: a wall of 30 m is not thirty times as dark as one of 1 m.
    return std::max(0.12, std::exp(-0.35 * strength * std::log1p(0.25 * sum * 2.0)));
  });
}

std::vector<float> hillShade(const PixelThinning& points, int radius) {
  const DepthMap map(points);
  const double metres = points.camera().metresPerPixel();
  return shade(points, [&](int x, int y) {
    const double dx = slopeAlong(map, x, y, 1, 0, radius) / metres;
    const double dy = slopeAlong(map, x, y, 0, 1, radius) / metres;  // y runs down
    const Eigen::Vector3d normal = Eigen::Vector3d(-dx, dy, 1.0).normalized();
    const Eigen::Vector3d light(-0.5, 0.5, std::sqrt(0.5));
    return std::clamp(0.35 + 0.9 * normal.dot(light), 0.12, 1.0);
  });
}

}  // namespace pcl_als
