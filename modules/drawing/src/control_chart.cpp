// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/control_chart.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kNormal95;
using detail::kPlotMargin;

constexpr double kLimits = 2.0;  // half width of the limits, standard deviations

Axis sampleAxis(std::size_t count) {
  Axis x;
  x.low = 0.5;
  x.high = static_cast<double>(count) + 0.5;
  x.ticks = false;
  return x;
}

Axis valueAxis(const ControlChart& chart) {
  std::vector<double> reach;
  for (const ControlChart::Sample& sample : chart.samples) {
    const double band = kLimits * sample.expected_std;
    reach.insert(reach.end(), {sample.expected - band, sample.expected + band});
    if (!std::isfinite(sample.value)) continue;
    const double half = kNormal95 * sample.std;
    reach.insert(reach.end(), {sample.value - half, sample.value + half});
  }
  return Axis::around(reach, chart.y_label);
}

/// The model and its limits, for each sample over the width of one.
void drawModel(const ControlChart& chart, const Axes& axes, Canvas& canvas) {
  const Color band = ink::after.withAlpha(36), line = ink::after;
  for (std::size_t i = 0; i < chart.samples.size(); ++i) {
    const ControlChart::Sample& sample = chart.samples[i];
    const double x = static_cast<double>(i) + 1.0, half = kLimits * sample.expected_std;
    const Eigen::Vector2d low = axes.pixel(x - 0.5, sample.expected - half),
                          high = axes.pixel(x + 0.5, sample.expected + half);
    canvas.fill({low.x(), high.y(), high.x() - low.x(), low.y() - high.y()}, band);
    canvas.line(axes.pixel(x - 0.5, sample.expected), axes.pixel(x + 0.5, sample.expected), 2.0,
                line);
  }
}

/// Labels of the samples below the axis, as many as fit.
void drawLabels(const ControlChart& chart, const Axes& axes, Canvas& canvas) {
  TextStyle style;
  style.size = 12.0;
  style.horizontal = Align::center;
  style.vertical = Align::low;
  const PixelBox& box = axes.box();
  const double share = box.width / static_cast<double>(chart.samples.size());
  double last = -1e9;
  for (std::size_t i = 0; i < chart.samples.size(); ++i) {
    const double x = box.x + (static_cast<double>(i) + 0.5) * share;
    const std::string text = detail::shortened(chart.samples[i].label, 160.0, style);
    const double half = 0.5 * Canvas::textSize(text, style).x();
    if (x - half < last + 12.0 || x + half > canvas.width()) continue;
    canvas.text(text, {x, box.bottom() + 10.0}, style);
    last = x + half;
  }
}

}  // namespace

Canvas drawControlChart(const ControlChart& chart, PictureSize size) {
  std::vector<double> x, y, half;
  for (std::size_t i = 0; i < chart.samples.size(); ++i) {
    if (!std::isfinite(chart.samples[i].value)) continue;
    x.push_back(static_cast<double>(i) + 1.0);
    y.push_back(chart.samples[i].value);
    half.push_back(kNormal95 * chart.samples[i].std);
  }
  if (x.empty()) throw UsageError("plot '" + chart.title + "': contains no value");
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, chart.title);
  constexpr double kLeft = 110.0, kBelow = 48.0;
  const PixelBox box{kLeft, top + 8.0, size.width - kLeft - kPlotMargin,
                     size.height - top - 8.0 - kBelow};
  Axes axes(canvas, box, sampleAxis(chart.samples.size()), valueAxis(chart));
  canvas.setClip(box);
  drawModel(chart, axes, canvas);
  canvas.clearClip();
  axes.errorBars(x, y, half, ink::gray);
  for (std::size_t i = 0; i < chart.samples.size(); ++i) {
    const ControlChart::Sample& sample = chart.samples[i];
    if (!std::isfinite(sample.value)) continue;
    const Eigen::Vector2d at = axes.pixel(static_cast<double>(i) + 1.0, sample.value);
    canvas.marker(sample.marked ? Marker::diamond : Marker::disk, at, sample.marked ? 13.0 : 9.0,
                  sample.marked ? ink::before : ink::black);
  }
  axes.drawFrame();
  drawLabels(chart, axes, canvas);
  return canvas;
}

}  // namespace pcl_als
