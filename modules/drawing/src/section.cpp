// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <set>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/section.h>

#include "dot_layer.h"
#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kPlotMargin;

/// "1.5", "20": without trailing zeros.
std::string shortNumber(double value) {
  const bool whole = std::abs(value - std::round(value)) < 1e-9;
  return whole ? numberText(value, 0) : significantText(value, 2);
}

/// The largest simple factor that is not above a limit.
double simpleFactor(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit) + 1e-9));
  double factor = power;
  for (const double step : {1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (step * power <= limit * (1.0 + 1e-9)) factor = step * power;
  }
  return factor;
}

/// Largest marker at which the points of a panel stay apart.
double markerSize(std::size_t points, double width) {
  const double per_pixel = static_cast<double>(points) / std::max(1.0, width);
  return std::clamp(5.0 / std::sqrt(std::max(per_pixel, 0.3)), 2.0, 6.0);
}

/// ", beyond the axis (triangles): 3 points above, 1 below"; empty where there are none.
std::string beyondText(std::size_t above, std::size_t below) {
  if (above + below == 0) return {};
  std::string text = ", beyond the axis (triangles at its edge): ";
  if (above > 0) text += counted(above, "point") + " above";
  if (below > 0) text += (above > 0 ? ", " : "") + counted(below, "point") + " below";
  return text;
}

/// A triangle at the upper or lower edge, pointing to where the point is.
void drawBeyond(Canvas& canvas, const Eigen::Vector2d& tip, double down, const Color& color) {
  constexpr double kHalf = 5.0, kHeight = 9.0;  // pixels
  const Eigen::Vector2d base = tip + Eigen::Vector2d(0.0, down * kHeight);
  canvas.polygon({tip, base - Eigen::Vector2d(kHalf, 0.0), base + Eigen::Vector2d(kHalf, 0.0)},
                 color);
}

}  // namespace

bool SectionLine::contains(const Eigen::Vector2d& place, double margin) const {
  const Eigen::Vector2d direction = (to - from) / length(), offset = place - from;
  const double along = direction.dot(offset);
  const double aside = direction.x() * offset.y() - direction.y() * offset.x();
  return along >= -margin && along <= length() + margin && std::abs(aside) <= half_width + margin;
}

SectionPoints::SectionPoints(const SectionLine& line, std::size_t most)
    : line_(line), most_(std::max<std::size_t>(2, most)) {
  if (!(line.length() > 0.0) || !std::isfinite(line.length())) {
    throw UsageError("a section needs two different points");
  }
  if (!(line.half_width > 0.0) || !std::isfinite(line.half_width)) {
    throw UsageError("a section needs a width above 0");
  }
  along_ = (line.to - line.from) / line.length();
}

void SectionPoints::add(const Eigen::Vector3d& ground, int strip) {
  const Eigen::Vector2d offset = ground.head<2>() - line_.from;
  const double along = along_.dot(offset);
  const double aside = along_.x() * offset.y() - along_.y() * offset.x();
  if (!(along >= 0.0 && along <= line_.length() && std::abs(aside) <= line_.half_width)) return;
  if (!std::isfinite(ground.z())) return;
  if (seen_ == 0) base_ = ground.z();
  if (seen_++ % stride_ != 0) return;
  points_.push_back({static_cast<float>(along), static_cast<float>(ground.z() - base_), strip});
  if (points_.size() < most_) return;
  stride_ *= 2;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
}

void SectionPicture::addPanel(std::string caption, const SectionPoints& points) {
  if (!panels_.empty()) {
    const SectionLine& first = panels_.front().points->line();
    if (first.from != points.line().from || first.to != points.line().to) {
      throw UsageError("panels of a section picture need the same line");
    }
  }
  panels_.push_back({std::move(caption), &points});
}

std::pair<double, double> SectionPicture::heightRange() const {
  constexpr double kShownShare = 0.9;        // share of the points that the axis has to show
  constexpr double kCompressed = 1.0 / 3.0;  // of the whole range: beyond are outliers
  constexpr double kRim = 0.25;              // of their range, on both sides
  std::vector<double> heights;
  for (const Panel& panel : panels_) {
    for (const SectionPoints::Point& point : panel.points->points())
      heights.push_back(panel.points->baseHeight() + point.height);
  }
  if (heights.empty()) throw UsageError("no point lies in the section");
  std::sort(heights.begin(), heights.end());
  const double low = heights.front(), high = heights.back();
  const auto most =
      static_cast<std::size_t>(std::ceil(kShownShare * static_cast<double>(heights.size())));
  std::size_t narrowest = 0;
  for (std::size_t i = 0; i + most <= heights.size(); ++i) {
    if (heights[i + most - 1] - heights[i] < heights[narrowest + most - 1] - heights[narrowest])
      narrowest = i;
  }
  const double from = heights[narrowest], to = heights[narrowest + most - 1];
  if (to - from > kCompressed * (high - low)) return {low, high};
  const double rim = kRim * std::max(to - from, 0.1);
  return {std::max(low, from - rim), std::min(high, to + rim)};
}

