// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "orientation_pictures.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/visualization/axes.h>
#include <pcl_als/visualization/map_furniture.h>
#include <pcl_als/visualization/result_plots.h>
#include <pcl_als/visualization/ticks.h>

namespace pcl_als {
namespace {

constexpr int kWidth = 1400, kHeight = 1100;
const PixelBox kMap{110.0, 40.0, 1000.0, 980.0};

/// Ground coordinates in the picture.
class MapFrame {
 public:
  explicit MapFrame(const ImageOrientationResult& result) {
    for (const OrientedImage& image : result.bundle.images)
      box_.extend(Eigen::Vector2d(image.orientation.position.head<2>()));
    for (const GroundPoint& point : result.bundle.points)
      box_.extend(Eigen::Vector2d(point.position.head<2>()));
    for (const AdjustedLine& line : result.bundle.lines)
      box_.extend(Eigen::Vector2d(line.line.start.head<2>()));
    const Eigen::Vector2d size = box_.sizes().cwiseMax(1.0);
    metres_per_pixel_ = 1.05 * std::max(size.x() / kMap.width, size.y() / kMap.height);
    const Eigen::Vector2d half(0.5 * kMap.width, -0.5 * kMap.height);
    north_west_ = box_.center() - metres_per_pixel_ * half;
  }
  Eigen::Vector2d operator()(const Eigen::Vector3d& ground) const {
    return {kMap.x + (ground.x() - north_west_.x()) / metres_per_pixel_,
            kMap.y + (north_west_.y() - ground.y()) / metres_per_pixel_};
  }
  double metresPerPixel() const { return metres_per_pixel_; }
  const Eigen::Vector2d& northWest() const { return north_west_; }

 private:
  Eigen::AlignedBox2d box_;
  Eigen::Vector2d north_west_ = Eigen::Vector2d::Zero();
  double metres_per_pixel_ = 1.0;
};

/// Pixels of a metre of difference: the largest arrow is a fourteenth of the map.
double arrowScale(const std::vector<ImageCheckPoint>& points) {
  double largest = 1e-4;
  for (const ImageCheckPoint& point : points)
    largest = std::max(largest, point.difference.head<2>().norm());
  return kMap.width / 14.0 / largest;
}

void drawCheckPoints(const ImageOrientationResult& result, const MapFrame& at, Canvas& canvas) {
  const double scale = arrowScale(result.check_points);
  for (const ImageCheckPoint& point : result.check_points) {
    const Eigen::Vector2d from = at(point.position);
    const Eigen::Vector2d to =
        from + scale * Eigen::Vector2d(point.difference.x(), -point.difference.y());
    canvas.line(from, to, 3.0, ink::before);
    canvas.marker(Marker::ring, from, 9.0, ink::before);
  }
  if (result.check_points.empty()) return;
  const double metres = roundDown125(120.0 / scale);
  canvas.line({1160.0, 330.0}, {1160.0 + metres * scale, 330.0}, 3.0, ink::before);
  canvas.text("difference of " + lengthText(metres), {1160.0, 312.0});
}

}  // namespace

Canvas blockPicture(const ImageOrientationResult& result) {
  Canvas canvas(kWidth, kHeight);
  const MapFrame at(result);
  canvas.fill(kMap, ink::ground);
  canvas.setClip(kMap);
  for (const GroundPoint& point : result.bundle.points)
    canvas.marker(Marker::disk, at(point.position), 3.0, ink::gray);
  const Color control = ink::after, rejected = Color::rgb(0xcc0000);
  for (const AdjustedLine& line : result.bundle.lines)
    canvas.line(at(line.line.start), at(line.line.end), 4.0, line.used ? control : rejected);
  for (const OrientedImage& image : result.bundle.images)
    canvas.marker(Marker::triangle, at(image.orientation.position), 12.0, ink::black);
  drawCheckPoints(result, at, canvas);
  canvas.clearClip();
  canvas.frame(kMap, 1.0, ink::gray);
  drawCoordinates(canvas, at.northWest(), at.metresPerPixel(), kMap);
  drawNorthArrow(canvas, {1250.0, 480.0}, 60.0);
  drawScaleBar(canvas, at.metresPerPixel(), 200.0, {1160.0, 420.0});
  drawLegend(canvas,
             {{"perspective centre", ink::black},
              {"point", ink::gray},
              {"control line", control, true},
              {"rejected line", rejected, true},
              {"check point", ink::before}},
             "", {1150.0, 60.0});
  return canvas;
}

Canvas residualPicture(const ImageOrientationResult& result) {
  Canvas canvas(kWidth, 1000);
  const FrameCamera& camera = result.block.camera;
  const double half_x = 0.5 * camera.format.x(), half_y = 0.5 * camera.format.y();
  const double height = 860.0, width = std::min(1180.0, height * half_x / half_y);
  Axis x{-half_x, half_x, "x in the image, mm", false, true};
  Axis y{-half_y, half_y, "y in the image, mm", false, true};
  Axes axes(canvas, {110.0, 50.0, width, width * half_y / half_x}, x, y);
  double largest = 1e-6;
  for (const ImageResidual& r : result.bundle.residuals)
    if (r.used) largest = std::max(largest, r.residual.norm());
  const double scale = 0.05 * camera.format.x() / largest;  // the largest is a twentieth
  for (const ImageResidual& r : result.bundle.residuals) {
    const ImageMeasurement& m = result.block.measurements[r.measurement];
    if (!r.used || m.kind == ImageMeasurement::Kind::line) continue;
    const Eigen::Vector2d to = m.position + scale * r.residual;
    axes.line({m.position.x(), to.x()}, {m.position.y(), to.y()}, 1.2, ink::after.withAlpha(120));
  }
  axes.drawFrame("Residuals of points in all images, " + significantText(scale, 2) +
                 " times enlarged");
  return canvas;
}

Canvas standardisedPicture(const ImageOrientationResult& result) {
  HistogramPlot plot;
  plot.title = "Residuals over their standard deviations";
  plot.x_label = "standardised residual";
  constexpr int kBins = 30;
  constexpr double kMost = 6.0;
  for (int i = 0; i <= kBins; ++i) plot.edges.push_back(kMost * i / kBins);
  plot.series = {{"points", std::vector<double>(kBins, 0.0)},
                 {"lines", std::vector<double>(kBins, 0.0)}};
  for (const ImageResidual& r : result.bundle.residuals) {
    if (!r.used) continue;
    const bool line = result.block.measurements[r.measurement].kind == ImageMeasurement::Kind::line;
    const int bin = std::clamp(static_cast<int>(kBins * r.standardised / kMost), 0, kBins - 1);
    plot.series[line ? 1 : 0].counts[static_cast<std::size_t>(bin)] += 1.0;
  }
  return drawHistogram(plot, {kWidth, 640});
}

}  // namespace pcl_als
