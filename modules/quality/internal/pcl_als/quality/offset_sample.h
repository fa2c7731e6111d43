// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Offset of two strips at a place.
 *
 * A point of either strip is compared with a TIN patch of the other; all signs are those of a - b,
 * whichever strip the point belongs to.
 */
struct OffsetSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the point, metres, ground frame
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< of the surface around, unit, upward
  double vertical = 0.0;                               ///< height of a above b, metres; where level
  double normal_distance = 0.0;       ///< the same along the normal, metres; where conjugate
  double time_a = 0.0, time_b = 0.0;  ///< seconds
  float scan_angle_a = 0.0F, scan_angle_b = 0.0F;  ///< degrees
  float slope = 0.0F;                              ///< radians from horizontal
  bool level = false;      ///< smooth ground of single returns below 10 degrees, used for RMSDz
  bool conjugate = false;  ///< has a conjugate patch, used for normal distances and shifts
  bool identical = false;  ///< the other strip has a point with the same coordinates: a copy

  /// Ground cells of kCluster metres, within which errors count as correlated.
  static constexpr double kCluster = 25.0;
  std::int64_t cluster() const;
  static Eigen::Vector2d centreOf(std::int64_t cluster);
};

/// Statistics of signed offsets, metres.
struct OffsetSummary {
  std::size_t count = 0;
  double mean = 0.0, std = 0.0, rms = 0.0;
  double median = 0.0;
  double nmad = 0.0;           ///< 1.4826 times the median absolute deviation
  double percentile_95 = 0.0;  ///< of the absolute values
  double largest = 0.0;        ///< absolute value
  double std_of_mean =
      0.0;  ///< with correlated errors of places (ClusteredRegression); NaN: unknown
  double std_of_mean_formal = 0.0;  ///< the same with clusters as independent; NaN: unknown
};

/// \param clusters of each value, as many as values
/// \param places plan positions of the values, metres; empty: clusters are independent
OffsetSummary summarize(std::vector<double> values, const std::vector<std::int64_t>& clusters,
                        const std::vector<Eigen::Vector2d>& places = {});

}  // namespace pcl_als
