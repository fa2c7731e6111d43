// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pair_search.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/parallel.h>

namespace pcl_als::registration {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSignificant = 5.0;  // standard deviations: smaller tilts are not significant
constexpr double kLeastAngle = 0.09;  // sine of the angle between normals that is always allowed
// sine of the angle between normals beyond which patches are not conjugate
constexpr double kMostAngle = 0.35;
constexpr std::size_t kChunk = 4096;

/// Search of the patches of one side for the candidates of the other.
class DirectedSearch {
 public:
  DirectedSearch(const Eigen::Affine3d& motion, bool source_point, double threshold,
                 const PlanGrid& groups, const PointNoise& noise)
      : motion_(motion),
        there_(source_point ? motion : motion.inverse()),
        turn_(motion.linear() / std::cbrt(motion.linear().determinant())),
        up_((Vector3d::UnitZ() + turn_.col(2)).normalized()),
        source_point_(source_point),
        threshold_(threshold),
        groups_(groups),
        noise_(noise) {}

  void run(Candidate* candidates, std::size_t count, std::size_t stride, SurfaceSide& patches,
           PatchPairs& pairs) const {
    for (std::size_t i = 0; i < count; i += stride) {
      Candidate& candidate = candidates[i];
      const Vector3d moved = there_ * candidate.position;
      const auto match = patches.patchOf(candidate, moved, threshold_);
      PatchPair pair;
      if (!match || !direction(candidate, patches.isCoarse(), pair)) continue;
      fill(candidate, moved, *match, pair);
      pairs.push_back(pair);
    }
  }

 private:
  /// Mean normal of the neighbourhoods of point and patch in the target's frame, less noisy than
  /// that of the triangle; vertical where its tilt is not significant, because noise of the normal
  /// would act as information about plan positions. False where the orientations of the two
  /// surfaces differ.
  bool direction(const Candidate& candidate, bool coarse, PatchPair& pair) const {
    const PatchPlane& patch = candidate.patch_plane;
    Vector3d& normal = pair.normal;
    pair.tilt_variance = 0.0;
    if (coarse) {
      normal = source_point_ ? patch.normal : Vector3d(turn_ * patch.normal);
      return true;
    }
    const Vector3d& in_source = source_point_ ? candidate.plane.normal : patch.normal;
    const Vector3d& in_target = source_point_ ? patch.normal : candidate.plane.normal;
    const Vector3d a = turn_ * in_source;
    const double sigma = candidate.tilt_sigma;
    const double most = std::clamp(kSignificant * sigma, kLeastAngle, kMostAngle);
    if (a.dot(in_target) < 0.0 || a.cross(in_target).squaredNorm() > most * most) return false;
    normal = (a + in_target).normalized();
    const double noise = 0.5 * sigma;  // of the mean
    if (normal.cross(up_).norm() < kSignificant * noise)
      normal = up_;
    else
      pair.tilt_variance = noise * noise;
    return true;
  }

  void fill(const Candidate& candidate, const Vector3d& moved, const PatchMatch& match,
            PatchPair& pair) const {
    const Vector3d& source = source_point_ ? candidate.position : match.foot;
    const Vector3d& target = source_point_ ? match.foot : candidate.position;
    pair.position = source_point_ ? moved : Vector3d(motion_ * match.foot);
    pair.distance = pair.normal.dot(pair.position - target);
    pair.start_distance = pair.normal.dot(source - target);
    // The foot is the weighted mean of three vertices.
    const double spread = match.weights.squaredNorm();
    pair.variance = pair.normal.dot(((source_point_ ? 1.0 : spread) * noise_.source +
                                     (source_point_ ? spread : 1.0) * noise_.target) *
                                    pair.normal);
    const std::int64_t group = groups_.cellOf(candidate.position.x(), candidate.position.y());
    pair.group = static_cast<std::uint32_t>(std::max<std::int64_t>(0, group));
    pair.source_point = source_point_;
  }

  Eigen::Affine3d motion_, there_;
  Matrix3d turn_;
  Vector3d up_;
  bool source_point_;
  double threshold_;
  const PlanGrid& groups_;
  const PointNoise& noise_;
};

/// The part of the search of one thread.
struct Task {
  Candidate *first, *last;
  SurfaceSide* patches;
  bool source_point;
  PatchPairs pairs;
};

void addTasks(SurfaceSide& points, SurfaceSide& patches, bool source_point,
              std::vector<Task>& tasks) {
  if (points.empty() || patches.empty()) return;
  auto& candidates = points.candidates();
  // The suitability of patches is stored without locks: a fine area is one task; a coarse one
  // stores none.
  const std::size_t step =
      patches.isCoarse() ? kChunk : std::max<std::size_t>(1, candidates.size());
  for (std::size_t i = 0; i < candidates.size(); i += step) {
    Candidate* const first = candidates.data() + i;
    tasks.push_back(
        {first, first + std::min(step, candidates.size() - i), &patches, source_point, {}});
  }
}

}  // namespace

PatchPairs findPairs(std::vector<AreaSurfaces>& areas, const Eigen::Affine3d& motion,
                     double threshold, const PlanGrid& groups, const PointNoise& noise, int threads,
                     std::size_t stride) {
  const DirectedSearch forward(motion, true, threshold, groups, noise);
  const DirectedSearch backward(motion, false, threshold, groups, noise);
  std::vector<Task> tasks;
  for (AreaSurfaces& area : areas) {
    addTasks(area.source, area.target, true, tasks);
    addTasks(area.target, area.source, false, tasks);
  }
  parallelFor(tasks.size(), threads, [&](std::size_t i) {
    Task& task = tasks[i];
    const auto count = static_cast<std::size_t>(task.last - task.first);
    task.pairs.reserve(count / stride + 1);
    (task.source_point ? forward : backward)
        .run(task.first, count, stride, *task.patches, task.pairs);
  });
  PatchPairs pairs;
  std::size_t count = 0;
  for (const Task& task : tasks) count += task.pairs.size();
  pairs.reserve(count);
  for (const Task& task : tasks) pairs.insert(pairs.end(), task.pairs.begin(), task.pairs.end());
  return pairs;
}

}  // namespace pcl_als::registration
