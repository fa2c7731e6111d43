// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/drawing/section_search.h>

namespace pcl_als {
namespace {

constexpr double kSmooth = 0.12;          // m: rms of a plane's points
constexpr double kLeastTangent = 0.2;     // 11 degrees
constexpr double kMostTangent = 1.7;      // 60 degrees: steeper are walls
constexpr double kSameSurface = 0.97;     // cosine between the strips' normals: 14 degrees
constexpr double kFarthestSurface = 2.0;  // m: strips further apart cover different objects
constexpr double kRoofTangent = 0.3;      // 17 degrees: flatter crests are round ones of the ground
constexpr double kWidestRoof = 30.0;      // m, between the sides of a gable
constexpr double kOpposite = -0.85;       // cosine between the directions of fall: 148 degrees
constexpr double kSameFace = 0.97;        // the same within a face: 14 degrees
constexpr double kInFace = 0.06;          // m: how far a cell of a face may lie from its plane
constexpr std::size_t kFaceCells = 3;     // of 3 x 3: smaller is a dormer, a bush or a heap
constexpr double kFaceArea = 12.0;        // m2: so large a face may have fewer, larger cells
constexpr double kSharp = 0.25;           // m: how far the surface may lie below the sharp ridge
constexpr double kAboveGround = 1.5;      // m: height of a roof's face above the ground beside it
constexpr double kEaves = 12.0;           // m: within which the ground beside a roof is searched
constexpr double kMinimumSpacing = 25.0;  // m, between places

/// Rank of a place: the misfit, with a constant for slopes without one, and the number of strips.
double rankOf(const SectionSearch::Place& place) {
  return (place.difference + 0.02) * std::sqrt(static_cast<double>(place.strips)) *
         (place.kind == SectionSearch::Place::Kind::gable ? 1.5 : 1.0);
}

SectionLine lineThrough(const Eigen::Vector2d& middle, const Eigen::Vector2d& direction,
                        double half_length, double half_width) {
  // Drawn from west to east (from south to north where it runs so), as maps are read.
  const bool turned =
      direction.x() < -1e-9 || (std::abs(direction.x()) <= 1e-9 && direction.y() < 0);
  const Eigen::Vector2d along = turned ? Eigen::Vector2d(-direction) : direction;
  return {middle - half_length * along, middle + half_length * along, half_width};
}

}  // namespace

SectionSearch::SectionSearch(const Eigen::Vector2d& minimum, const Eigen::Vector2d& maximum,
                             double cell, std::size_t strips) {
  const Eigen::Vector2d size = (maximum - minimum).cwiseMax(1e-3);
  const double cells = static_cast<double>(PlaneGrid::kMostCells) /
                       static_cast<double>(std::max<std::size_t>(1, strips));
  cell = std::max(cell, std::sqrt(size.x() * size.y() / cells));
  for (std::size_t i = 0; i < strips; ++i) grids_.emplace_back(minimum, maximum, cell);
}

std::optional<SectionSearch::Slope> SectionSearch::slopeAt(int column, int row) const {
  std::vector<CellPlane> planes;
  for (const PlaneGrid& grid : grids_) {
    const auto plane = grid.plane(column, row);
    if (!plane || plane->rms > kSmooth) continue;
    const double tangent = std::hypot(plane->slope_x, plane->slope_y);
    if (tangent < kLeastTangent || tangent > kMostTangent) continue;
    planes.push_back(*plane);
  }
  if (planes.size() < 2) return std::nullopt;
  double low = planes[0].height, high = low;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double height = 0.0;
  for (const CellPlane& plane : planes) {
    if (plane.normal().dot(planes[0].normal()) < kSameSurface) return std::nullopt;
    low = std::min(low, plane.height);
    high = std::max(high, plane.height);
    normal += plane.normal();
    height += plane.height / static_cast<double>(planes.size());
  }
  if (high - low > kFarthestSurface) return std::nullopt;
  Slope slope;
  slope.center = planes[0].center;
  slope.downhill = normal.head<2>().normalized();
  slope.tangent = normal.head<2>().norm() / normal.z();
  slope.height = height;
  slope.difference = high - low;
  slope.strips = planes.size();
  return slope;
}

std::optional<SectionSearch::Place> SectionSearch::oppositeOf(
    const Slopes& slopes, const std::pair<int, int>& cell) const {
  const Slope& side = slopes.at(cell);
  const double step = grids_[0].cell();
  for (double distance = step; distance <= kWidestRoof; distance += step) {
    const Eigen::Vector2d shift = -distance * side.downhill / step;
    const auto found = slopes.find({cell.first + static_cast<int>(std::lround(shift.y())),
                                    cell.second + static_cast<int>(std::lround(shift.x()))});
    if (found == slopes.end()) continue;
    const Slope& other = found->second;
    if (other.downhill.dot(side.downhill) > kOpposite) continue;
    // Both sides rise to about the same ridge.
    const double apart = (other.center - side.center).norm();
    const double ridge = side.height + 0.5 * apart * side.tangent;
    if (std::abs(other.height + 0.5 * apart * other.tangent - ridge) > 0.35 * apart) continue;
    Place place;
    place.kind = isGable(slopes, side, other) ? Place::Kind::gable : Place::Kind::opposite_slopes;
    place.strips = std::min(side.strips, other.strips);
    place.difference = 0.5 * (side.difference + other.difference);
    const Eigen::Vector2d across = (side.downhill - other.downhill).normalized();
    place.line = lineThrough(0.5 * (side.center + other.center), across,
                             0.5 * apart + std::max(8.0, 2.0 * step), std::max(1.0, 0.75 * step));
    return place;
  }
  return std::nullopt;
}

/// Height of the surface in the cell of a place: mean over the strips that cover it, if any.
std::optional<double> SectionSearch::surfaceAt(const Eigen::Vector2d& place) const {
  double sum = 0.0, n = 0.0;
  for (const PlaneGrid& grid : grids_) {
    const auto plane = grid.planeAt(place.x(), place.y());
    if (!plane) continue;
    sum += plane->height;
    n += 1.0;
  }
  if (n == 0.0) return std::nullopt;
  return sum / n;
}

/// Cells around a face's that lie in its plane, itself among them.
std::size_t SectionSearch::faceCells(const Slopes& slopes, const Slope& face) const {
  std::size_t count = 0;
  const std::pair<int, int> middle = grids_[0].cellOf(face.center);
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const auto found = slopes.find({middle.first + row, middle.second + column});
      if (found == slopes.end()) continue;
      const Slope& slope = found->second;
      if (slope.downhill.dot(face.downhill) < kSameFace) continue;
      // Misfits between strips change a cell's mean height with the strips that cover it.
      const double misfit = std::max(slope.difference, face.difference);
      if (std::abs(slope.height - face.heightAt(slope.center)) < kInFace + misfit) ++count;
    }
  }
  return count;
}

