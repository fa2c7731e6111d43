// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "roof_faces.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als::photogrammetry {
namespace {

using Eigen::Vector3d;

constexpr double kDeviation = 3.0;    ///< standard deviations of a vertex from its face
constexpr double kRoughSeed = 2.0;    ///< roughness of a seed against plain ground
constexpr double kLeastNoise = 0.01;  ///< metres
constexpr double kMostNoise = 0.08;   ///< metres
constexpr std::size_t kSeedStep = 3;  ///< triangles from one possible seed to the next
constexpr double kRefit = 1.3;        ///< growth after which a plane is fitted again
constexpr double kEdgeFactor = 3.0;   ///< longest edge of a face against the median

/// Faces that grow on one TIN.
class Growth {
 public:
  Growth(const PatchSurface& surface, const RoofLineSettings& settings,
         std::vector<std::int32_t>& face_of)
      : surface_(surface), tin_(surface.tin()), settings_(settings), face_of_(face_of) {
    face_of_.assign(tin_.triangles().size(), -1);
    median_edge_ = typicalPlanEdge(tin_);
  }
  std::vector<RoofFace> run();

 private:
  struct Seed {
    float roughness;
    std::int32_t triangle;
  };
  std::vector<Seed> seeds();
  bool grow(std::int32_t seed, RoofFace& face);
  bool fits(std::int32_t triangle, const FittedPlane& plane) const;
  void addTriangle(std::int32_t triangle, std::int32_t index, RoofFace& face);
  void describe(RoofFace& face, std::int32_t index) const;

  const PatchSurface& surface_;
  const Tin& tin_;
  const RoofLineSettings& settings_;
  std::vector<std::int32_t>& face_of_;
  std::vector<bool> taken_;  ///< by vertex, of the face that grows
  double median_edge_ = 0.0, noise_ = 0.0;
};

std::vector<Growth::Seed> Growth::seeds() {
  std::vector<Seed> seeds;
  std::vector<double> plain;
  const SurfaceCriterion sound;
  for (std::size_t t = 0; t < tin_.triangles().size(); t += kSeedStep) {
    const PatchQuality quality = surface_.quality(static_cast<std::int32_t>(t));
    if (!sound.isSound(quality, median_edge_)) continue;
    plain.push_back(quality.roughness);
    if (quality.slope < settings_.steepest)
      seeds.push_back({quality.roughness, static_cast<std::int32_t>(t)});
  }
  if (plain.empty()) return {};
  // The smoothest quarter is ground and roofs, whatever else is there.
  std::nth_element(plain.begin(), plain.begin() + static_cast<std::ptrdiff_t>(plain.size() / 4),
                   plain.end());
  noise_ = settings_.noise > 0.0 ? settings_.noise
                                 : std::clamp(plain[plain.size() / 4], kLeastNoise, kMostNoise);
  const double limit = kRoughSeed * noise_;
  seeds.erase(std::remove_if(seeds.begin(), seeds.end(),
                             [&](const Seed& seed) { return seed.roughness > limit; }),
              seeds.end());
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) {
    return a.roughness != b.roughness ? a.roughness < b.roughness : a.triangle < b.triangle;
  });
  return seeds;
}

bool Growth::fits(std::int32_t triangle, const FittedPlane& plane) const {
  const double limit = kDeviation * std::max(noise_, std::min(plane.sigma, kMostNoise));
  const auto& vertex = tin_.triangles()[static_cast<std::size_t>(triangle)].vertex;
  for (int i = 0; i < 3; ++i) {
    const Vector3d& a =
        tin_.points()[static_cast<std::size_t>(vertex[static_cast<std::size_t>(i)])];
    const Vector3d& b =
        tin_.points()[static_cast<std::size_t>(vertex[static_cast<std::size_t>((i + 1) % 3)])];
    if ((a - b).head<2>().norm() > kEdgeFactor * median_edge_) return false;
    if (std::abs(plane.distance(a)) > limit) return false;
  }
  return true;
}

void Growth::addTriangle(std::int32_t triangle, std::int32_t index, RoofFace& face) {
  face_of_[static_cast<std::size_t>(triangle)] = index;
  face.triangles.push_back(triangle);
  for (const std::int32_t v : tin_.triangles()[static_cast<std::size_t>(triangle)].vertex) {
    if (taken_[static_cast<std::size_t>(v)]) continue;
    taken_[static_cast<std::size_t>(v)] = true;
    face.vertices.push_back(v);
  }
}

bool Growth::grow(std::int32_t seed, RoofFace& face) {
  constexpr std::int32_t kTrying = -2;
  const PatchQuality quality = surface_.quality(seed);
  face.plane.centre = quality.plane_centre;
  face.plane.unknown = {0.0, -quality.plane_normal.x() / quality.plane_normal.z(),
                        -quality.plane_normal.y() / quality.plane_normal.z()};
  std::queue<std::int32_t> border;
  if (!fits(seed, face.plane)) return false;
  addTriangle(seed, kTrying, face);
  border.push(seed);
  double fitted = 8.0;
  std::vector<std::int32_t> refused;
  while (!border.empty()) {
    const std::int32_t from = border.front();
    border.pop();
    for (const std::int32_t next : tin_.triangles()[static_cast<std::size_t>(from)].neighbour) {
      if (next == Tin::kNone || face_of_[static_cast<std::size_t>(next)] != -1) continue;
      if (!fits(next, face.plane)) continue;
      addTriangle(next, kTrying, face);
      border.push(next);
    }
    if (static_cast<double>(face.vertices.size()) < kRefit * fitted) continue;
    fitted = static_cast<double>(face.vertices.size());
    face.plane = fitPlane(tin_.points(), face.vertices);
  }
  if (face.vertices.size() < 4) return false;
  face.plane = fitPlane(tin_.points(), face.vertices);
  return true;
}

