// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/drawing/axes.h>
#include <pcl_als/drawing/calibration_plots.h>
#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/row_plots.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kNormal95;
using detail::kPlotMargin;

/// Rows of one unit, which share an axis.
struct UnitGroup {
  std::string unit, label;
  std::vector<SystemParameterInfo> rows;
};

std::vector<UnitGroup> unitGroups() {
  std::vector<UnitGroup> groups = {{"arcsec", "boresight bias, arcsec", {}},
                                   {"m", "bias, m", {}},
                                   {"1", "bias of the scan angle scale, 1", {}}};
  for (const SystemParameterInfo& info : systemParameters()) {
    for (UnitGroup& group : groups) {
      if (group.unit == info.unit) group.rows.push_back(info);
    }
  }
  return groups;
}

void drawParameterGroup(Canvas& canvas, const CalibrationResult& result, const UnitGroup& group,
                        const PixelBox& box) {
  std::vector<double> reach;
  for (const SystemParameterInfo& info : group.rows) {
    const ParameterEstimate& estimate = result[info.parameter];
    if (estimate.status != ParameterStatus::estimated) continue;
    const double bias = estimate.bias / info.internal_per_unit;
    const double half = kNormal95 * estimate.std / info.internal_per_unit;
    reach.insert(reach.end(), {bias - half, bias + half, 0.0});
  }
  Axis y;
  y.high = static_cast<double>(group.rows.size());
  y.ticks = false;
  Axes axes(canvas, box, Axis::around(reach, group.label), y);
  if (!reach.empty()) axes.verticalLine(0.0, 1.5, ink::gray);
  const double right = box.right() + 20.0;
  TextStyle name, value;
  name.size = value.size = 15.0;
  name.horizontal = Align::high;
  for (std::size_t i = 0; i < group.rows.size(); ++i) {
    const SystemParameterInfo& info = group.rows[i];
    const ParameterEstimate& estimate = result[info.parameter];
    const bool known = estimate.status == ParameterStatus::estimated;
    const double at = y.high - static_cast<double>(i) - 0.5;
    const double pixel_y = axes.pixel(0.0, at).y();
    name.color = value.color = known ? ink::black : ink::gray;
    canvas.text(plainName(info.parameter), {box.x - 14.0, pixel_y}, name);
    const double available = canvas.width() - kPlotMargin - right;
    value.size = known ? 15.0 : 13.0;
    const auto lines = detail::wrapped(estimateText(info.parameter, estimate), available, value, 3);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const double shift = static_cast<double>(k) - 0.5 * static_cast<double>(lines.size() - 1);
      canvas.text(lines[k], {right, pixel_y + 17.0 * shift}, value);
    }
    if (!known) continue;
    const double bias = estimate.bias / info.internal_per_unit;
    const double half = kNormal95 * estimate.std / info.internal_per_unit;
    const Eigen::Vector2d low = axes.pixel(bias - half, at), high = axes.pixel(bias + half, at);
    canvas.line(low, high, 3.0, ink::after);
    for (const Eigen::Vector2d& end : {low, high}) {
      canvas.fill({end.x() - 1.0, end.y() - 8.0, 2.0, 16.0}, ink::after);
    }
    canvas.marker(Marker::disk, axes.pixel(bias, at), 9.0, ink::after);
  }
  axes.drawFrame();
}

std::vector<double> numbersTo(std::size_t count) {
  std::vector<double> numbers;
  for (std::size_t i = 1; i <= count; ++i) numbers.push_back(static_cast<double>(i));
  return numbers;
}

}  // namespace