SectionPicture::Layout SectionPicture::layoutFor(PictureSize size) const {
  const auto [low, high] = heightRange();
  std::set<int> shown;
  for (const Panel& panel : panels_) {
    for (const SectionPoints::Point& point : panel.points->points()) shown.insert(point.strip);
  }
  Layout layout{};
  layout.shown.assign(shown.begin(), shown.end());
  layout.left = 100.0;
  layout.top = kPlotMargin + 84.0;
  layout.width = std::round(size.width - layout.left - 170.0);
  layout.pitch = (size.height - layout.top - 24.0) / static_cast<double>(panels_.size());
  layout.height = std::round(layout.pitch - 70.0);
  if (layout.width < 100.0 || layout.height < 60.0) {
    throw UsageError("a picture of " + std::to_string(size.width) + "x" +
                     std::to_string(size.height) + " pixels is too small for this section");
  }
  const double length = panels_.front().points->line().length();
  const double metres_across = length / layout.width;
  const double span = std::max(1.08 * (high - low), 0.02);
  layout.exaggeration = simpleFactor(metres_across / (span / layout.height));
  const double half = 0.5 * layout.height * metres_across / layout.exaggeration;
  layout.low = 0.5 * (low + high) - half;
  layout.high = 0.5 * (low + high) + half;
  for (const Panel& panel : panels_) {
    for (const SectionPoints::Point& point : panel.points->points()) {
      const double height = panel.points->baseHeight() + point.height;
      layout.above += height > layout.high ? 1 : 0;
      layout.below += height < layout.low ? 1 : 0;
    }
  }
  return layout;
}

double SectionPicture::exaggeration(PictureSize size) const {
  return layoutFor(size).exaggeration;
}

void SectionPicture::drawPanel(Canvas& canvas, const Layout& layout, std::size_t panel) const {
  const SectionPoints& points = *panels_[panel].points;
  Axis x, y;
  x.high = points.line().length();
  x.label = panel + 1 == panels_.size() ? "distance along the section, m" : "";
  y.low = layout.low;
  y.high = layout.high;
  y.label = "height, m";
  const PixelBox box{layout.left, layout.top + static_cast<double>(panel) * layout.pitch,
                     layout.width, layout.height};
  Axes axes(canvas, box, x, y);
  const double diameter = markerSize(points.points().size(), box.width);
  canvas.setClip(box);
  detail::DotLayer dots(static_cast<int>(box.width), static_cast<int>(box.height));
  const Eigen::Vector2d corner(box.x, box.y);
  for (const SectionPoints::Point& point : points.points()) {
    const double height = points.baseHeight() + point.height;
    const Color color = categoryColor(static_cast<std::size_t>(point.strip)).withAlpha(210);
    if (height > layout.high)
      drawBeyond(canvas, axes.pixel(point.along, layout.high), 1.0, color);
    else if (height < layout.low)
      drawBeyond(canvas, axes.pixel(point.along, layout.low), -1.0, color);
    else
      dots.add(axes.pixel(point.along, height) - corner, diameter, color);
  }
  canvas.draw(dots.image(), box);
  canvas.clearClip();
  axes.drawFrame(panels_[panel].caption);
}

Canvas SectionPicture::draw(PictureSize size) const {
  if (panels_.empty()) throw UsageError("a section picture needs a panel");
  const Layout layout = layoutFor(size);
  Canvas canvas(size.width, size.height);
  const double below_title = detail::drawTitle(canvas, title_);
  const SectionLine& line = panels_.front().points->line();
  TextStyle note;
  note.color = ink::gray;
  const auto place = [](const Eigen::Vector2d& p) {
    return numberText(p.x(), 1) + ", " + numberText(p.y(), 1);
  };
  const std::string facts = "from (" + place(line.from) + ") to (" + place(line.to) + "), width " +
                            numberText(2.0 * line.half_width, 1) + " m, vertical exaggeration " +
                            shortNumber(layout.exaggeration) + "×" +
                            beyondText(layout.above, layout.below);
  canvas.text(detail::shortened(facts, size.width - 2.0 * kPlotMargin, note),
              {kPlotMargin, below_title + 4.0}, note);
  for (std::size_t i = 0; i < panels_.size(); ++i) drawPanel(canvas, layout, i);
  std::vector<LegendEntry> entries;
  for (const int strip : layout.shown) {
    const auto index = static_cast<std::size_t>(strip);
    const std::string name = index < strips_.size() ? strips_[index] : std::to_string(strip);
    entries.push_back({detail::shortened(name, 100.0, {}), categoryColor(index)});
  }
  entries = detail::fitting(std::move(entries), size.height - layout.top - kPlotMargin);
  drawLegend(canvas, entries, "strip", {layout.left + layout.width + kPlotMargin, layout.top});
  return canvas;
}

}  // namespace pcl_als