/// Area, and the share of the border beside which the surface is lower by a step.
void Growth::describe(RoofFace& face, std::int32_t index) const {
  double border = 0.0, steps = 0.0;
  for (const std::int32_t t : face.triangles) {
    const Tin::Triangle& triangle = tin_.triangles()[static_cast<std::size_t>(t)];
    const auto corner = [&](int i) -> const Vector3d& {
      return tin_
          .points()[static_cast<std::size_t>(triangle.vertex[static_cast<std::size_t>(i % 3)])];
    };
    const Eigen::Vector2d u = (corner(1) - corner(0)).head<2>(),
                          v = (corner(2) - corner(0)).head<2>();
    face.area += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
    for (int i = 0; i < 3; ++i) {
      const std::int32_t beside = triangle.neighbour[static_cast<std::size_t>(i)];
      if (beside != Tin::kNone && face_of_[static_cast<std::size_t>(beside)] == index) continue;
      const double length = (corner(i + 1) - corner(i + 2)).head<2>().norm();
      border += length;
      if (beside == Tin::kNone) continue;
      double lowest = 0.0;
      for (const std::int32_t w : tin_.triangles()[static_cast<std::size_t>(beside)].vertex)
        lowest = std::min(lowest, face.plane.above(tin_.points()[static_cast<std::size_t>(w)]));
      if (lowest < -settings_.least_step) steps += length;
    }
  }
  face.step_share = border > 0.0 ? steps / border : 0.0;
}

std::vector<RoofFace> Growth::run() {
  std::vector<RoofFace> faces;
  taken_.assign(tin_.points().size(), false);
  for (const Seed& seed : seeds()) {
    if (face_of_[static_cast<std::size_t>(seed.triangle)] != -1) continue;
    RoofFace face;
    const bool grown = grow(seed.triangle, face);
    for (const std::int32_t v : face.vertices) taken_[static_cast<std::size_t>(v)] = false;
    const bool keep = grown && static_cast<int>(face.vertices.size()) >= settings_.least_points;
    const auto index =
        static_cast<std::int32_t>(keep ? static_cast<std::ptrdiff_t>(faces.size()) : -1);
    for (const std::int32_t t : face.triangles) face_of_[static_cast<std::size_t>(t)] = index;
    if (keep) faces.push_back(std::move(face));
  }
  for (std::size_t f = 0; f < faces.size(); ++f) describe(faces[f], static_cast<std::int32_t>(f));
  return faces;
}

}  // namespace

double FittedPlane::slope() const {
  return std::atan(std::hypot(unknown[1], unknown[2]));
}

FittedPlane fitPlane(const std::vector<Vector3d>& points, const std::vector<std::int32_t>& which) {
  FittedPlane plane;
  plane.points = which.size();
  for (const std::int32_t i : which) plane.centre += points[static_cast<std::size_t>(i)];
  plane.centre /= static_cast<double>(which.size());
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  for (const std::int32_t i : which) {
    const Vector3d d = points[static_cast<std::size_t>(i)] - plane.centre;
    const Vector3d row(1.0, d.x(), d.y());
    normal += row * row.transpose();
    right += row * d.z();
  }
  const Eigen::Matrix3d inverse = inverseOfSymmetric(normal);
  plane.unknown = inverse * right;
  double sum = 0.0;
  for (const std::int32_t i : which)
    sum += std::pow(plane.above(points[static_cast<std::size_t>(i)]), 2);
  plane.sigma = std::sqrt(sum / std::max(1.0, static_cast<double>(which.size()) - 3.0));
  plane.covariance = plane.sigma * plane.sigma * inverse;
  return plane;
}

FittedPlane fitPlaneInCells(const std::vector<Vector3d>& points,
                            const std::vector<std::int32_t>& which, double side) {
  FittedPlane plane = fitPlane(points, which);
  ClusteredRegression regression(3);
  for (const std::int32_t i : which) {
    const Vector3d d = points[static_cast<std::size_t>(i)] - plane.centre;
    const auto column = static_cast<std::int64_t>(std::floor(d.x() / side));
    const auto row = static_cast<std::int64_t>(std::floor(d.y() / side));
    regression.add(column * (std::int64_t{1} << 31) + row, Vector3d(1.0, d.x(), d.y()), d.z());
  }
  const ClusteredRegression::Result result = regression.solve();
  if (!result.determined) return plane;
  // One factor for all: correlations from few cells are not reliable. The estimate follows
  // Student's distribution with the degrees of freedom of the cells, whose variance is larger.
  const double freedom = std::max(3.0, static_cast<double>(result.clusters) - 3.0);
  plane.covariance *=
      freedom / (freedom - 2.0) *
      result.covariance_formal.diagonal().cwiseQuotient(plane.covariance.diagonal()).mean();
  return plane;
}

std::vector<RoofFace> findFaces(const PatchSurface& surface, const RoofLineSettings& settings,
                                std::vector<std::int32_t>& face_of) {
  return Growth(surface, settings, face_of).run();
}

}  // namespace pcl_als::photogrammetry
