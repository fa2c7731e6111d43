// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/quality/offset_sample.h>

namespace pcl_als {

/// A straight line through offsets: their change with distance, time or scan angle.
struct Trend {
  bool determined = false;
  double slope = 0.0, std = 0.0;  ///< metres per unit
};

/// Mean offset of an interval of distance, time or scan angle.
struct ProfileBin {
  double from = 0.0, to = 0.0;  ///< the interval
  std::size_t count = 0;
  double mean = 0.0, std = 0.0;  ///< metres
};

/// Relative direction of two flight lines.
enum class FlightRelation { unknown, parallel, opposite, crossing };

/** \brief Change of the height of strip a above strip b across and along their overlap, with time
 * and with scan angle.
 *
 * The height error of a strip with a roll error dphi (assumed - true, radians) is -x dphi at the
 * lateral distance x, right of flight (Habib et al. 2011, Eq. (8)). The offset a - b therefore
 * changes across the overlap (to the right of a's flight) by -(dphi_a + dphi_b) for opposite lines
 * and by -(dphi_a - dphi_b) for parallel ones; each of two crossing lines shows its own roll error
 * across its flight. Standard deviations are those of ClusteredRegression.
 */
struct OverlapTrends {
  FlightRelation relation = FlightRelation::unknown;
  Eigen::Vector2d course = Eigen::Vector2d::UnitY();  ///< of a, plan unit vector; where known
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();   ///< a point of the centre line, metres
  Trend across;                                       ///< per metre to the right of a's flight
  Trend along;                                        ///< per metre along it
  Trend time;                                         ///< per second of a
  Trend scan_angle;                                   ///< per degree of a

  /// Roll errors in radians, where the offsets determine them: opposite: mean of both, a common
  /// error such as that of the boresight; parallel: a - b; crossing: first a, then b.
  struct Roll {
    bool determined = false;
    double value = 0.0, std = 0.0;
  };
  Roll roll, roll_b;

  std::vector<ProfileBin> by_distance, by_time, by_scan_angle;

  /// Distance right of the centre line, metres.
  double distance(const Eigen::Vector3d& position) const {
    const Eigen::Vector2d from = position.head<2>() - centre;
    return from.x() * course.y() - from.y() * course.x();
  }
  double distanceAlong(const Eigen::Vector3d& position) const {
    return (position.head<2>() - centre).dot(course);
  }
};

/// From the level samples; courses are those of StripCourse. Without a course of a, the longer axis
/// of the overlap is used instead, and no roll is computed.
OverlapTrends overlapTrends(const std::vector<OffsetSample>& samples,
                            const std::optional<Eigen::Vector2d>& course_a,
                            const std::optional<Eigen::Vector2d>& course_b);

}  // namespace pcl_als
