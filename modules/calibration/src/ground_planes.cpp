// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "ground_planes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <pcl_als/adjustment/robust_iteration.h>
#include <pcl_als/adjustment/robust_weight.h>

namespace pcl_als {
namespace {

using Points = std::vector<Eigen::Vector3d>;
using Members = std::vector<std::int32_t>;

constexpr std::size_t kFewest = 20;  // points of a cell: the plane has a better tilt than a patch

/// Points by cell, from the corner of their box, so that the cells move with them.
std::map<std::pair<std::int64_t, std::int64_t>, Members> cellsOf(const Points& points,
                                                                 double cell) {
  std::map<std::pair<std::int64_t, std::int64_t>, Members> cells;
  Eigen::Array2d corner = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
  for (const Eigen::Vector3d& point : points) corner = corner.min(point.head<2>().array());
  std::pair<std::int64_t, std::int64_t> last;
  Members* members = nullptr;  // of the last cell, in which the next point usually is as well
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Array2d at = ((points[i].head<2>().array() - corner) / cell).floor();
    const std::pair key(static_cast<std::int64_t>(at.x()), static_cast<std::int64_t>(at.y()));
    if (members == nullptr || key != last) members = &cells[last = key];
    members->push_back(static_cast<std::int32_t>(i));
  }
  return cells;
}

/// The members of a cell that lie on its plane; empty where they have none.
Members onPlane(const Points& points, const Members& members, double roughness) {
  if (members.size() < kFewest) return {};
  const auto count = static_cast<Eigen::Index>(members.size());
  const Eigen::Vector3d& origin = points[static_cast<std::size_t>(members.front())];
  Points local;
  for (const std::int32_t i : members)
    local.push_back(points[static_cast<std::size_t>(i)] - origin);
  Eigen::Vector3d plane = Eigen::Vector3d::Zero();  // z = plane . (1, x, y)
  const auto solve = [&](const Eigen::VectorXd& weights, Eigen::VectorXd& residuals) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3d& at = local[static_cast<std::size_t>(i)];
      const Eigen::Vector3d row(1.0, at.x(), at.y()), weighted = weights[i] * row;
      normal.noalias() += weighted * row.transpose();
      right += weighted * at.z();
    }
    const Eigen::LDLT<Eigen::Matrix3d> factor(normal);
    if (factor.info() != Eigen::Success || !factor.isPositive()) return std::optional<double>();
    const Eigen::Vector3d solution = factor.solve(right);
    const Eigen::Vector3d change = solution - plane;
    plane = solution;
    residuals.resize(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::Vector3d& at = local[static_cast<std::size_t>(i)];
      residuals[i] = at.z() - plane[0] - plane[1] * at.x() - plane[2] * at.y();
    }
    return std::optional<double>(change.dot(normal * change));
  };
  constexpr double kLeastScale = 0.01;  // of the roughness: points without noise
  RobustSettings settings;
  settings.least_scale = kLeastScale * roughness;
  const RobustFit fit = fitRobustly(members.size(), settings, solve);
  Members found;
  if (!fit.solved() || fit.scale > roughness) return found;
  for (Eigen::Index i = 0; i < count; ++i)
    if (!RobustWeight().rejects(fit.residuals[i], fit.scale))
      found.push_back(members[static_cast<std::size_t>(i)]);
  return found.size() < kFewest ? Members() : found;
}

/// Sums over the points of a plane, relative to one of them.
struct Moments {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero(), sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  double count = 0.0;

  void add(const Eigen::Vector3d& point) {
    if (count == 0.0) origin = point;
    const Eigen::Vector3d at = point - origin;
    sum += at;
    squares.noalias() += at * at.transpose();
    count += 1.0;
  }

  /// z = a + b x + c y by least squares.
  GroundPlanes::Plane plane() const {
    const Eigen::Matrix3d scatter = squares - sum * sum.transpose() / count;
    const Eigen::Matrix2d plan = scatter.topLeftCorner<2, 2>();
    const Eigen::Vector2d slope = plan.ldlt().solve(scatter.topRightCorner<2, 1>());
    const double squared = scatter(2, 2) - slope.dot(scatter.topRightCorner<2, 1>());
    const double narrow = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(plan).eigenvalues()[0];
    const double variance = std::max(0.0, squared) / (count - 3.0);
    return {Eigen::Vector3d(-slope.x(), -slope.y(), 1.0).normalized(),
            std::sqrt(variance / std::max(narrow, 1e-6))};
  }
};

}  // namespace

GroundPlanes::GroundPlanes(const Points& points, double cell, double roughness)
    : plane_of_(points.size(), -1) {
  for (const auto& [place, members] : cellsOf(points, cell)) {
    const Members found = onPlane(points, members, roughness);
    if (found.empty()) continue;
    for (const std::int32_t i : found)
      plane_of_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(planes_.size());
    planes_.emplace_back();
  }
  fit(points);
}

void GroundPlanes::fit(const Points& points) {
  std::vector<Moments> moments(planes_.size());
  for (std::size_t i = 0; i < plane_of_.size(); ++i)
    if (plane_of_[i] >= 0) moments[static_cast<std::size_t>(plane_of_[i])].add(points[i]);
  for (std::size_t i = 0; i < planes_.size(); ++i) planes_[i] = moments[i].plane();
}

const GroundPlanes::Plane* GroundPlanes::under(const std::array<std::int32_t, 3>& triangle) const {
  if (plane_of_.empty()) return nullptr;
  for (const std::int32_t i : triangle)
    if (plane_of_[static_cast<std::size_t>(i)] < 0) return nullptr;
  return &planes_[static_cast<std::size_t>(plane_of_[static_cast<std::size_t>(triangle[0])])];
}

}  // namespace pcl_als
