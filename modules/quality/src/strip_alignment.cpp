// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/quality/area_offsets.h>
#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/registration/patch_alignment.h>
#include <pcl_als/registration/point_view.h>

#include "strip_triples.h"

namespace pcl_als {
namespace {

using Points = std::vector<Eigen::Vector3f>;

Points pointsOf(const std::vector<AreaOffsets>& areas, int strip, int other,
                const Eigen::Vector3d& origin) {
  Points points;
  for (const AreaOffsets& area : areas) {
    if (area.points(other).empty()) continue;
    for (const LidarReturn& point : area.points(strip))
      if (area.area().contains(point.position))
        points.push_back((point.position - origin).cast<float>());
  }
  return points;
}

PointView viewOf(const Points& points, const Eigen::Vector3d& origin) {
  PointView view;
  if (!points.empty()) view.first = reinterpret_cast<const std::byte*>(points.front().data());
  view.stride = sizeof(Eigen::Vector3f);
  view.count = points.size();
  view.origin = origin;
  return view;
}

/// Displacement of a point by a motion, and its covariance.
struct Displacement {
  Eigen::Vector3d shift;
  Eigen::Matrix3d covariance;
};

Displacement displacementAt(const PatchAlignmentResult& result, const Eigen::Vector3d& point) {
  const Eigen::Vector3d arm = point - result.motion.centroid;
  Eigen::Matrix<double, 3, 6> effect;
  Eigen::Matrix3d cross;
  cross << 0.0, -arm.z(), arm.y(), arm.z(), 0.0, -arm.x(), -arm.y(), arm.x(), 0.0;
  effect << Eigen::Matrix3d::Identity(), -cross;
  return {result.motion.apply(point) - point, effect * result.covariance * effect.transpose()};
}

}  // namespace

PatchAlignmentResult registerStrips(const std::vector<AreaOffsets>& areas, int a, int b,
                                    const PatchAlignmentSettings& settings) {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (const AreaOffsets& area : areas) {
    if (area.points(a).empty() || area.points(b).empty()) continue;
    origin += area.points(a).front().position;
    count += 1.0;
  }
  origin = LocalFrame::around(origin / std::max(count, 1.0)).origin;
  const Points source = pointsOf(areas, a, b, origin), target = pointsOf(areas, b, a, origin);
  if (source.empty() || target.empty()) {
    PatchAlignmentResult nothing;
    nothing.message = "no area of the overlap has enough points of both strips";
    return nothing;
  }
  return registerPatches(viewOf(source, origin), viewOf(target, origin), settings);
}

std::vector<MotionClosure> closeMotions(const std::vector<PairMotion>& pairs) {
  std::vector<PairMotion> known;
  for (const PairMotion& pair : pairs)
    if (pair.result.hasConverged() && pair.result.allDetermined()) known.push_back(pair);
  std::vector<MotionClosure> closures;
  for (const detail::StripTriple& triple : detail::stripTriples(known)) {
    const std::array<std::size_t, 3> sides{triple.ab.pair, triple.bc.pair, triple.ac.pair};
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const std::size_t side : sides) middle += known[side].result.motion.centroid / 3.0;
    MotionClosure closure{triple.a, triple.b, triple.c, {}, {}};
    closure.closure.setZero();
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    const double signs[] = {triple.ab.sign, triple.bc.sign, -triple.ac.sign};
    for (std::size_t i = 0; i < 3; ++i) {
      // Motions are so small that the inverse is the negative, to 1e-5 of it.
      const Displacement moved = displacementAt(known[sides[i]].result, middle);
      closure.closure += signs[i] * moved.shift;
      covariance += moved.covariance;
    }
    closure.std = covariance.diagonal().cwiseSqrt();
    closures.push_back(closure);
  }
  return closures;
}

}  // namespace pcl_als