Canvas drawParameters(const CalibrationResult& result, PictureSize size) {
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, "Biases (assumed − true) with 95 % intervals");
  TextStyle note;
  note.color = ink::gray;
  canvas.text("right: bias ± standard deviation", {kPlotMargin, top + 4.0}, note);
  const std::vector<UnitGroup> groups = unitGroups();
  constexpr double kFoot = 72.0, kHead = 24.0;
  const double row = (size.height - top - kHead - kFoot * static_cast<double>(groups.size())) /
                     static_cast<double>(kSystemParameterCount);
  double y = top + kHead;
  for (const UnitGroup& group : groups) {
    const double height = row * static_cast<double>(group.rows.size());
    drawParameterGroup(canvas, result, group, {210.0, y, 0.5 * size.width, height});
    y += height + kFoot;
  }
  return canvas;
}

Canvas drawCorrelation(const CalibrationResult& result, PictureSize size) {
  const auto count = result.correlation_order.size();
  if (count == 0) throw UsageError("plot of correlations: no parameter was estimated");
  detail::HeatMap heat;
  for (const SystemParameter parameter : result.correlation_order) {
    heat.rows.push_back(plainName(parameter));
  }
  heat.columns = heat.rows;
  for (std::size_t r = 0; r < count; ++r) {
    auto& shade = heat.shade.emplace_back();
    auto& text = heat.texts.emplace_back();
    for (std::size_t c = 0; c < count; ++c) {
      const double value =
          result.correlation(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
      shade.push_back(0.5 * (value + 1.0));
      text.push_back(numberText(value, 2));
    }
  }
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, "Correlation of the estimated parameters");
  const ColorMap map = ColorMap::named("diverging");
  const PixelBox cells = detail::drawHeatMap(
      canvas, heat, map, {kPlotMargin, top, size.width - 240.0, size.height - top - kPlotMargin});
  const double height = std::clamp(cells.height - 40.0, 60.0, 400.0);
  drawColorBar(canvas, map, -1.0, 1.0, "correlation",
               {cells.right() + 50.0, cells.y + 30.0, 24.0, height});
  return canvas;
}

Canvas drawConvergence(const CalibrationResult& result, PictureSize size) {
  if (result.iterations.empty()) throw UsageError("plot of convergence: no iterations");
  std::vector<double> sigma0, update;
  for (const CalibrationIteration& iteration : result.iterations) {
    sigma0.push_back(iteration.sigma0);
    update.push_back(iteration.largest_update > 0.0 ? iteration.largest_update
                                                    : std::numeric_limits<double>::quiet_NaN());
  }
  Canvas canvas(size.width, size.height);
  const double top =
      detail::drawTitle(canvas, result.converged ? "Convergence" : "Convergence (not reached)");
  const std::vector<double> number = numbersTo(result.iterations.size());
  Axis x = Axis::around(number, "iteration");
  x.low = 0.5;
  x.high = static_cast<double>(number.size()) + 0.5;
  const double width = 0.5 * size.width - 130.0, height = size.height - top - 120.0;
  Axis large = Axis::around(update, "largest effect of the update on a point, m");
  double low = INFINITY, high = 0.0;
  for (const double value : update) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (high > 0.0) {
    large.logarithmic = true;
    large.low = std::pow(10.0, std::floor(std::log10(low) - 1e-9));
    large.high = std::pow(10.0, std::ceil(std::log10(high) + 1e-9));
  }
  Axes left(canvas, {110.0, top + 36.0, width, height}, x, large);
  left.line(number, update, 2.0, ink::after);
  left.points(number, update, 8.0, ink::after);
  left.drawFrame("Update");
  Axes right(canvas, {width + 230.0, top + 36.0, width, height}, x,
             Axis::around(sigma0, "sigma0", true));
  right.line(number, sigma0, 2.0, ink::after);
  right.points(number, sigma0, 8.0, ink::after);
  right.drawFrame("Fit");
  return canvas;
}

Canvas drawPairs(const CalibrationResult& result, PictureSize size) {
  BeforeAfterPlot plot;
  plot.title = "Fit of overlapping strips before and after";
  plot.x_label = "RMS of the normal distances, m";
  for (const PairFit& pair : result.pairs) {
    plot.rows.push_back({pair.a + " : " + pair.b, pair.rms_before, pair.rms_after});
  }
  constexpr std::size_t kMaximumBars = 60;
  if (plot.rows.size() > kMaximumBars)
    plot.title += " (the " + std::to_string(kMaximumBars) + " largest)";
  plot.keepLargest(kMaximumBars);
  return drawBeforeAfter(plot, size);
}

