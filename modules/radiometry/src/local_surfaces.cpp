// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <array>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/radiometry/local_surfaces.h>

namespace pcl_als {
namespace {

constexpr std::size_t kMostPoints = 32;
constexpr double kWantedPoints = 16.0;
/// Cells of the grid never outnumber the points by more.
constexpr double kCellsPerPoint = 4.0;

/// z = height + slope_x x + slope_y y, relative to the point.
struct Plane {
  float height = 0.0F, slope_x = 0.0F, slope_y = 0.0F;
  float over_length() const {
    return 1.0F / std::sqrt(1.0F + slope_x * slope_x + slope_y * slope_y);
  }
  float above(const Eigen::Vector3f& p) const {
    return p.z() - height - slope_x * p.x() - slope_y * p.y();
  }
};

/// Sums of a least-squares plane; x and y about the point.
struct PlaneSums {
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;

  void add(const Eigen::Vector3f& p) {
    const double px = p.x(), py = p.y(), pz = p.z();
    n += 1, x += px, y += py, z += pz;
    xx += px * px, xy += px * py, yy += py * py, xz += px * pz, yz += py * pz;
  }
  /// False where the points lie on a line: their narrower spread (RMS, metres) is under the least.
  bool solve(double least_spread, Plane& plane) const {
    const double mx = x / n, my = y / n, mz = z / n;
    const double a = xx / n - mx * mx, b = xy / n - mx * my, c = yy / n - my * my;
    const double middle = 0.5 * (a + c), half = std::hypot(0.5 * (a - c), b);
    if (middle - half < least_spread * least_spread) return false;
    const double u = xz / n - mx * mz, v = yz / n - my * mz, d = a * c - b * b;
    const double sx = (c * u - b * v) / d, sy = (a * v - b * u) / d;
    plane = {static_cast<float>(mz - sx * mx - sy * my), static_cast<float>(sx),
             static_cast<float>(sy)};
    return true;
  }
};

/// Planes less steep cost little where they are wrong: cos 15 degrees is 0.966.
constexpr float kGentle = 0.268F;
/// Share of the extent along the slope that may be without points: three even rows leave 0.5.
constexpr float kWidestGap = 0.6F;

/// Whether the points on a steep plane are two groups with nothing between: a row on a roof and one
/// on the ground lie on a plane as well, and it is no surface.
template <typename Points>
bool bridges(const Plane& plane, const Points& points, std::size_t count, float tolerance) {
  const float steepness = std::hypot(plane.slope_x, plane.slope_y);
  if (steepness < kGentle) return false;
  const float within = tolerance / plane.over_length();
  std::array<float, kMostPoints> along;
  std::size_t n = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (std::abs(plane.above(points[i])) <= within)
      along[n++] = plane.slope_x * points[i].x() + plane.slope_y * points[i].y();
  if (n < 2) return true;
  std::sort(along.begin(), along.begin() + static_cast<std::ptrdiff_t>(n));
  float widest = 0.0F;
  for (std::size_t i = 1; i < n; ++i) widest = std::max(widest, along[i] - along[i - 1]);
  return widest > kWidestGap * (along[n - 1] - along[0]);
}

LocalSurface surfaceOf(const Plane& plane, double sum_sq, std::size_t support) {
  LocalSurface surface;
  surface.normal = Eigen::Vector3f(-plane.slope_x, -plane.slope_y, 1.0F) * plane.over_length();
  surface.roughness = static_cast<float>(std::sqrt(sum_sq / static_cast<double>(support)));
  surface.support = static_cast<std::uint16_t>(support);
  return surface;
}

}  // namespace

void LocalSurfaceSettings::check() const {
  const auto fail = [](const char* what) {
    throw UsageError(std::string("local surfaces: ") + what);
  };
  if (!std::isfinite(radius) || radius < 0.0 || radius > 1000.0)
    fail("the radius must be from 0 (found) to 1000 m");
  if (!std::isfinite(tolerance) || tolerance <= 0.0 || tolerance > 10.0)
    fail("the tolerance must be more than 0 and at most 10 m");
  if (least_support < 4 || least_support > static_cast<int>(kMostPoints))
    fail("a plane needs 4 to 32 points");
  if (most_points < static_cast<std::size_t>(least_support) || most_points > kMostPoints)
    fail("at most 32 neighbours, and as many as a plane needs");
  if (!(least_share >= 0.0 && least_share <= 1.0)) fail("the share must be from 0 to 1");
  if (!(steepest > 0.0 && steepest < 90.0)) fail("the steepest slope must be in (0, 90) degrees");
}

/// The nearest neighbours of a point, relative to it.
struct LocalSurfaces::Neighbours {
  std::array<Eigen::Vector3f, kMostPoints> point;
  std::size_t count = 0;
};

double LocalSurfaces::radiusFor(const std::vector<Eigen::Vector3f>& points) {
  constexpr float kCell = 4.0F;
  std::vector<std::uint64_t> cells;
  for (const Eigen::Vector3f& p : points) {
    const auto column = static_cast<std::int32_t>(std::floor(p.x() / kCell));
    const auto row = static_cast<std::int32_t>(std::floor(p.y() / kCell));
    const std::uint64_t cell =
        std::uint64_t{static_cast<std::uint32_t>(column)} << 32U | static_cast<std::uint32_t>(row);
    if (cells.empty() || cells.back() != cell) cells.push_back(cell);
  }
  if (cells.empty()) return 1.0;
  std::sort(cells.begin(), cells.end());
  const auto distinct = std::unique(cells.begin(), cells.end()) - cells.begin();
  const double density =
      static_cast<double>(points.size()) / (static_cast<double>(distinct) * kCell * kCell);
  return std::clamp(std::sqrt(kWantedPoints / (M_PI * density)), 0.1, 100.0);
}

LocalSurfaces::LocalSurfaces(const std::vector<Eigen::Vector3f>& points,
                             const LocalSurfaceSettings& settings)
    : settings_(settings), radius_(settings.radius > 0.0 ? settings.radius : radiusFor(points)) {
  settings.check();
  if (points.empty()) return;
  Eigen::Vector2f low = points[0].head<2>(), high = low;
  for (const Eigen::Vector3f& p : points) {
    low = low.cwiseMin(p.head<2>());
    high = high.cwiseMax(p.head<2>());
  }
  const Eigen::Vector2d size = (high - low).cast<double>();
  const double most = kCellsPerPoint * static_cast<double>(points.size()) + 64.0;
  const double cell =
      std::max({radius_, std::sqrt(size.x() * size.y() / most), size.maxCoeff() / most});
  origin_ = low;
  cells_per_metre_ = static_cast<float>(1.0 / cell);
  columns_ = static_cast<std::int64_t>(size.x() / cell) + 2;
  rows_ = static_cast<std::int64_t>(size.y() / cell) + 2;
  const auto cellOf = [this](const Eigen::Vector3f& p) {
    const auto column = static_cast<std::int64_t>((p.x() - origin_.x()) * cells_per_metre_);
    const auto row = static_cast<std::int64_t>((p.y() - origin_.y()) * cells_per_metre_);
    return static_cast<std::size_t>(row * columns_ + column);
  };
  starts_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const Eigen::Vector3f& p : points) ++starts_[cellOf(p) + 1];
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  points_.resize(points.size());
  for (const Eigen::Vector3f& p : points) points_[next[cellOf(p)]++] = p;
}

