// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include <Eigen/Core>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/trajectory/point_columns.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief The radar equation for extended targets, with optional terms.
 *
 * Habib et al. 2011, Eq. (35)-(36): the return of an extended Lambertian target that fills the
 * footprint is proportional to rho cos(theta) exp(-2 a r) / r^2. Corrected to the reference range,
 * I_c = I (r / r0)^m / cos(theta)^k exp(2 a (r - r0)), m = 2, k = 1.
 */
struct RadiometricModel {
  double range_exponent = 2.0;      ///< m, [0, 6]; 0: no range term
  double incidence_exponent = 1.0;  ///< k, [0, 4]; 0: no incidence term
  double extinction_per_km = 0.0;   ///< a, one way, [0, 50]
  double reference_range = 1000.0;  ///< r0, metres, (0, 20000]
  /// degrees, (0, 90): larger incidence angles are limited to this
  double largest_incidence = 75.0;

  void check() const;  ///< UsageError naming value and limits
  /// I_c / I. \a cosine: of the incidence angle; NaN: no incidence term.
  double factor(double range, double cosine) const;
};

/// Terms that were applied to a point.
enum class RadiometryStatus : std::uint8_t {
  surface,       ///< range, atmosphere and incidence
  limited,       ///< the same, with the incidence angle limited
  no_surface,    ///< no plane (leaves, wires, edges): range and atmosphere only
  partial,       ///< a return that is not the last: only part of the energy; range and atmosphere
  uncovered,     ///< the trajectory does not cover its time: unchanged
  above_sensor,  ///< not below the sensor: unchanged
  not_finite,    ///< coordinates are not finite: unchanged
};
inline constexpr std::size_t kRadiometryStatusCount = 7;
/// "surface", "limited_incidence", "no_surface", …: the names in reports.
const char* nameOf(RadiometryStatus status);

struct PointRadiometry {
  float range = std::numeric_limits<float>::quiet_NaN();      ///< metres
  float incidence = std::numeric_limits<float>::quiet_NaN();  ///< radians; NaN without a surface
  double factor = 1.0;                                        ///< corrected over given intensity
  RadiometryStatus status = RadiometryStatus::not_finite;
  Eigen::Vector3f beam = Eigen::Vector3f::Zero();  ///< unit, from the sensor to the point
  bool corrected() const { return status < RadiometryStatus::uncovered; }
};

/// Position of the last point on the flight: points in order of time are interpolated once per
/// piece of flight. Start with an empty one.
struct RadiometryCursor {
  std::size_t node = 0;
  PathSpan span;
};

/// Columns for the results of evaluateRanges().
struct RangeColumns {
  double* range = nullptr;   ///< metres; NaN: unchanged
  double* factor = nullptr;  ///< corrected over given intensity; 1: unchanged
};

/// Points that evaluateRanges() left unchanged.
struct RangeCounts {
  std::uint64_t uncovered = 0, above_sensor = 0;
};

/** \brief Applies a RadiometricModel to points of a flight.
 *
 * The range is the distance of the point from the trajectory's position at its time; a lever arm of
 * decimetres between trajectory and laser is a relative error of 1e-4 to 1e-3 and is neglected.
 * Incidence is the angle between that line and the normal of the surface. Thread-safe.
 */
class RadiometricEvaluator {
 public:
  /// UsageError for a null trajectory or a model out of range.
  RadiometricEvaluator(std::shared_ptr<const Trajectory> trajectory, const RadiometricModel& model);

  const RadiometricModel& model() const { return model_; }
  const Trajectory& trajectory() const { return *trajectory_; }
  PointRadiometry evaluate(const LidarReturn& point, const LocalSurface& surface,
                           RadiometryCursor& cursor) const;

  /// As evaluate() for points without surfaces, many at a time; factors agree to 2e-11. Positions
  /// must be finite.
  RangeCounts evaluateRanges(const PointColumns& points, std::size_t count, const RangeColumns& out,
                             RadiometryCursor& cursor) const;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  RadiometricModel model_;
  double least_cosine_;
};

}  // namespace pcl_als
