// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "orientation_pictures.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>

#include <pcl_als/common/statistics.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/result_plots.h>
#include <pcl_als/drawing/ticks.h>

namespace pcl_als {
namespace {

constexpr int kWidth = 1400, kHeight = 1100;
const PixelBox kMap{110.0, 40.0, 1000.0, 980.0};
const Color kLineInk = Color::rgb(0xe69f00);  // of lines, as in the histogram
const Color kRejected = Color::rgb(0xcc0000);
const Color kHeightInk = Color::rgb(0x7a3e9d);  // of differences in height

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

Eigen::Matrix3d groundFromImage(const OrientedImage& image) {
  const Eigen::Vector3d& angles = image.orientation.angles;
  return (Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

/// Directions of lines in the images.
class LineDirections {
 public:
  explicit LineDirections(const ImageOrientationResult& result) {
    for (const OrientedImage& image : result.bundle.images) images_[image.orientation.id] = &image;
    for (const AdjustedLine& line : result.bundle.lines) lines_[line.line.id] = &line.line;
  }
  /// Unit vector in the image to the right of the line that was measured.
  Eigen::Vector2d across(const ImageMeasurement& m) const {
    const OrientedImage& image = *images_.at(m.image);
    const ObjectLine& line = *lines_.at(m.feature);
    const Eigen::Matrix3d rotation = groundFromImage(image).transpose();
    const auto at = [&](const Eigen::Vector3d& ground) -> Eigen::Vector2d {
      const Eigen::Vector3d p = rotation * (ground - image.orientation.position);
      return p.head<2>() / -p.z();
    };
    const Eigen::Vector2d along = (at(line.end) - at(line.start)).normalized();
    return {along.y(), -along.x()};
  }

 private:
  std::unordered_map<std::string, const OrientedImage*> images_;
  std::unordered_map<std::string, const ObjectLine*> lines_;
};

/// Corners of an image on a horizontal plane, from the left lower one on; none at the horizon.
std::vector<Eigen::Vector3d> footprint(const OrientedImage& image, const FrameCamera& camera,
                                       double height) {
  std::vector<Eigen::Vector3d> corners;
  for (const auto& [x, y] : {std::pair(-0.5, -0.5), {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
    const Eigen::Vector3d ray =
        groundFromImage(image) *
        Eigen::Vector3d(x * camera.format.x(), y * camera.format.y(), -camera.focal_length);
    if (ray.z() > -0.1 * camera.focal_length) return {};
    const Eigen::Vector3d& from = image.orientation.position;
    corners.push_back(from + ray * ((height - from.z()) / ray.z()));
  }
  return corners;
}

/// Mean height of points and lines, metres.
double groundHeight(const BundleResult& bundle) {
  RunningStatistics heights;
  for (const GroundPoint& point : bundle.points) heights.add(point.position.z());
  for (const AdjustedLine& line : bundle.lines) heights.add(line.line.start.z());
  return heights.mean();
}

void drawFootprints(const ImageOrientationResult& result, const MapFrame& at, Canvas& canvas) {
  const double height = groundHeight(result.bundle);
  for (const OrientedImage& image : result.bundle.images) {
    std::vector<Eigen::Vector2d> outline;
    for (const Eigen::Vector3d& corner : footprint(image, result.block.camera, height))
      outline.push_back(at(corner));
    if (outline.empty()) continue;
    outline.push_back(outline.front());
    canvas.polyline(outline, 1.0, ink::gray.withAlpha(90));
  }
}

/// Pixels of a metre of difference in plan and in height: the largest is a sixteenth of the map.
struct DifferenceScale {
  double plan, height;

  explicit DifferenceScale(const std::vector<ImageCheckPoint>& points) {
    double most_plan = 1e-4, most_height = 1e-4;
    for (const ImageCheckPoint& point : points) {
      most_plan = std::max(most_plan, point.difference.head<2>().norm());
      most_height = std::max(most_height, std::abs(point.difference.z()));
    }
    plan = kMap.width / 16.0 / most_plan;
    height = kMap.width / 16.0 / most_height;
  }
};

void drawArrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, Canvas& canvas) {
  const Eigen::Vector2d along = to - from;
  canvas.line(from, to, 2.5, ink::before);
  if (along.norm() < 6.0) return;
  const Eigen::Vector2d step = 9.0 * along.normalized(), side(-0.5 * step.y(), 0.5 * step.x());
  canvas.polygon({Eigen::Vector2d(to + 0.4 * step), Eigen::Vector2d(to - 0.6 * step + side),
                  Eigen::Vector2d(to - 0.6 * step - side)},
                 ink::before);
}

void drawCheckPoints(const ImageOrientationResult& result, const MapFrame& at,
                     const DifferenceScale& scale, Canvas& canvas) {
  for (const ImageCheckPoint& point : result.check_points) {
    const Eigen::Vector2d from = at(point.position);
    canvas.line(from, from - Eigen::Vector2d(0.0, scale.height * point.difference.z()), 4.0,
                kHeightInk);
    const Eigen::Vector2d plan(point.difference.x(), -point.difference.y());
    drawArrow(from, from + scale.plan * plan, canvas);
    canvas.marker(Marker::ring, from, 9.0, ink::before);
  }
}

void drawDifferenceScale(const DifferenceScale& scale, Canvas& canvas) {
  const double plan = roundDown125(120.0 / scale.plan);
  canvas.text("difference in plan, " + lengthText(plan), {1160.0, 290.0});
  drawArrow({1160.0, 318.0}, {1160.0 + plan * scale.plan, 318.0}, canvas);
  const double height = roundDown125(80.0 / scale.height);
  canvas.text("in height (up is positive), " + lengthText(height), {1160.0, 340.0});
  canvas.line({1164.0, 372.0 + height * scale.height}, {1164.0, 372.0}, 4.0, kHeightInk);
}

/// Symbols of the map, which a legend of squares and strokes cannot show.
void drawSymbols(Canvas& canvas) {
  const auto entry = [&](double y, const std::string& text) { canvas.text(text, {1190.0, y}); };
  canvas.marker(Marker::triangle, {1168.0, 70.0}, 12.0, ink::black);
  entry(70.0, "perspective centre");
  canvas.marker(Marker::disk, {1168.0, 96.0}, 5.0, ink::gray);
  entry(96.0, "point");
  canvas.line({1156.0, 122.0}, {1180.0, 122.0}, 4.0, ink::after);
  entry(122.0, "control line");
  canvas.line({1156.0, 148.0}, {1180.0, 148.0}, 4.0, kRejected);
  entry(148.0, "rejected line");
  canvas.line({1156.0, 174.0}, {1180.0, 174.0}, 1.0, ink::gray.withAlpha(90));
  entry(174.0, "border of an image");
  canvas.marker(Marker::ring, {1168.0, 200.0}, 9.0, ink::before);
  entry(200.0, "check point");
}

}  // namespace

Canvas blockPicture(const ImageOrientationResult& result) {
  Canvas canvas(kWidth, kHeight);
  const MapFrame at(result);
  const DifferenceScale scale(result.check_points);
  const bool compared = result.bundle.reliable() && !result.check_points.empty();
  canvas.fill(kMap, ink::ground);
  canvas.setClip(kMap);
  drawFootprints(result, at, canvas);
  for (const GroundPoint& point : result.bundle.points)
    canvas.marker(Marker::disk, at(point.position), 3.0, ink::gray);
  for (const AdjustedLine& line : result.bundle.lines)
    canvas.line(at(line.line.start), at(line.line.end), 4.0, line.used ? ink::after : kRejected);
  for (const OrientedImage& image : result.bundle.images)
    canvas.marker(Marker::triangle, at(image.orientation.position), 12.0, ink::black);
  if (compared) drawCheckPoints(result, at, scale, canvas);
  canvas.clearClip();
  canvas.frame(kMap, 1.0, ink::gray);
  drawCoordinates(canvas, at.northWest(), at.metresPerPixel(), kMap);
  drawSymbols(canvas);
  if (compared) drawDifferenceScale(scale, canvas);
  drawScaleBar(canvas, at.metresPerPixel(), 200.0, {1160.0, 560.0});
  drawNorthArrow(canvas, {1250.0, 640.0}, 60.0);
  return canvas;
}

namespace {

/// Residual of a measurement in the image, mm; of a place on a line across its image.
Eigen::Vector2d inTheImage(const ImageOrientationResult& result, const ImageResidual& residual,
                           const LineDirections& directions) {
  const ImageMeasurement& m = result.block.measurements[residual.measurement];
  if (m.kind == ImageMeasurement::Kind::point) return residual.residual;
  return residual.residual.x() * directions.across(m);
}

}  // namespace

Canvas residualPicture(const ImageOrientationResult& result) {
  Canvas canvas(kWidth, 1000);
  const FrameCamera& camera = result.block.camera;
  const double half_x = 0.5 * camera.format.x(), half_y = 0.5 * camera.format.y();
  const double height = 860.0, width = std::min(1080.0, height * half_x / half_y);
  Axis x{-half_x, half_x, "x in the image, mm", false, true};
  Axis y{-half_y, half_y, "y in the image, mm", false, true};
  Axes axes(canvas, {110.0, 50.0, width, width * half_y / half_x}, x, y);
  const LineDirections directions(result);
  double largest = 1e-6;
  for (const ImageResidual& r : result.bundle.residuals)
    if (r.used) largest = std::max(largest, r.residual.norm());
  const double scale = 0.05 * camera.format.x() / largest;  // the largest is a twentieth
  for (const bool lines : {true, false}) {
    for (const ImageResidual& r : result.bundle.residuals) {
      const ImageMeasurement& m = result.block.measurements[r.measurement];
      if (!r.used || (m.kind == ImageMeasurement::Kind::line) != lines) continue;
      const Eigen::Vector2d to = m.position + scale * inTheImage(result, r, directions);
      axes.line({m.position.x(), to.x()}, {m.position.y(), to.y()}, 1.2,
                lines ? kLineInk.withAlpha(110) : ink::after);
    }
  }
  axes.drawFrame("Residuals in all images, " + significantText(scale, 2) + " times enlarged");
  drawLegend(canvas, {{"points", ink::after, true}, {"lines, across", kLineInk, true}}, "",
             {110.0 + width + 20.0, 60.0});
  return canvas;
}

Canvas standardisedPicture(const ImageOrientationResult& result) {
  HistogramPlot plot;
  plot.title = "Residuals over their standard deviations";
  plot.x_label = "standardised residual";
  constexpr int kBins = 30;
  constexpr double kMaximumStandardisedResidual = 6.0;
  for (int i = 0; i <= kBins; ++i) plot.edges.push_back(kMaximumStandardisedResidual * i / kBins);
  plot.series = {{"points", std::vector<double>(kBins, 0.0)},
                 {"lines", std::vector<double>(kBins, 0.0)}};
  for (const ImageResidual& r : result.bundle.residuals) {
    if (!r.used) continue;
    const bool line = result.block.measurements[r.measurement].kind == ImageMeasurement::Kind::line;
    const int bin = std::clamp(
        static_cast<int>(kBins * r.standardised / kMaximumStandardisedResidual), 0, kBins - 1);
    plot.series[line ? 1 : 0].counts[static_cast<std::size_t>(bin)] += 1.0;
  }
  return drawHistogram(plot, {kWidth, 640});
}

}  // namespace pcl_als