void LocalSurfaces::gather(const Eigen::Vector3f& point, Neighbours& neighbours) const {
  struct Candidate {
    float distance_sq;
    std::uint32_t index;
    bool operator<(const Candidate& other) const {
      return distance_sq < other.distance_sq ||
             (distance_sq == other.distance_sq && index < other.index);
    }
  };
  constexpr std::size_t kMostCandidates = 256;
  std::array<Candidate, kMostCandidates> found;
  std::size_t count = 0;
  const auto limit_sq = static_cast<float>(radius_ * radius_);
  const auto shrink = [&] {
    const auto last = found.begin() + static_cast<std::ptrdiff_t>(settings_.most_points);
    std::nth_element(found.begin(), last, found.begin() + static_cast<std::ptrdiff_t>(count));
    count = settings_.most_points;
  };
  const Eigen::Vector2f at = (point.head<2>() - origin_) * cells_per_metre_;
  const auto column = static_cast<std::int64_t>(std::floor(at.x()));
  const auto row = static_cast<std::int64_t>(std::floor(at.y()));
  const std::int64_t left = std::max<std::int64_t>(0, column - 1);
  const std::int64_t right = std::min(columns_ - 1, column + 1);
  if (left > right) return;
  for (std::int64_t r = std::max<std::int64_t>(0, row - 1); r <= std::min(rows_ - 1, row + 1);
       ++r) {
    const std::uint32_t first = starts_[static_cast<std::size_t>(r * columns_ + left)];
    const std::uint32_t last = starts_[static_cast<std::size_t>(r * columns_ + right) + 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const float distance_sq = (points_[i].head<2>() - point.head<2>()).squaredNorm();
      if (distance_sq > limit_sq) continue;
      if (count == kMostCandidates) shrink();
      found[count++] = {distance_sq, i};
    }
  }
  if (count > settings_.most_points) shrink();
  // Sums of one order give one result, whatever the grid's cells were.
  std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
  neighbours.count = count;
  for (std::size_t i = 0; i < count; ++i) neighbours.point[i] = points_[found[i].index] - point;
}

