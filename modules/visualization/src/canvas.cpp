// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/visualization/canvas.h>

namespace pcl_als {
namespace {

constexpr int kLargestSide = 20000;  // pixels

/// Share of the column [column, column + 1) that lies in [left, right).
double overlapWith(int column, double left, double right) {
  return std::max(0.0, std::min(right, column + 1.0) - std::max(left, static_cast<double>(column)));
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& from,
                         const Eigen::Vector2d& along, double squared_length) {
  const Eigen::Vector2d offset = p - from;
  const double t =
      squared_length > 0.0 ? std::clamp(offset.dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (offset - t * along).norm();
}

}  // namespace

Canvas::Canvas(int width, int height, const Color& background) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) {
    throw UsageError("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels: each side must be 1 to " + std::to_string(kLargestSide));
  }
  image_ = Image(width, height, background);
  clearClip();
}

void Canvas::setClip(const PixelBox& box) {
  clip_left_ = std::max(0, static_cast<int>(std::floor(box.x)));
  clip_top_ = std::max(0, static_cast<int>(std::floor(box.y)));
  clip_right_ = std::min(width(), static_cast<int>(std::ceil(box.right())));
  clip_bottom_ = std::min(height(), static_cast<int>(std::ceil(box.bottom())));
}

void Canvas::clearClip() {
  clip_left_ = clip_top_ = 0;
  clip_right_ = width();
  clip_bottom_ = height();
}

void Canvas::blend(int x, int y, const Color& color, double coverage) {
  if (x < clip_left_ || y < clip_top_ || x >= clip_right_ || y >= clip_bottom_) return;
  const double alpha = std::min(1.0, coverage) * color.a / 255.0;
  if (alpha <= 0.0) return;
  Color& pixel = image_.at(x, y);
  const std::uint8_t opaque =
      std::max(pixel.a, static_cast<std::uint8_t>(std::lround(255 * alpha)));
  pixel = mix(pixel, color.withAlpha(pixel.a), alpha);
  pixel.a = opaque;
}

void Canvas::fill(const PixelBox& box, const Color& color) {
  const int top = static_cast<int>(std::floor(std::max(box.y, 0.0)));
  const int left = static_cast<int>(std::floor(std::max(box.x, 0.0)));
  for (int y = top; y < std::min<double>(height(), box.bottom()); ++y) {
    const double rows = overlapWith(y, box.y, box.bottom());
    for (int x = left; x < std::min<double>(width(), box.right()); ++x) {
      blend(x, y, color, rows * overlapWith(x, box.x, box.right()));
    }
  }
}

void Canvas::frame(const PixelBox& box, double width, const Color& color) {
  fill({box.x, box.y, box.width, width}, color);
  fill({box.x, box.bottom() - width, box.width, width}, color);
  fill({box.x, box.y + width, width, box.height - 2 * width}, color);
  fill({box.right() - width, box.y + width, width, box.height - 2 * width}, color);
}

