// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/drawing/axes.h>

namespace pcl_als {
namespace {

constexpr double kTextSize = 13.0;

}  // namespace

Axis Axis::around(const std::vector<double>& values, std::string label, bool with_zero) {
  Axis axis;
  axis.label = std::move(label);
  double low = INFINITY, high = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return axis;
  if (with_zero) {
    low = std::min(low, 0.0);
    high = std::max(high, 0.0);
  }
  const double span = high > low ? high - low : std::max(1e-3, 0.1 * std::abs(high));
  axis.low = with_zero && low == 0.0 ? 0.0 : low - 0.05 * span;
  axis.high = with_zero && high == 0.0 ? 0.0 : high + 0.05 * span;
  return axis;
}

double Axis::share(double value) const {
  if (!logarithmic) return (value - low) / (high - low);
  return std::log(value / low) / std::log(high / low);
}

Axes::Axes(Canvas& canvas, const PixelBox& box, const Axis& x, const Axis& y)
    : canvas_(canvas),
      box_{std::round(box.x), std::round(box.y), std::round(box.width), std::round(box.height)},
      x_(x),
      y_(y) {
  x_marks_ = marksOf(x_, std::max(3, static_cast<int>(box_.width / 80.0)));
  // Low panels get closer marks, so that there is more than one to read a scale from.
  const double most = std::max(box_.height / 45.0, std::min(5.0, box_.height / 24.0));
  y_marks_ = marksOf(y_, std::max(2, static_cast<int>(most)));
  // Marks of the x axis must not overlap.
  TextStyle style;
  style.size = kTextSize;
  double widest = 0.0;
  for (const Mark& mark : x_marks_)
    widest = std::max(widest, Canvas::textSize(mark.label, style).x());
  if (!x_.logarithmic && widest > 0.0) {
    const int most = static_cast<int>(box_.width / (1.35 * widest + 4.0));
    if (static_cast<int>(x_marks_.size()) > most) x_marks_ = marksOf(x_, std::max(2, most));
  }
  drawGrid();
}

std::vector<Axes::Mark> Axes::marksOf(const Axis& axis, int most) {
  std::vector<Mark> marks;
  if (!axis.ticks) return marks;
  if (!axis.logarithmic) {
    const Ticks ticks = niceTicks(axis.low, axis.high, most);
    for (const double value : ticks.values)
      marks.push_back({axis.share(value), ticks.label(value)});
    return marks;
  }
  const double first = std::ceil(std::log10(axis.low) - 1e-9);
  const double last = std::floor(std::log10(axis.high) + 1e-9);
  const double step = std::max(1.0, std::ceil((last - first + 1.0) / most));
  for (double power = first; power <= last; power += step) {
    const double value = std::pow(10.0, power);
    marks.push_back({axis.share(value), numberText(value, std::max(0, static_cast<int>(-power)))});
  }
  return marks;
}

Eigen::Vector2d Axes::pixel(double x, double y) const {
  return {box_.x + x_.share(x) * box_.width, box_.bottom() - y_.share(y) * box_.height};
}

void Axes::drawGrid() {
  for (const Mark& mark : x_marks_) {
    const double x = box_.x + mark.share * box_.width;
    canvas_.line({x, box_.y}, {x, box_.bottom()}, 1.0, ink::faint);
  }
  for (const Mark& mark : y_marks_) {
    const double y = box_.bottom() - mark.share * box_.height;
    canvas_.line({box_.x, y}, {box_.right(), y}, 1.0, ink::faint);
  }
}

void Axes::line(const std::vector<double>& x, const std::vector<double>& y, double width,
                const Color& color) {
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) pixels.push_back(pixel(x[i], y[i]));
  canvas_.setClip(box_);
  canvas_.polyline(pixels, width, color);
  canvas_.clearClip();
}

void Axes::points(const std::vector<double>& x, const std::vector<double>& y, double diameter,
                  const Color& color, Marker shape) {
  canvas_.setClip(box_);
  for (std::size_t i = 0; i < x.size() && i < y.size(); ++i) {
    canvas_.marker(shape, pixel(x[i], y[i]), diameter, color);
  }
  canvas_.clearClip();
}

void Axes::errorBars(const std::vector<double>& x, const std::vector<double>& y,
                     const std::vector<double>& half, const Color& color) {
  const Eigen::Vector2d cap(4.0, 0.0), gap = Eigen::Vector2d::Constant(NAN);
  std::vector<Eigen::Vector2d> bars;  // one stroke, which is smaller in a file than many
  for (std::size_t i = 0; i < x.size() && i < y.size() && i < half.size(); ++i) {
    if (!(half[i] > 0.0)) continue;
    const Eigen::Vector2d low = pixel(x[i], y[i] - half[i]), high = pixel(x[i], y[i] + half[i]);
    bars.insert(bars.end(),
                {low - cap, low + cap, gap, low, high, gap, high - cap, high + cap, gap});
  }
  if (bars.empty()) return;
  canvas_.setClip(box_);
  canvas_.polyline(bars, 1.5, color);
  canvas_.clearClip();
}

void Axes::horizontalLine(double y, double width, const Color& color) {
  canvas_.setClip(box_);
  const double at = pixel(x_.low, y).y();
  canvas_.line({box_.x, at}, {box_.right(), at}, width, color);
  canvas_.clearClip();
}

void Axes::verticalLine(double x, double width, const Color& color) {
  canvas_.setClip(box_);
  const double at = pixel(x, y_.low).x();
  canvas_.line({at, box_.y}, {at, box_.bottom()}, width, color);
  canvas_.clearClip();
}

void Axes::drawFrame(const std::string& title) {
  canvas_.frame(box_, 1.0, ink::gray);
  TextStyle style;
  style.size = kTextSize;
  style.horizontal = Align::center;
  style.vertical = Align::low;
  for (const Mark& mark : x_marks_) {
    const double x = box_.x + mark.share * box_.width;
    canvas_.line({x, box_.bottom()}, {x, box_.bottom() + 5.0}, 1.0, ink::gray);
    canvas_.text(mark.label, {x, box_.bottom() + 8.0}, style);
  }
  style.horizontal = Align::high;
  style.vertical = Align::center;
  double widest = 0.0;
  for (const Mark& mark : y_marks_) {
    const double y = box_.bottom() - mark.share * box_.height;
    canvas_.line({box_.x - 5.0, y}, {box_.x, y}, 1.0, ink::gray);
    widest = std::max(widest, canvas_.text(mark.label, {box_.x - 8.0, y}, style).width);
  }
  style.size = kTextSize + 1.0;
  style.horizontal = Align::center;
  style.vertical = Align::low;
  const double foot = box_.bottom() + (x_marks_.empty() ? 8.0 : 8.0 + 1.9 * kTextSize);
  canvas_.text(x_.label, {box_.x + 0.5 * box_.width, foot}, style);
  style.upward = true;
  style.horizontal = Align::high;
  style.vertical = Align::center;
  canvas_.text(y_.label, {box_.x - widest - 18.0, box_.y + 0.5 * box_.height}, style);
  TextStyle heading;
  heading.size = kTextSize + 2.0;
  heading.bold = true;
  heading.vertical = Align::high;
  canvas_.text(title, {box_.x, box_.y - 8.0}, heading);
}

}  // namespace pcl_als
