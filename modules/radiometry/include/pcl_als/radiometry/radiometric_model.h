// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include <Eigen/Core>

#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/trajectory/point_columns.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief The radar equation for extended targets, with every term to be weighed.
 *
 * Habib et al. 2011, Eq. (35)-(36): an extended Lambertian target that holds the footprint sends
 * back rho cos(theta) exp(-2 a r) / r^2. Corrected to the reference range,
 * I_c = I (r / r0)^m / cos(theta)^k exp(2 a (r - r0)), m = 2, k = 1.
 */
struct RadiometricModel {
  double range_exponent = 2.0;      ///< m, [0, 6]; 0: no range term
  double incidence_exponent = 1.0;  ///< k, [0, 4]; 0: no incidence term
  double extinction_per_km = 0.0;   ///< a, one way, [0, 50]
  double reference_range = 1000.0;  ///< r0, metres, (0, 20000]
  double largest_incidence = 75.0;  ///< degrees, (0, 90): steeper incidence counts as this

  void check() const;  ///< UsageError naming value and limits
  /// I_c / I. \a cosine: of the incidence angle; NaN: no incidence term.
  double factor(double range, double cosine) const;
};

/// What could be done for a point.
enum class RadiometryStatus : std::uint8_t {
  surface,       ///< range, atmosphere and incidence
  limited,       ///< the same, with the largest incidence in place of a steeper one
  no_surface,    ///< no plane (leaves, wires, edges): range and atmosphere only
  partial,       ///< a return that is not the last: only part of the energy; range and atmosphere
  uncovered,     ///< the trajectory does not cover its time: left as it is
  above_sensor,  ///< not below the sensor: left as it is
  not_finite,    ///< no coordinates: left as it is
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

/// A point as RadiometricEvaluator needs it.
struct RadiometryPoint {
  double time = 0.0;                                   ///< the trajectory's
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, ground frame
  std::uint8_t return_number = 1, number_of_returns = 1;
};

/// Where the last point was found on the flight: points in order of time are looked up once per
/// piece of flight. Start with an empty one.
struct RadiometryCursor {
  std::size_t node = 0;
  PathSpan span;
};

/// Columns that receive what evaluateRanges() finds of points.
struct RangeColumns {
  double* range = nullptr;   ///< metres; NaN: left as it is
  double* factor = nullptr;  ///< corrected over given intensity; 1: left as it is
};

/// Points that evaluateRanges() left as they are.
struct RangeCounts {
  std::uint64_t uncovered = 0, above_sensor = 0;
};

/** \brief Applies a RadiometricModel to points of a flight.
 *
 * The range is that from the trajectory's position at the point's time to the point; a lever arm of
 * decimetres between the two is a relative error of 1e-4 to 1e-3 and is left out. Incidence is the
 * angle between that line and the surface's normal. Thread-safe.
 */
class RadiometricEvaluator {
 public:
  /// UsageError for a null trajectory or a model out of range.
  RadiometricEvaluator(std::shared_ptr<const Trajectory> trajectory, const RadiometricModel& model);

  const RadiometricModel& model() const { return model_; }
  const Trajectory& trajectory() const { return *trajectory_; }
  PointRadiometry evaluate(const RadiometryPoint& point, const LocalSurface& surface,
                           RadiometryCursor& cursor) const;

  /// As evaluate() of points without surfaces, many at a time; factors agree to 2e-11. Positions
  /// must be finite.
  RangeCounts evaluateRanges(const PointColumns& points, std::size_t count, const RangeColumns& out,
                             RadiometryCursor& cursor) const;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  RadiometricModel model_;
  double least_cosine_;
};

}  // namespace pcl_als