void Canvas::polygon(const std::vector<Eigen::Vector2d>& corners, const Color& color) {
  constexpr int kSubRows = 8;
  double low = height(), high = 0.0;
  for (const Eigen::Vector2d& corner : corners) {
    low = std::min(low, corner.y());
    high = std::max(high, corner.y());
  }
  std::vector<double> row(static_cast<std::size_t>(width())), crossings;
  for (int y = std::max(0, static_cast<int>(low)); y < std::min<double>(height(), high); ++y) {
    std::fill(row.begin(), row.end(), 0.0);
    for (int sub = 0; sub < kSubRows; ++sub) {
      const double at = y + (sub + 0.5) / kSubRows;
      crossings.clear();
      for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Eigen::Vector2d &a = corners[j], &b = corners[i];
        if ((a.y() <= at) == (b.y() <= at)) continue;
        crossings.push_back(a.x() + (at - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2) {
        const double left = std::max(0.0, crossings[k]), right = crossings[k + 1];
        for (int x = static_cast<int>(left); x < std::min<double>(width(), right); ++x) {
          row[static_cast<std::size_t>(x)] += overlapWith(x, left, right) / kSubRows;
        }
      }
    }
    for (int x = 0; x < width(); ++x) blend(x, y, color, row[static_cast<std::size_t>(x)]);
  }
}

void Canvas::strokeCoverage(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width) {
  const double reach = 0.5 * width + 1.0;
  const Eigen::Vector2d low = from.cwiseMin(to), high = from.cwiseMax(to), along = to - from;
  const double squared_length = along.squaredNorm();
  const int left = static_cast<int>(std::max<double>(clip_left_, low.x() - reach));
  const int top = static_cast<int>(std::max<double>(clip_top_, low.y() - reach));
  const int right = static_cast<int>(std::min<double>(clip_right_, high.x() + reach + 1.0));
  const int bottom = static_cast<int>(std::min<double>(clip_bottom_, high.y() + reach + 1.0));
  for (int y = top; y < bottom; ++y) {
    for (int x = left; x < right; ++x) {
      const double distance = distanceToSegment({x + 0.5, y + 0.5}, from, along, squared_length);
      // A line thinner than a pixel keeps a pixel's width and pales instead.
      const double cover =
          std::clamp(0.5 * std::max(width, 1.0) + 0.5 - distance, 0.0, 1.0) * std::min(width, 1.0);
      float& pixel =
          coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(this->width()) +
                    static_cast<std::size_t>(x)];
      pixel = std::max(pixel, static_cast<float>(cover));
    }
  }
  if (left >= right || top >= bottom) return;
  dirty_left_ = std::min(dirty_left_, left);
  dirty_top_ = std::min(dirty_top_, top);
  dirty_right_ = std::max(dirty_right_, right);
  dirty_bottom_ = std::max(dirty_bottom_, bottom);
}

void Canvas::paintCoverage(const Color& color) {
  for (int y = dirty_top_; y < dirty_bottom_; ++y) {
    for (int x = dirty_left_; x < dirty_right_; ++x) {
      float& cover = coverage_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) +
                               static_cast<std::size_t>(x)];
      if (cover > 0.0F) blend(x, y, color, cover);
      cover = 0.0F;
    }
  }
}

void Canvas::polyline(const std::vector<Eigen::Vector2d>& points, double width,
                      const Color& color) {
  coverage_.resize(image_.pixels.size());
  dirty_left_ = this->width(), dirty_top_ = height(), dirty_right_ = dirty_bottom_ = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!points[i - 1].allFinite() || !points[i].allFinite()) continue;
    strokeCoverage(points[i - 1], points[i], width);
  }
  paintCoverage(color);
}

void Canvas::line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
                  const Color& color) {
  // Horizontal and vertical lines are boxes: exact, and the most frequent elements of plots.
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
  using Corners = std::vector<Eigen::Vector2d>;
  if (shape == Marker::square) return fill({at.x() - r, at.y() - r, diameter, diameter}, color);
  if (shape == Marker::diamond) {
    const double d = 1.25 * r;
    return polygon(
        Corners{
            {at.x() - d, at.y()}, {at.x(), at.y() - d}, {at.x() + d, at.y()}, {at.x(), at.y() + d}},
        color);
  }
  if (shape == Marker::triangle) {
    return polygon(Corners{{at.x() - 1.1 * r, at.y() + 0.8 * r},
                           {at.x(), at.y() - 1.15 * r},
                           {at.x() + 1.1 * r, at.y() + 0.8 * r}},
                   color);
  }
  const double hole = shape == Marker::ring ? r - 1.5 : -1.0;
  const int left = static_cast<int>(std::floor(at.x() - r - 1.0));
  const int top = static_cast<int>(std::floor(at.y() - r - 1.0));
  for (int y = top; y <= at.y() + r + 1.0; ++y) {
    for (int x = left; x <= at.x() + r + 1.0; ++x) {
      const double distance = (Eigen::Vector2d(x + 0.5, y + 0.5) - at).norm();
      double cover = std::clamp(r + 0.5 - distance, 0.0, 1.0);
      if (hole > 0.0) cover -= std::clamp(hole + 0.5 - distance, 0.0, 1.0);
      blend(x, y, color, cover);
    }
  }
}

void Canvas::draw(const Image& image, int x, int y, int scale) {
  for (int row = 0; row < image.height * scale; ++row) {
    for (int column = 0; column < image.width * scale; ++column) {
      blend(x + column, y + row, image.at(column / scale, row / scale), 1.0);
    }
  }
}

}  // namespace pcl_als