LocalSurface LocalSurfaces::at(const Eigen::Vector3f& point) const {
  Neighbours neighbours;
  if (!points_.empty() && point.allFinite()) gather(point, neighbours);
  const auto least = static_cast<std::size_t>(settings_.least_support);
  if (neighbours.count < least) return {};
  PlaneSums sums;
  for (std::size_t i = 0; i < neighbours.count; ++i) sums.add(neighbours.point[i]);
  Plane plane;
  if (!sums.solve(0.15 * radius_, plane)) return {};
  const float over_length = plane.over_length();
  double sum_sq = 0.0;
  for (std::size_t i = 0; i < neighbours.count; ++i) {
    const double distance = plane.above(neighbours.point[i]) * over_length;
    sum_sq += distance * distance;
  }
  const double half = 0.5 * settings_.tolerance;
  const bool flat = sum_sq <= half * half * static_cast<double>(neighbours.count);
  const bool on_it = std::abs(plane.height) * over_length <= settings_.tolerance;
  const double steepest = std::cos(settings_.steepest * kRadiansPerDegree);
  if (flat && on_it && over_length >= steepest &&
      !bridges(plane, neighbours.point, neighbours.count, std::numeric_limits<float>::max()))
    return surfaceOf(plane, sum_sq, neighbours.count);
  return robust(neighbours);
}

LocalSurface LocalSurfaces::robust(const Neighbours& neighbours) const {
  const std::size_t n = neighbours.count;
  const auto tolerance = static_cast<float>(settings_.tolerance);
  const auto steepest = static_cast<float>(std::cos(settings_.steepest * kRadiansPerDegree));
  Plane best;
  float best_cost = std::numeric_limits<float>::infinity();
  // Neighbours are sorted by distance: one of the nearer half with one of the farther.
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::size_t step : {n / 3 + 1, n / 2 + 1}) {
      const Eigen::Vector3f &a = neighbours.point[i], &b = neighbours.point[(i + step) % n];
      const float d = a.x() * b.y() - a.y() * b.x();
      if (std::abs(d) < 0.3F * a.head<2>().norm() * b.head<2>().norm() || d == 0.0F) continue;
      const Plane plane{0.0F, (a.z() * b.y() - b.z() * a.y()) / d,
                        (a.x() * b.z() - b.x() * a.z()) / d};
      const float over_length = plane.over_length();
      if (!(over_length >= steepest)) continue;
      float cost = 0.0F;
      for (std::size_t k = 0; k < n && cost < best_cost; ++k) {
        const float share = plane.above(neighbours.point[k]) * over_length / tolerance;
        cost += std::min(1.0F, share * share);
      }
      if (cost < best_cost && !bridges(plane, neighbours.point, n, tolerance))
        best_cost = cost, best = plane;
    }
  }
  if (!std::isfinite(best_cost)) return {};
  double sum_sq = 0.0;
  std::size_t support = 0;
  for (int round = 0; round < 2; ++round) {
    PlaneSums sums;
    const float over_length = best.over_length();
    for (std::size_t k = 0; k < n; ++k) {
      if (std::abs(best.above(neighbours.point[k])) * over_length <= tolerance)
        sums.add(neighbours.point[k]);
    }
    support = static_cast<std::size_t>(sums.n);
    if (support < static_cast<std::size_t>(settings_.least_support)) return {};
    if (!sums.solve(0.15 * radius_, best)) return {};
  }
  const float over_length = best.over_length();
  support = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double distance = best.above(neighbours.point[k]) * over_length;
    if (std::abs(distance) > tolerance) continue;
    sum_sq += distance * distance;
    ++support;
  }
  const double share = static_cast<double>(support) / static_cast<double>(n);
  const bool enough = support >= static_cast<std::size_t>(settings_.least_support) &&
                      share >= settings_.least_share;
  const bool on_it = std::abs(best.height) * over_length <= tolerance;
  if (!enough || !on_it || over_length < steepest) return {};
  if (bridges(best, neighbours.point, n, tolerance)) return {};
  const double half = 0.6 * settings_.tolerance;
  if (sum_sq > half * half * static_cast<double>(support)) return {};
  return surfaceOf(best, sum_sq, support);
}

}  // namespace pcl_als
