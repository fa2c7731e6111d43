// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <Eigen/Geometry>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/photogrammetry/roof_lines.h>
#include <pcl_als/tin/surface_criterion.h>

#include "roof_faces.h"

namespace pcl_als {
namespace {

using namespace photogrammetry;
using Eigen::Vector3d;

constexpr double kMargin = 25.0;         ///< metres around a tile: more than half of most roofs
constexpr double kLeastStepShare = 0.2;  ///< of the border of a roof face
constexpr double kNearLine = 2.5;        ///< median edges from the line within which faces reach it
constexpr double kResolution = 0.001;    ///< metres, of the TIN
/// Share of the points beside a line that must lie on the roof of the two planes.
constexpr double kLeastFit = 0.8;
/// Metres beside a line whose points determine neither plane: footprints that reach over a ridge,
/// ridge tiles.
constexpr double kBesideLine = 0.2;
/// Median edges: side of the cells whose points may have common deviations from a plane.
constexpr double kCells = 3.0;

/// Intersection of two planes as a function of their six unknowns.
struct Crossing {
  Vector3d place, direction;
};

std::optional<Crossing> crossingOf(const FittedPlane& a, const FittedPlane& b) {
  Crossing crossing;
  const Vector3d na = a.normal(), nb = b.normal();
  const Vector3d direction = na.cross(nb);
  if (direction.norm() < 1e-6) return std::nullopt;
  crossing.direction = direction.normalized();
  const Vector3d middle = 0.5 * (a.centre + b.centre);
  // The point of the line nearest to the middle: na.p = da, nb.p = db, direction.p = 0.
  Eigen::Matrix3d rows;
  rows << na.transpose(), nb.transpose(), crossing.direction.transpose();
  const Vector3d on_a = a.centre + Vector3d(0.0, 0.0, a.unknown[0]);
  const Vector3d on_b = b.centre + Vector3d(0.0, 0.0, b.unknown[0]);
  crossing.place =
      middle + rows.inverse() * Vector3d(na.dot(on_a - middle), nb.dot(on_b - middle), 0.0);
  return crossing;
}

/// Offsets of a crossing from a line across it at both ends (left, up).
Eigen::Vector4d offsetsFrom(const ObjectLine& line, const Crossing& crossing) {
  const Vector3d along = (line.end - line.start).normalized();
  const Eigen::Matrix<double, 3, 2> across = acrossLine(along);
  Eigen::Vector4d offsets;
  for (int end = 0; end < 2; ++end) {
    const Vector3d at = end == 0 ? line.start : line.end;
    const double t = along.dot(at - crossing.place) / along.dot(crossing.direction);
    offsets.segment<2>(2 * end) =
        across.transpose() * (crossing.place + t * crossing.direction - at);
  }
  return offsets;
}

/// Covariance of the offsets of the intersection from those of the planes.
Eigen::Matrix4d covarianceOf(const ObjectLine& line, const FittedPlane& a, const FittedPlane& b) {
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
  for (const bool first : {true, false}) {
    Eigen::Matrix<double, 4, 3> derivative;
    for (int i = 0; i < 3; ++i) {
      FittedPlane moved = first ? a : b;
      const double step = std::max(1e-7, 0.1 * std::sqrt(moved.covariance(i, i)));
      moved.unknown[i] += step;
      const auto crossing = first ? crossingOf(moved, b) : crossingOf(a, moved);
      derivative.col(i) = offsetsFrom(line, *crossing) / step;
    }
    covariance += derivative * (first ? a : b).covariance * derivative.transpose();
  }
  return covariance;
}

/// An interval along a line.
struct Span {
  double low = std::numeric_limits<double>::max(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Lines of one TIN.
class LineFinder {
 public:
  LineFinder(const PatchSurface& surface, const RoofLineSettings& settings)
      : surface_(surface), settings_(settings), faces_(findFaces(surface, settings, face_of_)) {
    median_edge_ = typicalPlanEdge(surface.tin());
  }
  std::vector<StripLine> run() const;

 private:
  bool isRoof(const RoofFace& face) const {
    return face.area >= settings_.least_area && face.step_share >= kLeastStepShare &&
           face.plane.slope() >= settings_.least_slope && face.plane.slope() < settings_.steepest;
  }
  std::map<std::pair<int, int>, int> neighbours() const;
  Span spanOf(const RoofFace& face, const Crossing& crossing) const;
  std::optional<StripLine> lineOf(RoofFace a, RoofFace b) const;
  FittedPlane ownPlane(const RoofFace& face, const RoofFace& other) const;
  bool agreesNearby(const RoofFace& a, const RoofFace& b, const Crossing& crossing,
                    const Span& span, bool ridge) const;
  std::optional<StripLine> eaveOf(const RoofFace& face) const;

  const PatchSurface& surface_;
  const RoofLineSettings& settings_;
  std::vector<std::int32_t> face_of_;
  std::vector<RoofFace> faces_;
  double median_edge_ = 0.0;
};

/// Pairs of roof faces that touch, or are separated by one ring of triangles, with the number of
/// contacts.
std::map<std::pair<int, int>, int> LineFinder::neighbours() const {
  std::map<std::pair<int, int>, int> contacts;
  const auto& triangles = surface_.tin().triangles();
  const auto count = [&](std::int32_t a, std::int32_t b) {
    if (a >= 0 && b >= 0 && a != b) ++contacts[{std::min(a, b), std::max(a, b)}];
  };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::int32_t here = face_of_[t];
    std::vector<std::int32_t> around;
    for (const std::int32_t next : triangles[t].neighbour) {
      if (next == Tin::kNone) continue;
      const std::int32_t there = face_of_[static_cast<std::size_t>(next)];
      if (here >= 0) count(here, there);
      around.push_back(there);
      if (here >= 0 || there >= 0) continue;
      for (const std::int32_t beyond : triangles[static_cast<std::size_t>(next)].neighbour)
        if (beyond != Tin::kNone) around.push_back(face_of_[static_cast<std::size_t>(beyond)]);
    }
    if (here >= 0) continue;
    for (std::size_t i = 0; i < around.size(); ++i)
      for (std::size_t k = i + 1; k < around.size(); ++k) count(around[i], around[k]);
  }
  return contacts;
}

Span LineFinder::spanOf(const RoofFace& face, const Crossing& crossing) const {
  Span span;
  for (const std::int32_t v : face.vertices) {
    const Vector3d d = surface_.tin().points()[static_cast<std::size_t>(v)] - crossing.place;
    const double along = crossing.direction.dot(d);
    if ((d - along * crossing.direction).norm() < kNearLine * median_edge_) span.add(along);
  }
  return span;
}

/// The plane of the points of a face that are on its side of the line with another face, at some
/// distance from it. A face grows beyond the line by the points that are near its plane there,
/// which would turn it.
FittedPlane LineFinder::ownPlane(const RoofFace& face, const RoofFace& other) const {
  // Between the planes in plan: positive on the side of the face.
  const Eigen::Vector2d across = (face.plane.unknown - other.plane.unknown).tail<2>();
  const double least = kBesideLine * across.norm();
  const auto side = [&](const Vector3d& p) { return other.plane.above(p) - face.plane.above(p); };
  const double sign = side(face.plane.centre) < 0.0 ? -1.0 : 1.0;
  std::vector<std::int32_t> own;
  for (const std::int32_t v : face.vertices) {
    if (sign * side(surface_.tin().points()[static_cast<std::size_t>(v)]) > least) own.push_back(v);
  }
  if (static_cast<int>(own.size()) < settings_.least_points) return face.plane;
  return fitPlaneInCells(surface_.tin().points(), own, kCells * median_edge_);
}

/// Whether the points beside the line lie on the roof that the planes form: the lower plane of a
/// ridge, the upper one of a valley.
bool LineFinder::agreesNearby(const RoofFace& a, const RoofFace& b, const Crossing& crossing,
                              const Span& span, bool ridge) const {
  std::size_t all = 0, good = 0;
  const double limit = 4.0 * std::max({a.plane.sigma, b.plane.sigma, 0.01});
  for (const RoofFace* face : {&a, &b}) {
    for (const std::int32_t v : face->vertices) {
      const Vector3d& p = surface_.tin().points()[static_cast<std::size_t>(v)];
      const Vector3d d = p - crossing.place;
      const double along = crossing.direction.dot(d);
      if (along < span.low || along > span.high) continue;
      if ((d - along * crossing.direction).norm() > 2.0 * kNearLine * median_edge_) continue;
      const double da = a.plane.above(p), db = b.plane.above(p);
      const double roof = ridge ? std::max(da, db) : std::min(da, db);
      ++all;
      if (std::abs(roof) < limit) ++good;
    }
  }
  return all >= 6 && static_cast<double>(good) >= kLeastFit * static_cast<double>(all);
}

std::optional<StripLine> LineFinder::lineOf(RoofFace a, RoofFace b) const {
  StripLine found;
  found.angle = std::acos(std::clamp(a.plane.normal().dot(b.plane.normal()), -1.0, 1.0));
  if (found.angle < settings_.least_angle) return std::nullopt;
  const FittedPlane own = ownPlane(a, b);
  b.plane = ownPlane(b, a);
  a.plane = own;
  const auto crossing = crossingOf(a.plane, b.plane);
  if (!crossing || std::abs(crossing->direction.z()) > 0.9) return std::nullopt;
  const Span of_a = spanOf(a, *crossing), of_b = spanOf(b, *crossing);
  const Span span{std::max(of_a.low, of_b.low), std::min(of_a.high, of_b.high)};
  if (span.high - span.low < settings_.least_length) return std::nullopt;
  found.line.start = crossing->place + span.low * crossing->direction;
  found.line.end = crossing->place + span.high * crossing->direction;
  // A ridge: each face lies below the plane of the other.
  const bool ridge = b.plane.above(a.plane.centre) < 0.0 && a.plane.above(b.plane.centre) < 0.0;
  const bool valley = b.plane.above(a.plane.centre) > 0.0 && a.plane.above(b.plane.centre) > 0.0;
  if (!ridge && !valley) return std::nullopt;
  if (!agreesNearby(a, b, *crossing, span, ridge)) return std::nullopt;
  found.line.kind = ridge ? ObjectLine::Kind::ridge : ObjectLine::Kind::valley;
  found.line.covariance = covarianceOf(found.line, a.plane, b.plane);
  return found;
}

/// The lower edge of a face: horizontal, where the points of the face end above a step.
std::optional<StripLine> LineFinder::eaveOf(const RoofFace& face) const {
  const Eigen::Vector2d down = -face.plane.unknown.tail<2>().normalized();
  const Eigen::Vector2d along(-down.y(), down.x());
  std::map<long, double> lowest;  // reach down the slope by position along, in steps of an edge
  for (const std::int32_t v : face.vertices) {
    const Eigen::Vector2d d =
        (surface_.tin().points()[static_cast<std::size_t>(v)] - face.plane.centre).head<2>();
    const long bin = std::lround(along.dot(d) / (2.0 * median_edge_));
    const auto entry = lowest.emplace(bin, down.dot(d)).first;
    entry->second = std::max(entry->second, down.dot(d));
  }
  if (static_cast<double>(lowest.size() - 1) * 2.0 * median_edge_ < settings_.least_length)
    return std::nullopt;
  double sum = 0.0, squares = 0.0;
  for (const auto& [bin, reach] : lowest) sum += reach;
  const auto count = static_cast<double>(lowest.size());
  const double mean = sum / count;
  for (const auto& [bin, reach] : lowest) squares += std::pow(reach - mean, 2);
  const double scatter = std::sqrt(squares / std::max(1.0, count - 1.0));
  if (scatter > median_edge_ || count < 3.0) return std::nullopt;  // no straight edge
  // The edge is beyond the outermost points by up to their spacing.
  const double reach = mean + 0.5 * median_edge_, sigma = median_edge_ / std::sqrt(3.0);
  StripLine found;
  const auto place = [&](long bin) -> Vector3d {
    const Eigen::Vector2d plan = face.plane.centre.head<2>() + reach * down +
                                 along * (2.0 * median_edge_ * static_cast<double>(bin));
    Vector3d p(plan.x(), plan.y(), face.plane.centre.z());
    p.z() -= face.plane.above(p);
    return p;
  };
  found.line.kind = ObjectLine::Kind::eave;
  found.line.start = place(lowest.begin()->first);
  found.line.end = place(lowest.rbegin()->first);
  const double height = std::hypot(face.plane.sigma, sigma * std::tan(face.plane.slope()));
  found.line.covariance = Eigen::Vector4d(sigma, height, sigma, height).cwiseAbs2().asDiagonal();
  return found;
}

std::vector<StripLine> LineFinder::run() const {
  std::vector<StripLine> lines;
  for (const auto& [pair, contacts] : neighbours()) {
    const RoofFace& a = faces_[static_cast<std::size_t>(pair.first)];
    const RoofFace& b = faces_[static_cast<std::size_t>(pair.second)];
    if (contacts < 2 || !isRoof(a) || !isRoof(b)) continue;
    if (const auto line = lineOf(a, b)) lines.push_back(*line);
  }
  if (!settings_.eaves) return lines;
  for (const RoofFace& face : faces_) {
    if (!isRoof(face)) continue;
    if (const auto line = eaveOf(face)) lines.push_back(*line);
  }
  return lines;
}

/// Points of a square and its margin, from all points by squares.
class Tiles {
 public:
  Tiles(const std::vector<Vector3d>& points, double size) : points_(points), size_(size) {
    for (std::size_t i = 0; i < points.size(); ++i)
      cells_[cellOf(points[i])].push_back(static_cast<std::uint32_t>(i));
    for (const auto& [cell, members] : cells_) keys_.push_back(cell);
  }
  std::size_t count() const { return keys_.size(); }
  Eigen::AlignedBox2d box(std::size_t tile) const {
    const Eigen::Vector2d low(size_ * static_cast<double>(keys_[tile].first),
                              size_ * static_cast<double>(keys_[tile].second));
    return {low, low + Eigen::Vector2d::Constant(size_)};
  }
  std::vector<Vector3d> pointsOf(std::size_t tile) const {
    std::vector<Vector3d> found;
    Eigen::AlignedBox2d wide = box(tile);
    wide.min().array() -= kMargin;
    wide.max().array() += kMargin;
    for (long x = keys_[tile].first - 1; x <= keys_[tile].first + 1; ++x) {
      for (long y = keys_[tile].second - 1; y <= keys_[tile].second + 1; ++y) {
        const auto cell = cells_.find({x, y});
        if (cell == cells_.end()) continue;
        for (const std::uint32_t i : cell->second)
          if (wide.contains(points_[i].head<2>())) found.push_back(points_[i]);
      }
    }
    return found;
  }

