// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Cholesky>

#include <pcl_als/common/statistics.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/photogrammetry/roof_lines.h>

namespace pcl_als {
namespace {

using Eigen::Matrix4d;
using Eigen::Vector3d;
using Eigen::Vector4d;

const double kParallel = std::cos(8.0 * kRadiansPerDegree);
constexpr std::size_t kFewestDifferences = 10;

/// Offsets across the reference, at its ends, as a linear function of those of another line at the
/// other's ends: value and derivative.
struct Transferred {
  Vector4d offsets;
  Matrix4d covariance;
};

Transferred transferred(const ObjectLine& line, const ObjectLine& reference) {
  const Vector3d along = (line.end - line.start).normalized();
  const Vector3d base = (reference.end - reference.start).normalized();
  const Eigen::Matrix<double, 3, 2> own = acrossLine(along), across = acrossLine(base);
  Transferred result;
  Matrix4d derivative = Matrix4d::Zero();
  for (int end = 0; end < 2; ++end) {
    const Vector3d at = end == 0 ? reference.start : reference.end;
    // The point of the line in the plane through the end across the reference.
    const double t = base.dot(at - line.start) / base.dot(along);
    const double share = t / line.length();
    const Vector3d point = line.start + t * along;
    result.offsets.segment<2>(2 * end) = across.transpose() * (point - at);
    const Eigen::Matrix2d turn = across.transpose() * own;
    derivative.block<2, 2>(2 * end, 0) = (1.0 - share) * turn;
    derivative.block<2, 2>(2 * end, 2) = share * turn;
  }
  result.covariance = derivative * line.covariance * derivative.transpose();
  return result;
}

/// Whether two lines of different strips are the same roof line.
bool areSame(const ObjectLine& a, const ObjectLine& b, double distance) {
  if (a.kind != b.kind) return false;
  const Vector3d along = (a.end - a.start).normalized();
  if (std::abs(along.dot((b.end - b.start).normalized())) < kParallel) return false;
  const double from = along.dot(b.start - a.start), to = along.dot(b.end - a.start);
  const double overlap =
      std::min(a.length(), std::max(from, to)) - std::max(0.0, std::min(from, to));
  if (overlap < 0.5 * std::min(a.length(), b.length())) return false;
  const Vector3d middle = 0.5 * (b.start + b.end) - a.start;
  return (middle - along.dot(middle) * along).norm() < distance;
}

struct Member {
  std::size_t strip;
  const StripLine* line;
};

/// The lines of all strips in groups of the same roof line, at most one of a strip.
std::vector<std::vector<Member>> groupsOf(const std::vector<std::vector<StripLine>>& strips,
                                          double distance) {
  std::vector<std::vector<Member>> groups;
  for (std::size_t s = 0; s < strips.size(); ++s) {
    const std::size_t before = groups.size();
    for (const StripLine& line : strips[s]) {
      bool joined = false;
      for (std::size_t g = 0; g < before && !joined; ++g) {
        if (groups[g].back().strip == s) continue;
        if ((groups[g].front().line->line.start - line.line.start).head<2>().norm() > 200.0)
          continue;
        if (!areSame(groups[g].front().line->line, line.line, distance)) continue;
        groups[g].push_back({s, &line});
        joined = true;
      }
      if (!joined) groups.push_back({{s, &line}});
    }
  }
  return groups;
}

/// Difference of two strips at the middle of a line, across and upwards, and what the planes
/// explain of it.
struct Difference {
  Eigen::Vector2d value;
  Eigen::Vector2d variance;
};

std::vector<Difference> differencesOf(const std::vector<std::vector<Member>>& groups) {
  Eigen::Matrix<double, 2, 4> mean;
  mean << 0.5, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.5;
  std::vector<Difference> differences;
  for (const std::vector<Member>& group : groups) {
    const ObjectLine& reference = group.front().line->line;
    for (std::size_t i = 1; i < group.size(); ++i) {
      const Transferred other = transferred(group[i].line->line, reference);
      const Eigen::Matrix2d covariance =
          mean * (other.covariance + reference.covariance) * mean.transpose();
      differences.push_back({mean * other.offsets, covariance.diagonal()});
    }
  }
  return differences;
}

/// Standard deviation of a strip from differences of two, robustly: the median of squares beyond
/// what the planes explain.
double errorOf(const std::vector<Difference>& differences, int component, double assumed) {
  if (differences.size() < kFewestDifferences) return assumed;
  double low = 0.0, high = 4.0;
  // The variance with which half of the standardised differences are below the quartile.
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    std::vector<double> standardised;
    for (const Difference& d : differences)
      standardised.push_back(d.value[component] / std::sqrt(d.variance[component] + 2.0 * middle));
    (robustSigmaAboutZero(std::move(standardised)) > 1.0 ? low : high) = middle;
  }
  return std::sqrt(high);
}

ObjectLine combined(const std::vector<Member>& group, const LineErrors& errors,
                    const std::vector<std::string>& names) {
  // The longest is the reference: the others are transferred to its ends.
  const auto longest =
      std::max_element(group.begin(), group.end(), [](const Member& a, const Member& b) {
        return a.line->line.length() < b.line->line.length();
      });
  ObjectLine line = longest->line->line;
  const Vector3d along = (line.end - line.start).normalized();
  Matrix4d strip = Matrix4d::Zero();
  for (const int i : {0, 2}) {
    for (const int k : {0, 2}) {
      strip(i, k) = errors.plan * errors.plan;
      strip(i + 1, k + 1) = errors.height * errors.height;
    }
  }
  Matrix4d weights = Matrix4d::Zero();
  Vector4d sum = Vector4d::Zero();
  for (const Member& member : group) {
    const Transferred one = transferred(member.line->line, line);
    // A little of its own at each end, so that the sum of two common errors can be inverted.
    const Matrix4d weight = (one.covariance + strip + 1e-8 * Matrix4d::Identity()).inverse();
    weights += weight;
    sum += weight * one.offsets;
    line.strips.push_back(names[member.strip]);
  }
  line.covariance = weights.inverse();
  const Vector4d offsets = line.covariance * sum;
  const Eigen::Matrix<double, 3, 2> across = acrossLine(along);
  line.start += across * offsets.head<2>();
  line.end += across * offsets.tail<2>();
  return line;
}

}  // namespace

std::vector<ObjectLine> combineLines(const std::vector<std::vector<StripLine>>& strips,
                                     const std::vector<std::string>& names, double distance,
                                     const LineErrors& assumed, LineErrors* found) {
  const std::vector<std::vector<Member>> groups = groupsOf(strips, distance);
  const std::vector<Difference> differences = differencesOf(groups);
  LineErrors errors;
  errors.plan = errorOf(differences, 0, assumed.plan);
  errors.height = errorOf(differences, 1, assumed.height);
  errors.differences = differences.size();
  std::vector<ObjectLine> lines;
  lines.reserve(groups.size());
  for (const std::vector<Member>& group : groups) lines.push_back(combined(group, errors, names));
  std::sort(lines.begin(), lines.end(), [](const ObjectLine& a, const ObjectLine& b) {
    return std::pair(a.start.x(), a.start.y()) < std::pair(b.start.x(), b.start.y());
  });
  for (std::size_t i = 0; i < lines.size(); ++i) lines[i].id = "L" + std::to_string(i + 1);
  if (found != nullptr) *found = errors;
  return lines;
}

}  // namespace pcl_als