Canvas drawResiduals(const CalibrationResult& result, PictureSize size) {
  HistogramPlot plot;
  plot.title = "Normal distances of point-patch pairs";
  plot.x_label = "normal distance, m";
  plot.edges = result.residuals.edges;
  const auto& before = result.residuals.before;
  const auto& after = result.residuals.after;
  plot.series = {{"before", {before.begin(), before.end()}},
                 {"after", {after.begin(), after.end()}}};
  if (plot.edges.empty()) throw UsageError("plot of residuals: the result has no histogram");
  return drawHistogram(plot, size);
}

Canvas drawScanAngleCurve(const CalibrationResult& result, PictureSize size) {
  if (result.scan_angle_curve.empty())
    throw UsageError("plot of scan angle errors: none in the result");
  CurvePlot plot{
      "Errors of the scan angle", "scan angle, degrees (left positive)", "error, arcsec", {}};
  CurvePlot::Series& series = plot.series.emplace_back();
  series.name = "estimate, +- std";
  for (const AngleError& error : result.scan_angle_curve) {
    series.x.push_back(error.angle / kRadiansPerDegree);
    series.y.push_back(error.error / kRadiansPerArcsec);
    series.std.push_back(error.std / kRadiansPerArcsec);
  }
  return drawCurves(plot, size);
}

Canvas drawStripErrors(const CalibrationResult& result, PictureSize size) {
  if (result.strip_errors.empty()) throw UsageError("plot of strip errors: none in the result");
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, "What each strip's trajectory is wrong by");
  static const char* const kLabels[6] = {"east, mm",      "north, mm",    "up, mm",
                                         "pitch, arcsec", "roll, arcsec", "heading, arcsec"};
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < result.strip_errors.size(); ++i) {
    entries.push_back(
        {detail::shortened(result.strip_errors[i].id, 150.0, {}), categoryColor(i), true});
  }
  entries = detail::fitting(std::move(entries), size.height - top - 20.0 - kPlotMargin);
  const double legend = std::max(legendSize(entries, "strip").x(), 60.0);
  const double panel_w = (size.width - legend - 2.0 * kPlotMargin) / 3.0;
  const double panel_h = (size.height - top - 10.0) / 2.0;
  for (int k = 0; k < 6; ++k) {
    std::vector<double> all_t = {0.0}, all_v = {0.0};
    std::vector<std::vector<double>> t, v;
    for (const StripErrors& strip : result.strip_errors) {
      auto& time = t.emplace_back();
      auto& value = v.emplace_back();
      for (const TrajectoryErrorKnot& knot : strip.knots) {
        time.push_back(knot.time - strip.knots.front().time);
        value.push_back(k < 3 ? 1e3 * knot.position[k] : knot.angles[k - 3] / kRadiansPerArcsec);
      }
      all_t.insert(all_t.end(), time.begin(), time.end());
      all_v.insert(all_v.end(), value.begin(), value.end());
    }
    const PixelBox box{100.0 + panel_w * (k % 3), top + 20.0 + panel_h * (k / 3), panel_w - 110.0,
                       panel_h - 90.0};
    Axes axes(canvas, box, Axis::around(all_t, "s from the strip's start", true),
              Axis::around(all_v, kLabels[k]));
    axes.horizontalLine(0.0, 1.0, ink::gray);
    for (std::size_t i = 0; i < t.size(); ++i) axes.line(t[i], v[i], 2.0, categoryColor(i));
    axes.drawFrame();
  }
  drawLegend(canvas, entries, "strip", {size.width - legend - kPlotMargin, top + 20.0});
  return canvas;
}

}  // namespace pcl_als
