// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/tin/tin.h>

#include "delaunay.h"
#include "exact_orientation.h"

namespace pcl_als {
namespace {

using Lattice2 = Eigen::Matrix<std::int64_t, 2, 1>;

/// Beyond this many resolutions from zero a double no longer holds every lattice position.
constexpr double kLargestLattice = 0x1p52;

/// The lattice position of a coordinate. It depends on the coordinate alone, so a part of the
/// points gets the same lattice as the whole.
std::int64_t latticeOf(double coordinate, double resolution) {
  const double scaled = coordinate / resolution + 0.5;
  const auto truncated = static_cast<std::int64_t>(scaled);
  return static_cast<double>(truncated) > scaled ? truncated - 1 : truncated;
}

Eigen::AlignedBox2d planExtent(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox2d extent;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite())
      throw InputError("TIN: point " + std::to_string(i) +
                       " has a coordinate that is not finite; remove such points first");
    extent.extend(points[i].head<2>());
  }
  return extent;
}

/// The lattice position of the extent's lower corner; the size is checked: predicates are exact up
/// to kMaxExtent.
Lattice2 latticeOrigin(const Eigen::AlignedBox2d& extent, double resolution) {
  const double farthest = extent.min().cwiseAbs().cwiseMax(extent.max().cwiseAbs()).maxCoeff();
  if (farthest / resolution < kLargestLattice) {
    Lattice2 low(latticeOf(extent.min().x(), resolution), latticeOf(extent.min().y(), resolution));
    const Lattice2 high(latticeOf(extent.max().x(), resolution),
                        latticeOf(extent.max().y(), resolution));
    if ((high - low).maxCoeff() <= tin::kMaxExtent) return low;
  }
  std::ostringstream message;
  message << "TIN: plan extent " << extent.sizes().maxCoeff() << " m (farthest coordinate "
          << farthest << " m) is more than 2^24 steps of the resolution " << resolution
          << " m; build it in tiles or choose a coarser resolution";
  throw UsageError(message.str());
}

std::vector<std::uint64_t> mortonCodes(const std::vector<Eigen::Vector3d>& points,
                                       const Eigen::AlignedBox2d& extent, double resolution) {
  const Lattice2 origin = latticeOrigin(extent, resolution);
  std::vector<std::uint64_t> codes(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    codes[i] = tin::mortonCode(
        {static_cast<std::int32_t>(latticeOf(points[i].x(), resolution) - origin.x()),
         static_cast<std::int32_t>(latticeOf(points[i].y(), resolution) - origin.y())});
  return codes;
}

}  // namespace

Tin::Tin(std::vector<Eigen::Vector3d> points, double resolution)
    : points_(std::move(points)), resolution_(resolution) {
  if (!std::isfinite(resolution) || resolution <= 0.0)
    throw UsageError("TIN: resolution must be a positive number of metres, not " +
                     std::to_string(resolution));
  // Directed edges are numbered in 32 bits, six for each point.
  constexpr std::size_t kMostPoints = std::numeric_limits<std::int32_t>::max() / 6;
  if (points_.size() > kMostPoints)
    throw UsageError("TIN: " + std::to_string(points_.size()) + " points are more than " +
                     std::to_string(kMostPoints) + "; build it in tiles");
  const Eigen::AlignedBox2d extent = planExtent(points_);
  if (points_.empty()) return;
  const tin::SpatialOrder order = tin::spatialOrder(mortonCodes(points_, extent, resolution));
  merged_ = points_.size() - order.point.size();
  triangles_ = tin::delaunayTriangles(order);
  buildStartGrid(extent);
}

void Tin::movePoints(std::vector<Eigen::Vector3d> points) {
  if (points.size() != points_.size())
    throw UsageError("TIN: cannot move " + std::to_string(points_.size()) + " points to " +
                     std::to_string(points.size()) + " positions");
  points_ = std::move(points);
  // Few inverted triangles do no harm: walks and searches get past them. Many mean that measured
  // points have passed each other, as those of the forward and backward arcs of a conical scanner
  // do.
  constexpr double kMostInverted = 0.001;
  if (shareOfInverted() > kMostInverted) *this = Tin(std::move(points_), resolution_);
}

/// Share of the triangles that are inside the hull and no longer counter-clockwise, of a sample of
/// them. Triangles along the hull are thin, turn over for any movement, and are not used to measure
/// on.
double Tin::shareOfInverted() const {
  constexpr std::size_t kSampledTriangles = 4096;
  const std::size_t every = std::max<std::size_t>(1, triangles_.size() / kSampledTriangles);
  std::size_t inverted = 0, examined = 0;
  for (std::size_t i = 0; i < triangles_.size(); i += every, ++examined) {
    const Triangle& t = triangles_[i];
    if (std::count(t.neighbour.begin(), t.neighbour.end(), kNone) > 0) continue;
    const Eigen::Vector3d &a = points_[t.vertex[0]], &b = points_[t.vertex[1]],
                          &c = points_[t.vertex[2]];
    if (tin::orientation(a.x(), a.y(), b.x(), b.y(), c.x(), c.y()) <= 0.0) ++inverted;
  }
  return examined > 0 ? static_cast<double>(inverted) / static_cast<double>(examined) : 0.0;
}

bool Tin::certain(std::int32_t triangle, const Eigen::AlignedBox2d& covered) const {
  const auto& vertex = triangles_[triangle].vertex;
  const auto lattice = [&](int i) {
    const Eigen::Vector3d& p = points_[vertex[i]];
    return Lattice2(latticeOf(p.x(), resolution_), latticeOf(p.y(), resolution_));
  };
  // In steps of the lattice from vertex 0. Lengths squared and area are integers under 2^52; only
  // what is made of them below is rounded.
  const Lattice2 a = lattice(0);
  const Eigen::Vector2d b = (lattice(1) - a).cast<double>(), c = (lattice(2) - a).cast<double>();
  const double bb = b.squaredNorm(), cc = c.squaredNorm();
  const double divisor = 2.0 * (b.x() * c.y() - b.y() * c.x());
  if (divisor <= 0.0) return false;  // only after the points were moved
  const Eigen::Vector2d centre((c.y() * bb - b.y() * cc) / divisor,
                               (b.x() * cc - c.x() * bb) / divisor);
  // Two steps: one as points up to half a step outside the box may round into it, one for rounding
  // of the box. The rest bounds the rounding of centre and radius for the thinnest triangles.
  const double rounding = 0x1p-49 * (c.lpNorm<1>() * bb + b.lpNorm<1>() * cc) / divisor;
  const double reach = centre.norm() + rounding + 2.0;
  const Eigen::Vector2d origin = a.cast<double>();
  return ((covered.min() / resolution_ - origin).array() <= centre.array() - reach).all() &&
         ((covered.max() / resolution_ - origin).array() >= centre.array() + reach).all();
}

}  // namespace pcl_als
