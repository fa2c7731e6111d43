// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {
namespace {

constexpr std::size_t kFewest = 30;  // least points of a square with margin for a TIN

constexpr float kUnsuitable = std::numeric_limits<float>::infinity();

/// Roughness at a point (metres; infinite where it is not suitable), and whether it counts as plain
/// ground.
struct Judgement {
  float roughness = kUnsuitable;
  bool gentle = false;
};

using Square = std::pair<std::int64_t, std::int64_t>;

/// Indices of the points in each square and its margin.
std::map<Square, std::vector<std::size_t>> squaresOf(const std::vector<Eigen::Vector3d>& points,
                                                     const SuitablePointsSettings& settings) {
  std::map<Square, std::vector<std::size_t>> squares;
  const auto cell = [&](double v) {
    return static_cast<std::int64_t>(std::floor(v / settings.area_size));
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& p = points[i];
    for (std::int64_t y = cell(p.y() - settings.margin); y <= cell(p.y() + settings.margin); ++y) {
      for (std::int64_t x = cell(p.x() - settings.margin); x <= cell(p.x() + settings.margin); ++x)
        squares[{x, y}].push_back(i);
    }
  }
  return squares;
}

/// One triangle of every vertex: the first that begins with it, as the calibration takes it, or
/// else the first that has it.
std::vector<std::int32_t> trianglesOf(const Tin& tin) {
  std::vector<std::int32_t> of(tin.points().size(), Tin::kNone);
  for (const int corner : {0, 1, 2}) {
    for (std::size_t t = 0; t < tin.triangles().size(); ++t) {
      std::int32_t& known = of[static_cast<std::size_t>(tin.triangles()[t].vertex[corner])];
      if (known == Tin::kNone) known = static_cast<std::int32_t>(t);
    }
  }
  return of;
}

/// Judges the points of a square; each point lies in one.
void judge(const Square& square, const std::vector<std::size_t>& members,
           const std::vector<Eigen::Vector3d>& points, const SurfaceCriterion& criterion,
           const SuitablePointsSettings& settings, std::vector<Judgement>& judgements) {
  if (members.size() < kFewest) return;
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(members.size());
  for (const std::size_t i : members) positions.push_back(points[i]);
  const PatchSurface surface(Tin(std::move(positions), settings.resolution));
  const double median_edge = typicalPlanEdge(surface.tin());
  const std::vector<std::int32_t> triangles = trianglesOf(surface.tin());
  for (std::size_t k = 0; k < members.size(); ++k) {
    const Eigen::Vector3d& p = points[members[k]];
    const bool inside =
        std::floor(p.x() / settings.area_size) == static_cast<double>(square.first) &&
        std::floor(p.y() / settings.area_size) == static_cast<double>(square.second);
    if (!inside || triangles[k] == Tin::kNone) continue;
    const PatchQuality quality = surface.quality(triangles[k]);
    if (!criterion.isSatisfiedBy(quality, median_edge)) continue;
    judgements[members[k]] = {quality.roughness, quality.slope < kGentleSlope};
  }
}

/// The limit of roughness from these data, metres.
double roughnessLimit(const std::vector<Judgement>& judgements, double factor) {
  std::vector<double> plain;
  for (const Judgement& judgement : judgements) {
    if (judgement.gentle) plain.push_back(judgement.roughness);
  }
  if (factor <= 0.0 || plain.empty()) return std::numeric_limits<double>::max();
  return factor * medianInPlace(plain);
}

}  // namespace

void SuitablePointsSettings::check() const {
  if (!(area_size > 0.0) || area_size > 5000.0)
    throw UsageError("suitable points: the area size must be more than 0 and at most 5000 m");
  if (!(margin >= 0.0) || margin > area_size)
    throw UsageError("suitable points: the margin must be from 0 m to the area size");
  if (!(resolution > 0.0) || resolution > 0.1)
    throw UsageError("suitable points: the resolution must be more than 0 and at most 0.1 m");
  if (!(plain_roughness_factor >= 0.0))
    throw UsageError("suitable points: the factor of the roughness must be 0 or more");
}

std::vector<bool> suitablePoints(const std::vector<Eigen::Vector3d>& points,
                                 const SurfaceCriterion& criterion,
                                 const SuitablePointsSettings& settings) {
  settings.check();
  const auto squares = squaresOf(points, settings);
  std::vector<const std::pair<const Square, std::vector<std::size_t>>*> order;
  for (const auto& entry : squares) order.push_back(&entry);
  std::vector<Judgement> judgements(points.size());
  parallelFor(order.size(), settings.threads, [&](std::size_t i) {
    judge(order[i]->first, order[i]->second, points, criterion, settings, judgements);
  });
  const double limit = roughnessLimit(judgements, settings.plain_roughness_factor);
  std::vector<bool> suitable(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    suitable[i] = std::isfinite(judgements[i].roughness) && judgements[i].roughness <= limit;
  }
  return suitable;
}

}  // namespace pcl_als
