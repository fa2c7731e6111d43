// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/waveform_plot.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kPlotMargin;

constexpr double kLeft = 64.0, kHead = 30.0, kFoot = 26.0, kGap = 8.0, kKey = 36.0, kLabel = 26.0;
/// Of the height of a panel, for the residuals.
constexpr double kResidualShare = 0.26;
/// Marks of the noise below and above the residuals, in standard deviations.
constexpr double kNoiseLines = 2.0;

const Color& colorOf(const WaveformPlot::Echo& echo) {
  static const Color fresh = categoryColor(1), known = categoryColor(0);
  return echo.new_echo ? fresh : known;
}

std::vector<double> timesOf(std::size_t values, double spacing) {
  std::vector<double> times(values);
  for (std::size_t i = 0; i < values; ++i) times[i] = spacing * static_cast<double>(i);
  return times;
}

void drawKey(Canvas& canvas, double y) {
  const TextStyle style;
  double x = kPlotMargin;
  const auto name = [&](const std::string& text) {
    x = canvas.text(text, {x + 16.0, y}, style).right() + 28.0;
  };
  canvas.marker(Marker::disk, {x + 4.0, y}, 5.0, ink::black);
  name("samples");
  canvas.line({x - 10.0, y}, {x + 12.0, y}, 2.0, ink::after);
  name("adjusted waveform");
  for (const bool fresh : {false, true}) {
    canvas.marker(Marker::triangle, {x + 4.0, y}, 10.0, colorOf({0.0, 0.0, fresh}));
    name(fresh ? "new echo" : "echo of a return");
  }
  canvas.line({x + 4.0, y - 9.0}, {x + 4.0, y + 9.0}, 1.5, ink::gray);
  name("discrete return");
  canvas.text("below: residuals, with lines at ±2 standard deviations", {x, y}, style);
}

/// Samples, adjusted waveform, echoes and returns.
void drawSamples(Canvas& canvas, const WaveformPlot::Panel& panel, const PixelBox& box,
                 const Axis& x, bool with_label) {
  std::vector<double> values = panel.samples;
  values.insert(values.end(), panel.model.begin(), panel.model.end());
  Axis y = Axis::around(values, with_label ? "counts" : "");
  y.high += 0.12 * (y.high - y.low);  // for the marks of echoes
  Axis top = x;
  top.ticks = false;
  Axes axes(canvas, box, top, y);
  for (const double time : panel.returns) axes.verticalLine(time, 1.5, ink::gray);
  const double spacing = panel.spacing * static_cast<double>(panel.samples.size() - 1) /
                         static_cast<double>(std::max<std::size_t>(2, panel.model.size()) - 1);
  axes.line(timesOf(panel.model.size(), spacing), panel.model, 2.0, ink::after);
  axes.points(timesOf(panel.samples.size(), panel.spacing), panel.samples, 4.0, ink::black);
  for (const WaveformPlot::Echo& echo : panel.echoes)
    axes.points({echo.time}, {panel.baseline + echo.amplitude + 0.06 * (y.high - y.low)}, 10.0,
                colorOf(echo), Marker::triangle);
  TextStyle bold;
  bold.size = 14.0;
  bold.bold = true;
  axes.drawFrame(detail::shortened(panel.title, box.width, bold));
}

void drawResiduals(Canvas& canvas, const WaveformPlot::Panel& panel, const PixelBox& box,
                   const Axis& x) {
  double largest = 1.5 * kNoiseLines * panel.noise;
  for (const double residual : panel.residuals) largest = std::max(largest, std::abs(residual));
  Axes axes(canvas, box, x, Axis::around({-largest, largest}, ""));
  for (const double factor : {-kNoiseLines, 0.0, kNoiseLines})
    axes.horizontalLine(factor * panel.noise, 1.0, ink::gray);
  axes.points(timesOf(panel.residuals.size(), panel.spacing), panel.residuals, 3.5, ink::black);
  axes.drawFrame();
}

}  // namespace

Canvas drawWaveforms(const WaveformPlot& plot, PictureSize size) {
  if (plot.panels.empty()) throw UsageError("plot '" + plot.title + "': contains no waveform");
  for (const WaveformPlot::Panel& panel : plot.panels)
    if (panel.samples.empty())
      throw UsageError("plot '" + plot.title + "': a waveform has no samples");
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, plot.title);
  drawKey(canvas, top);
  const detail::PanelGrid grid(plot.panels.size(), size.width - kPlotMargin,
                               size.height - top - kKey - kLabel);
  if (grid.pitch_x < kLeft + 120.0 || grid.pitch_y < kHead + kFoot + 90.0)
    throw UsageError("plot '" + plot.title + "': the picture is too small for its waveforms");
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    const WaveformPlot::Panel& panel = plot.panels[i];
    const Eigen::Vector2d corner = grid.corner(i);
    const double width = grid.pitch_x - kLeft, height = grid.pitch_y - kHead - kFoot - kGap;
    const double upper = std::round((1.0 - kResidualShare) * height);
    const PixelBox box{kLeft + corner.x(), top + kKey + corner.y() + kHead, width, upper};
    Axis x;
    x.high =
        panel.spacing * static_cast<double>(std::max<std::size_t>(2, panel.samples.size()) - 1);
    drawSamples(canvas, panel, box, x, corner.x() == 0.0);
    drawResiduals(canvas, panel, {box.x, box.bottom() + kGap, width, height - upper}, x);
  }
  TextStyle label;
  label.horizontal = Align::center;
  canvas.text("time from the first sample, ns",
              {0.5 * (kLeft + size.width), size.height - 0.6 * kLabel}, label);
  return canvas;
}

}  // namespace pcl_als
