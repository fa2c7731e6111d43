// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/block_map.h>
#include <pcl_als/drawing/map_furniture.h>

#include "plot_parts.h"

namespace pcl_als {
namespace {

using detail::kPlotMargin;

constexpr double kMostCells = 16e6, kMostSide = 1000.0;
constexpr double kPanel = 220.0, kLeft = 100.0, kFoot = 44.0, kTitleHeight = 64.0;  // pixels
constexpr double kRim = 3.0;  // cells around the block, so that outlines are complete
const Color kAreaColor = Color::rgb(0xd55e00);
const Color kPathColor = Color::rgb(0xcc0033);

Color overlapColor(int strips) {
  static const std::array<Color, 5> shades = {ink::white, Color::rgb(0xe9eef2),
                                              Color::rgb(0xc3d7e6), Color::rgb(0x8db6d3),
                                              Color::rgb(0x4f8fba)};
  return shades[static_cast<std::size_t>(std::min(strips, 4))];
}

/// Metres from west to east and south to north that a map shows.
Eigen::Vector2d shownExtent(const StripCoverage& coverage) {
  return coverage.cell() *
         Eigen::Vector2d(coverage.columns() + 2.0 * kRim, coverage.rows() + 2.0 * kRim);
}

/// Ground to pixels.
struct MapFrame {
  PixelBox box;
  Eigen::Vector2d north_west;
  double metres_per_pixel;