 private:
  std::pair<long, long> cellOf(const Vector3d& p) const {
    return {static_cast<long>(std::floor(p.x() / size_)),
            static_cast<long>(std::floor(p.y() / size_))};
  }
  const std::vector<Vector3d>& points_;
  double size_;
  std::map<std::pair<long, long>, std::vector<std::uint32_t>> cells_;
  std::vector<std::pair<long, long>> keys_;
};

}  // namespace

void RoofLineSettings::check() const {
  const auto require = [](bool good, const char* what) {
    if (!good) throw UsageError(std::string("roof lines: ") + what);
  };
  require(noise >= 0.0, "noise must not be negative (m)");
  require(least_area > 0.0, "the least area of a face must be more than 0 m2");
  require(least_length > 0.0, "the least length of a line must be more than 0 m");
  require(least_angle > 0.0 && least_angle < 2.0, "the least angle must be 0 to 2 rad");
  require(tile > 2.0 * kMargin, "tiles must be wider than 50 m");
}

std::vector<StripLine> findRoofLines(const std::vector<Vector3d>& points,
                                     const RoofLineSettings& settings) {
  settings.check();
  const Tiles tiles(points, settings.tile);
  std::vector<std::vector<StripLine>> found(tiles.count());
  parallelFor(tiles.count(), settings.threads, [&](std::size_t tile) {
    std::vector<Vector3d> inside = tiles.pointsOf(tile);
    if (inside.size() < 3) return;
    const PatchSurface surface(Tin(std::move(inside), kResolution));
    if (surface.tin().triangles().empty()) return;
    const Eigen::AlignedBox2d box = tiles.box(tile);
    for (StripLine& line : LineFinder(surface, settings).run()) {
      // Of the tile that has its middle; on a border the one to the north-east.
      const Eigen::Vector2d middle = 0.5 * (line.line.start + line.line.end).head<2>();
      if ((middle.array() >= box.min().array()).all() && (middle.array() < box.max().array()).all())
        found[tile].push_back(std::move(line));
    }
  });
  std::vector<StripLine> lines;
  for (std::vector<StripLine>& part : found) lines.insert(lines.end(), part.begin(), part.end());
  return lines;
}

}  // namespace pcl_als
