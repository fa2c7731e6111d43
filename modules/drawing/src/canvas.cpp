// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/canvas.h>

#include "text_metrics.h"

namespace pcl_als {
namespace {

constexpr int kLargestSide = 20000;  // pixels

using Points = std::vector<Eigen::Vector2d>;

Points cornersOf(const PixelBox& box) {
  return {{box.x, box.y}, {box.right(), box.y}, {box.right(), box.bottom()}, {box.x, box.bottom()}};
}

/// Offset from the anchor to the low end of an extent.
double shift(Align align, double extent) {
  return align == Align::low ? 0.0 : align == Align::center ? -0.5 * extent : -extent;
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& background) : width_(width), height_(height) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw UsageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels: each side must be 1 to " + std::to_string(kLargestSide));
  }
  clearClip();
  fill(clip_, background);
}

void Canvas::setClip(const PixelBox& box) {
  const double left = std::max(0.0, std::floor(box.x)), top = std::max(0.0, std::floor(box.y));
  const double right = std::min<double>(width_, std::ceil(box.right()));
  const double bottom = std::min<double>(height_, std::ceil(box.bottom()));
  clip_ = {left, top, std::max(0.0, right - left), std::max(0.0, bottom - top)};
}

void Canvas::clearClip() {
  clip_ = {0.0, 0.0, static_cast<double>(width_), static_cast<double>(height_)};
}

Canvas::Element& Canvas::add(Element::Kind kind, const Color& color, Points points, double size) {
  Element& element = elements_.emplace_back();
  element.kind = kind;
  element.color = color;
  element.points = std::move(points);
  element.size = size;
  element.clip = clip_;
  return element;
}

void Canvas::fill(const PixelBox& box, const Color& color) {
  if (box.width > 0.0 && box.height > 0.0) add(Element::Kind::area, color, cornersOf(box));
}

void Canvas::frame(const PixelBox& box, double width, const Color& color) {
  const double half = 0.5 * width;
  Points corners = cornersOf({box.x + half, box.y + half, box.width - width, box.height - width});
  corners.push_back(corners.front());
  corners.push_back(corners[1]);  // so that the last corner is a corner, not two ends
  polyline(corners, width, color);
}

void Canvas::polygon(const Points& corners, const Color& color) {
  const auto finite = [](const Eigen::Vector2d& corner) { return corner.allFinite(); };
  if (std::all_of(corners.begin(), corners.end(), finite)) add(Element::Kind::area, color, corners);
}

void Canvas::polyline(const Points& points, double width, const Color& color) {
  add(Element::Kind::stroke, color, points, width);
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
                  const Color& color) {
  // Horizontal and vertical lines are boxes, without the round ends of strokes.
  if (from.x() == to.x() || from.y() == to.y()) {
    const Eigen::Vector2d low = from.cwiseMin(to), size = (to - from).cwiseAbs();
    const double half = 0.5 * width;
    if (size.x() == 0.0) return fill({low.x() - half, low.y(), width, size.y()}, color);
    return fill({low.x(), low.y() - half, size.x(), width}, color);
  }
  polyline({from, to}, width, color);
}

void Canvas::marker(Marker shape, const Eigen::Vector2d& at, double diameter, const Color& color) {
  if (!at.allFinite()) return;
  const double r = 0.5 * diameter;
  const auto corner = [&](double x, double y) {
    return Eigen::Vector2d(at + r * Eigen::Vector2d(x, y));
  };
  switch (shape) {
    case Marker::square:
      return fill({at.x() - r, at.y() - r, diameter, diameter}, color);
    case Marker::diamond:
      return polygon({corner(-1.25, 0.0), corner(0.0, -1.25), corner(1.25, 0.0), corner(0.0, 1.25)},
                     color);
    case Marker::triangle:
      return polygon({corner(-1.1, 0.8), corner(0.0, -1.15), corner(1.1, 0.8)}, color);
    case Marker::disk:
      add(Element::Kind::disk, color, {at}, diameter);
      return;
    case Marker::ring:
      add(Element::Kind::ring, color, {at}, diameter);
  }
}

void Canvas::draw(const Image& image, const PixelBox& box) {
  if (image.pixels.empty()) return;
  Element& element = add(Element::Kind::image, ink::black);
  element.image = std::make_shared<const Image>(image);
  element.box = box;
}

Eigen::Vector2d Canvas::textSize(const std::string& utf8, const TextStyle& style) {
  if (utf8.empty()) return Eigen::Vector2d::Zero();
  return {std::ceil(detail::textLength(utf8, style.size, style.bold)),
          std::ceil((detail::kAscent + detail::kDescent) * style.size)};
}

PixelBox Canvas::text(const std::string& utf8, const Eigen::Vector2d& at, const TextStyle& style) {
  if (utf8.empty()) return {at.x(), at.y(), 0.0, 0.0};
  Eigen::Vector2d size = textSize(utf8, style);
  const double ascent = std::ceil(detail::kAscent * style.size);
  if (style.upward) std::swap(size.x(), size.y());
  const PixelBox box{std::round(at.x() + shift(style.horizontal, size.x())),
                     std::round(at.y() + shift(style.vertical, size.y())), size.x(), size.y()};
  const Eigen::Vector2d start = style.upward ? Eigen::Vector2d(box.x + ascent, box.bottom())
                                             : Eigen::Vector2d(box.x, box.y + ascent);
  Element& element = add(Element::Kind::text, style.color, {start}, style.size);
  element.text = utf8;
  element.length = detail::textLength(utf8, style.size, style.bold);
  element.bold = style.bold;
  element.upward = style.upward;
  texts_.push_back({utf8, box});
  return box;
}

void Canvas::write(const std::filesystem::path& path) const {
  const std::string ending = path.extension().string();
  if (ending == ".pdf") return writeFile(path, pdf());
  if (ending == ".svg")
    return writeFile(path, svgElement(" xmlns=\"http://www.w3.org/2000/svg\"",
                                      "<style>" + themeStyle() + "</style>\n"));
  if (ending == ".png") {
    const std::vector<std::uint8_t> bytes = png();
    return writeFile(path, std::string(bytes.begin(), bytes.end()));
  }
  throw UsageError(path.string() + ": pictures are written as .png, .svg or .pdf");
}

}  // namespace pcl_als