  Eigen::Vector2d pixel(const Eigen::Vector2d& ground) const {
    return {box.x + (ground.x() - north_west.x()) / metres_per_pixel,
            box.y + (north_west.y() - ground.y()) / metres_per_pixel};
  }
};

void drawOverlaps(Canvas& canvas, const StripCoverage& coverage, const MapFrame& frame) {
  Image overlaps(static_cast<int>(frame.box.width), static_cast<int>(frame.box.height));
  for (int y = 0; y < overlaps.height; ++y) {
    for (int x = 0; x < overlaps.width; ++x) {
      const Eigen::Vector2d ground =
          frame.north_west + frame.metres_per_pixel * Eigen::Vector2d(x + 0.5, -(y + 0.5));
      const Eigen::Vector2d at = (ground - coverage.minimum()) / coverage.cell();
      int strips = 0;
      for (std::size_t s = 0; s < coverage.strips(); ++s) {
        if (coverage.covers(s, static_cast<int>(std::floor(at.x())),
                            static_cast<int>(std::floor(at.y())))) {
          ++strips;
        }
      }
      if (strips > 0) overlaps.at(x, y) = overlapColor(strips);
    }
  }
  canvas.draw(overlaps, frame.box);
}

/// Sides of cells with a point towards cells without.
void drawOutline(Canvas& canvas, const StripCoverage& coverage, std::size_t strip,
                 const MapFrame& frame, const Color& color) {
  const auto corner = [&](int column, int row) {
    return frame.pixel(coverage.minimum() + coverage.cell() * Eigen::Vector2d(column, row));
  };
  for (int row = 0; row < coverage.rows(); ++row) {
    for (int column = 0; column < coverage.columns(); ++column) {
      if (!coverage.covers(strip, column, row)) continue;
      const auto side = [&](int dc, int dr, int from_c, int from_r, int to_c, int to_r) {
        if (coverage.covers(strip, column + dc, row + dr)) return;
        canvas.line(corner(column + from_c, row + from_r), corner(column + to_c, row + to_r), 2.0,
                    color);
      };
      side(-1, 0, 0, 0, 0, 1);
      side(1, 0, 1, 0, 1, 1);
      side(0, -1, 0, 0, 1, 0);
      side(0, 1, 0, 1, 1, 1);
    }
  }
}

/// Fills holes of one or two cells, so that outlines follow the border of a strip.
StripCoverage closed(const StripCoverage& coverage) {
  StripCoverage result = coverage;
  for (std::size_t s = 0; s < coverage.strips(); ++s) {
    for (int row = 0; row < coverage.rows(); ++row) {
      for (int column = 0; column < coverage.columns(); ++column) {
        if (coverage.covers(s, column, row)) continue;
        const auto any = [&](int dc, int dr) {
          return coverage.covers(s, column + dc, row + dr) ||
                 coverage.covers(s, column + 2 * dc, row + 2 * dr);
        };
        if ((any(-1, 0) && any(1, 0)) || (any(0, -1) && any(0, 1))) {
          const Eigen::Vector2d center =
              coverage.minimum() + coverage.cell() * Eigen::Vector2d(column + 0.5, row + 0.5);
          result.add({center.x(), center.y(), 0.0}, s);
        }
      }
    }
  }
  return result;
}

void drawAreas(Canvas& canvas, const std::vector<BlockMap::Area>& areas, const MapFrame& frame) {
  for (const BlockMap::Area& area : areas) {
    const Eigen::Vector2d low = frame.pixel({area.minimum.x(), area.maximum.y()});
    const Eigen::Vector2d high = frame.pixel({area.maximum.x(), area.minimum.y()});
    const PixelBox box{low.x(), low.y(), std::max(2.0, high.x() - low.x()),
                       std::max(2.0, high.y() - low.y())};
    canvas.fill(box, kAreaColor.withAlpha(45));
    canvas.frame(box, 1.0, kAreaColor.withAlpha(190));
  }
}

/// A path with a cross of its enlarged standard deviations at about \a kCrosses places.
void drawPath(Canvas& canvas, const BlockMap::Path& path, double enlargement,
              const MapFrame& frame) {
  constexpr std::size_t kCrosses = 12;
  for (std::size_t i = 1; i < path.places.size(); ++i)
    canvas.line(frame.pixel(path.places[i - 1]), frame.pixel(path.places[i]), 3.0, ink::black);
  const std::size_t step = std::max<std::size_t>(1, path.places.size() / kCrosses);
  for (std::size_t i = 0; i < path.places.size(); i += step) {
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d arm =
          enlargement * path.std[i][axis] * Eigen::Vector2d(Eigen::Vector2d::Unit(axis));
      canvas.line(frame.pixel(path.places[i] - arm), frame.pixel(path.places[i] + arm), 2.0,
                  kPathColor);
    }
  }
}

/// Marked parts as strokes, then their labels beside the middle of each, on disks.
void drawMarks(Canvas& canvas, const std::vector<BlockMap::Mark>& marks, const MapFrame& frame) {
  struct Label {
    Eigen::Vector2d at;
    std::string text;
  };
  constexpr double kWidth = 6.0, kCasing = 10.0, kDisk = 24.0, kLabelOffset = 22.0;  // pixels
  std::vector<Label> labels;
  for (const auto& [width, color] : {std::pair(kCasing, ink::white), {kWidth, kPathColor}}) {
    for (const BlockMap::Mark& mark : marks) {
      const Eigen::Vector2d from = frame.pixel(mark.begin), to = frame.pixel(mark.end);
      canvas.line(from, to, width, color);
      for (const Eigen::Vector2d& end : {from, to}) canvas.marker(Marker::disk, end, width, color);
    }
  }
  for (const BlockMap::Mark& mark : marks) {
    const Eigen::Vector2d from = frame.pixel(mark.begin), to = frame.pixel(mark.end);
    // Beside the path, on its upper side.
    const Eigen::Vector2d way = to - from;
    Eigen::Vector2d aside = Eigen::Vector2d(way.y(), -way.x()).normalized();
    if (aside.y() > 0.0) aside = -aside;
    const Eigen::Vector2d at = 0.5 * (from + to) + kLabelOffset * aside;
    const auto near = std::find_if(labels.begin(), labels.end(), [&](const Label& label) {
      return (label.at - at).norm() < kDisk;
    });
    if (near != labels.end())
      near->text += ", " + mark.label;
    else
      labels.push_back({at, mark.label});
  }
  const TextStyle style{14.0, ink::white, true, false, Align::center, Align::center};
  for (const Label& label : labels) {
    const double half = 0.5 * std::max(0.0, Canvas::textSize(label.text, style).x() - 8.0);
    const Eigen::Vector2d across(half, 0.0);
    canvas.line(label.at - across, label.at + across, kDisk, kPathColor);
    for (const double side : {-1.0, 1.0})
      canvas.marker(Marker::disk, label.at + side * across, kDisk, kPathColor);
    canvas.text(label.text, label.at, style);
  }
}

/// Legends of strips and of the number of strips, from \a corner downwards; returns the height
/// below them.
double drawStripLegends(Canvas& canvas, const std::vector<std::string>& names,
                        const Eigen::Vector2d& corner) {
  std::vector<LegendEntry> strips, counts;
  for (std::size_t s = 0; s < std::min<std::size_t>(names.size(), 16); ++s) {
    strips.push_back({detail::shortened(names[s], 150.0, {}), categoryColor(s), true});
  }
  if (names.size() > strips.size()) {
    strips.push_back({"and " + std::to_string(names.size() - strips.size()) + " more", ink::white});
  }
  for (int n = 1; n <= 4; ++n) {
    counts.push_back({std::to_string(n) + (n == 4 ? " or more" : ""), overlapColor(n)});
  }
  double y = corner.y();
  drawLegend(canvas, strips, "outlines of strips", {corner.x(), y});
  y += legendSize(strips, "x").y() + 16.0;
  drawLegend(canvas, counts, "strips at a place", {corner.x(), y});
  return y + legendSize(counts, "x").y() + 16.0;
}

}  // namespace

