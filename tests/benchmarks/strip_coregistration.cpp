// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_coregistration.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <pcl_als/common/parallel.h>
#include <pcl_als/common/statistics.h>

namespace pcl_als::bench {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kPoints = 40'000;  // that look for patches
constexpr int kIterations = 8;
constexpr double kFirstThreshold = 2.0, kLastThreshold = 0.25;  // metres
constexpr double kLongestEdge = 5.0;                            // metres
constexpr double kSignificantTilt = 5.0;                        // standard deviations
constexpr std::size_t kEveryFlat = 10;  // of the points on flat ground, which shows height alone

struct Source {
  std::size_t area;
  Eigen::Vector3d position;
};

/// One pair: row of the six unknowns, distance along the normal.
struct Equation {
  Vector6d row;
  double distance;
};

std::vector<Source> sourcesOf(const MatchedBlock& block, int strip) {
  std::vector<Source> all, some;
  for (std::size_t i = 0; i < block.areaCount(); ++i) {
    for (const Eigen::Vector3d& point : block.area(i).surfaceOf(strip).tin().points()) {
      if (block.area(i).area().contains(point)) all.push_back({i, point});
    }
  }
  const std::size_t step = std::max<std::size_t>(1, all.size() / kPoints);
  for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
  return some;
}

/// Whether the surface around a match is a patch; its normal, vertical where the tilt is noise.
bool patchNormal(const PatchQuality& quality, const SurfaceCriterion& limits,
                 Eigen::Vector3d& normal) {
  if (quality.on_hull || quality.longest_edge > kLongestEdge || quality.slope > limits.slope ||
      quality.roughness > limits.roughness || quality.vertices < limits.minimum_vertices)
    return false;
  normal = quality.plane_normal;
  const double tilt = quality.roughness / std::max(quality.spread, 1e-3F);
  if (normal.head<2>().norm() < kSignificantTilt * tilt) normal = Eigen::Vector3d::UnitZ();
  return true;
}

/// The pairs of the moved points with the patches of a strip.
std::vector<Equation> pairUp(const MatchedBlock& block, const std::vector<Source>& sources,
                             int strip, const Eigen::Vector3d& centre, const Discrepancy& moved,
                             double threshold) {
  constexpr std::size_t kChunk = 1000;
  std::vector<std::vector<Equation>> parts((sources.size() + kChunk - 1) / kChunk);
  parallelFor(parts.size(), 0, [&](std::size_t part) {
    const std::size_t end = std::min(sources.size(), (part + 1) * kChunk);
    for (std::size_t i = part * kChunk; i < end; ++i) {
      const PatchSurface& surface = block.area(sources[i].area).surfaceOf(strip);
      if (surface.tin().triangles().empty()) continue;
      const Eigen::Vector3d arm = sources[i].position - centre;
      const Eigen::Vector3d point = sources[i].position + moved.shift + moved.rotation.cross(arm);
      const auto match = surface.closest(point, threshold);
      Eigen::Vector3d normal;
      if (!match || !patchNormal(surface.quality(match->triangle), block.limits(), normal))
        continue;
      if (normal.z() == 1.0 && i % kEveryFlat != 0) continue;
      Equation equation;
      equation.row << normal, arm.cross(normal);
      equation.distance = normal.dot(match->foot - point);
      parts[part].push_back(equation);
    }
  });
  std::vector<Equation> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// What has to be added to the movement; \a sigma: scatter of the distances, metres.
Vector6d solve(const std::vector<Equation>& equations, double& sigma) {
  std::vector<double> distances;
  for (const Equation& e : equations) distances.push_back(e.distance);
  sigma = robustSigma(distances);
  Vector6d update = Vector6d::Zero();
  for (int pass = 0; pass < 5; ++pass) {
    Matrix6d normal = Matrix6d::Zero();
    Vector6d right = Vector6d::Zero();
    distances.clear();
    for (const Equation& e : equations) {
      const double rest = e.distance - e.row.dot(update);
      const double weight = std::min(1.0, 1.5 * sigma / std::max(std::abs(rest), 1e-6));
      normal += weight * e.row * e.row.transpose();
      right += weight * rest * e.row;
      distances.push_back(rest);
    }
    const Vector6d scale = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Matrix6d scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    update += scale.asDiagonal() * scaled.ldlt().solve(scale.cwiseProduct(right));
    sigma = robustSigma(distances);
  }
  return update;
}

}  // namespace

Discrepancy discrepancyOf(const MatchedBlock& block, int a, int b) {
  const std::vector<Source> sources = sourcesOf(block, a);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double seen = 0.0;
  for (const Source& source : sources) {
    if (block.area(source.area).surfaceOf(b).tin().triangles().empty()) continue;
    centre += source.position;
    seen += 1.0;
  }
  Discrepancy found;
  if (seen == 0.0) return found;
  centre /= seen;
  double threshold = kFirstThreshold, sigma = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    const auto equations = pairUp(block, sources, b, centre, found, threshold);
    if (equations.size() < 100) return found;
    const Vector6d update = solve(equations, sigma);
    found.shift += update.head<3>();
    found.rotation += update.tail<3>();
    found.points = equations.size();
    threshold = std::clamp(6.0 * sigma, kLastThreshold, threshold);
  }
  return found;
}

}  // namespace pcl_als::bench