/// Whether the ground beyond the lower edge of a face is well below the face.
bool SectionSearch::fallsBeyond(const Slope& face) const {
  const double step = grids_[0].cell();
  for (double distance = step; distance <= kEaves; distance += step) {
    const auto height = surfaceAt(face.center + distance * face.downhill);
    if (height && *height < face.height - kAboveGround) return true;
  }
  return false;
}

bool SectionSearch::isGable(const Slopes& slopes, const Slope& side, const Slope& other) const {
  if (std::min(side.tangent, other.tangent) < kRoofTangent) return false;
  if (!fallsBeyond(side) && !fallsBeyond(other)) return false;
  // Between the faces the surface is the lower of the two planes, up to the ridge.
  const double step = grids_[0].cell();
  const Eigen::Vector2d between = other.center - side.center;
  const double apart = between.norm();
  for (double distance = step; distance < apart; distance += step) {
    const Eigen::Vector2d place = side.center + distance / apart * between;
    const auto height = surfaceAt(place);
    const double roof = std::min(side.heightAt(place), other.heightAt(place));
    // The mean of a cell with the ridge in it is lower by a quarter of the fall from ridge to rim,
    // and the cell's centre may lie half a cell aside.
    const double allowed = kSharp + 0.5 * step * std::max(side.tangent, other.tangent) +
                           std::max(side.difference, other.difference);
    if (!height || std::abs(*height - roof) > allowed) return false;
  }
  const auto enough = [&](std::size_t cells) {
    return cells >= kFaceCells || static_cast<double>(cells) * step * step >= kFaceArea;
  };
  return enough(faceCells(slopes, side)) && enough(faceCells(slopes, other));
}

std::optional<SectionSearch::Place> SectionSearch::slopeAround(
    const Slopes& slopes, const std::pair<int, int>& cell) const {
  const Slope& middle = slopes.at(cell);
  std::size_t alike = 0;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const auto found = slopes.find({cell.first + row, cell.second + column});
      if (found != slopes.end() && found->second.downhill.dot(middle.downhill) > 0.9) ++alike;
    }
  }
  if (alike < 7) return std::nullopt;
  Place place;
  place.strips = middle.strips;
  place.difference = middle.difference;
  const double step = grids_[0].cell();
  place.line = lineThrough(middle.center, middle.downhill, std::max(12.0, 3.0 * step),
                           std::max(1.0, 0.75 * step));
  return place;
}

std::vector<SectionSearch::Place> SectionSearch::find(std::size_t most) const {
  Slopes slopes;
  if (grids_.size() < 2) return {};
  for (int row = 0; row < grids_[0].rows(); ++row) {
    for (int column = 0; column < grids_[0].columns(); ++column) {
      if (auto slope = slopeAt(column, row)) slopes.emplace(std::make_pair(row, column), *slope);
    }
  }
  std::vector<Place> places;
  for (const auto& entry : slopes) {
    if (auto place = oppositeOf(slopes, entry.first)) places.push_back(*place);
    if (auto place = slopeAround(slopes, entry.first)) places.push_back(*place);
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return rankOf(a) > rankOf(b); });
  std::vector<Place> chosen;
  for (const Place& place : places) {
    if (chosen.size() >= most) break;
    const auto near = [&](const Place& other) {
      return (0.5 * (place.line.from + place.line.to) - 0.5 * (other.line.from + other.line.to))
                 .norm() < kMinimumSpacing;
    };
    if (std::none_of(chosen.begin(), chosen.end(), near)) chosen.push_back(place);
  }
  return chosen;
}

}  // namespace pcl_als