StripCoverage::StripCoverage(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
                             std::size_t strips)
    : minimum_(minimum) {
  const Eigen::Vector2d size = (maximum - minimum).cwiseMax(1e-3);
  if (!size.allFinite() || strips == 0) throw UsageError("a coverage needs strips with an extent");
  const double share = std::sqrt(size.x() * size.y() * static_cast<double>(strips) / kMostCells);
  cell_ = std::max({share, size.maxCoeff() / 250.0, size.maxCoeff() / kMostSide});
  columns_ = static_cast<int>(size.x() / cell_) + 1;
  rows_ = static_cast<int>(size.y() / cell_) + 1;
  cells_.assign(strips, std::vector<char>(static_cast<std::size_t>(columns_) *
                                          static_cast<std::size_t>(rows_)));
}

void StripCoverage::add(const Eigen::Vector3d& ground, std::size_t strip) {
  const double column = std::floor((ground.x() - minimum_.x()) / cell_);
  const double row = std::floor((ground.y() - minimum_.y()) / cell_);
  if (!(column >= 0.0 && row >= 0.0 && column < columns_ && row < rows_)) return;
  cells_[strip][static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                static_cast<std::size_t>(column)] = 1;
}

bool StripCoverage::covers(std::size_t strip, int column, int row) const {
  if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
  return cells_[strip][static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)] != 0;
}

int BlockMap::heightFor(const StripCoverage& coverage, int width, int lowest, int highest) {
  const Eigen::Vector2d extent = shownExtent(coverage);
  const double across = width - kLeft - kPanel - kPlotMargin;
  const double height = across * extent.y() / extent.x() + kFoot + kTitleHeight;
  // The panel beside the map has the legends, the north arrow and the scale bar.
  const auto rows = static_cast<double>(std::min<std::size_t>(coverage.strips(), 17) + 8);
  const double panel = kTitleHeight + 23.0 * rows + 200.0;
  return static_cast<int>(
      std::clamp(std::ceil(std::max(height, panel)), 1.0 * lowest, 1.0 * highest));
}

Canvas BlockMap::draw(const StripCoverage& coverage, const std::vector<std::string>& names,
                      PictureSize size) const {
  if (names.size() != coverage.strips())
    throw UsageError("a block map needs a name for each strip");
  Canvas canvas(size.width, size.height);
  const double top = detail::drawTitle(canvas, title_);
  const double rim = kRim * coverage.cell();
  const Eigen::Vector2d extent = shownExtent(coverage);
  const double available_width = size.width - kLeft - kPanel - kPlotMargin,
               available_height = size.height - top - kFoot;
  if (available_width < 100.0 || available_height < 100.0)
    throw UsageError("a picture too small for a block map");
  MapFrame frame;
  frame.metres_per_pixel = std::max(extent.x() / available_width, extent.y() / available_height);
  frame.box = {kLeft, std::round(top), std::floor(extent.x() / frame.metres_per_pixel),
               std::floor(extent.y() / frame.metres_per_pixel)};
  frame.north_west = coverage.minimum() + Eigen::Vector2d(-rim, extent.y() - rim);
  const StripCoverage whole = closed(coverage);
  drawOverlaps(canvas, whole, frame);
  canvas.setClip(frame.box);
  drawAreas(canvas, areas_, frame);
  for (std::size_t s = 0; s < coverage.strips(); ++s) {
    drawOutline(canvas, whole, s, frame, categoryColor(s));
  }
  for (const Eigen::Vector2d& point : control_) {
    canvas.marker(Marker::triangle, frame.pixel(point), 14.0, ink::white);
    canvas.marker(Marker::triangle, frame.pixel(point), 10.0, ink::black);
  }
  for (const Path& path : paths_) drawPath(canvas, path, enlargement_, frame);
  drawMarks(canvas, marks_, frame);
  canvas.clearClip();
  canvas.frame(frame.box, 1.0, ink::gray);
  drawCoordinates(canvas, frame.north_west, frame.metres_per_pixel, frame.box);

  const double left = frame.box.right() + kPlotMargin;
  double y = drawStripLegends(canvas, names, {left, frame.box.y});
  std::vector<LegendEntry> marks;
  if (!areas_.empty()) marks.push_back({"areas used", mix(ink::white, kAreaColor, 0.6)});
  if (!marks_.empty()) marks.push_back({marks_legend_, kPathColor, true});
  if (!marks.empty()) drawLegend(canvas, marks, "", {left, y});
  y += legendSize(marks, "").y();
  if (!control_.empty()) {
    canvas.marker(Marker::triangle, {left + 7.0, y + 10.0}, 10.0, ink::black);
    canvas.text("control points", {left + 25.0, y + 10.0});
  }
  const double foot = std::max(frame.box.bottom(), y + 150.0);
  if (foot <= size.height - 8.0) {
    drawScaleBar(canvas, frame.metres_per_pixel, 160.0, {left, foot});
    drawNorthArrow(canvas, {left + 20.0, foot - 84.0}, 44.0);
  }
  return canvas;
}

}  // namespace pcl_als
