// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "fisher_bound.h"

#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>
#include <utility>

#include <Eigen/LU>

#include <pcl_als/common/parallel.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als::bench {
namespace {

constexpr double kThreshold = 0.25;  // metres, what a calibration of such a block ends with

/// N, and the covariance of A'P'e for errors of the points, not of the pairs.
struct Information {
  SystemMatrix normal = SystemMatrix::Zero(), spread = SystemMatrix::Zero();
};

/// How the range errors of one area's points enter its normal equations.
class PointShares {
 public:
  PointShares(const MatchedBlock& block, std::size_t area, double range)
      : block_(block), area_(area), range_(range) {}

  void add(const PairObservation& o) {
    const std::optional<PatchMatch> match = patchOf(o);
    if (!match) return;
    const SystemVector weighted = o.row().transpose() / o.variance;
    if (o.a != PairObservation::kControl) share(o.a, indexAt(o.a, o.time_a), weighted, o.normal);
    const auto& triangle = surface(o.b).tin().triangles()[match->triangle];
    for (int i = 0; i < 3; ++i)
      share(o.b, triangle.vertex[i], -match->weights[i] * weighted, o.normal);
  }

  SystemMatrix outerProducts() const {
    SystemMatrix sum = SystemMatrix::Zero();
    for (const auto& [point, share] : shares_) sum += share * share.transpose();
    return sum;
  }

 private:
  const PatchSurface& surface(int strip) const { return block_.area(area_).surfaceOf(strip); }

  std::optional<PatchMatch> patchOf(const PairObservation& o) {
    if (o.a == PairObservation::kControl)
      return surface(o.b).vertical(block_.controlOf(area_).position);
    return surface(o.b).closest(surface(o.a).tin().points()[indexAt(o.a, o.time_a)], kThreshold);
  }

  std::int32_t indexAt(int strip, double time) {
    auto& index = index_[strip];
    const std::vector<double>& times = block_.times(area_, strip);
    for (std::size_t i = index.size(); i < times.size(); ++i)
      index.emplace(times[i], static_cast<std::int32_t>(i));
    return index.at(time);
  }

  /// \a weighted: what an error of one metre along the normal adds to A'P'e.
  void share(int strip, std::int32_t point, const SystemVector& weighted,
             const Eigen::Vector3d& normal) {
    SensorPose pose;
    const double time = block_.times(area_, strip)[static_cast<std::size_t>(point)];
    if (!block_.flight().poseAt(time, pose, cursor_)) return;
    const Eigen::Vector3d beam =
        scanGeometry(pose, surface(strip).tin().points()[static_cast<std::size_t>(point)]).beam();
    shares_.try_emplace({strip, point}, SystemVector::Zero()).first->second +=
        range_ * normal.dot(beam) * weighted;
  }

  const MatchedBlock& block_;
  std::size_t area_;
  double range_;
  std::size_t cursor_ = 0;
  std::map<int, std::unordered_map<double, std::int32_t>> index_;
  std::map<std::pair<int, std::int32_t>, SystemVector> shares_;
};

Information informationOf(const MatchedBlock& block, double range) {
  const NoiseModel noise{range, 0.0, 0.0, 0.0};
  const std::vector<AreaObservations> areas = block.match(kThreshold, noise);
  std::vector<Information> parts(areas.size());
  parallelFor(areas.size(), 0, [&](std::size_t i) {
    PointShares shares(block, i, range);
    for (const PairObservation& o : areas[i]) {
      parts[i].normal += o.row().transpose() * o.row() / o.variance;
      shares.add(o);
    }
    parts[i].spread = shares.outerProducts();
  });
  Information sum;
  for (const Information& part : parts) {
    sum.normal += part.normal;
    sum.spread += part.spread;
  }
  return sum;
}

}  // namespace

FisherBound fisherBound(const MatchedBlock& block, double range,
                        const std::vector<SystemParameter>& estimate) {
  const Information information = informationOf(block, range);
  const auto size = static_cast<Eigen::Index>(estimate.size());
  Eigen::MatrixXd select = Eigen::MatrixXd::Zero(size, kSystemParameterCount);
  for (Eigen::Index i = 0; i < size; ++i) {
    const int column = indexOf(estimate[static_cast<std::size_t>(i)]);
    select(i, column) = 1.0 / std::sqrt(information.normal(column, column));
  }
  const Eigen::MatrixXd inverse = (select * information.normal * select.transpose()).inverse();
  const Eigen::MatrixXd covariance = select.transpose() * inverse * select;
  FisherBound bound;
  bound.independent = covariance.diagonal().cwiseSqrt();
  bound.shared = (covariance * information.spread * covariance.transpose()).diagonal().cwiseSqrt();
  return bound;
}

}  // namespace pcl_als::bench
