// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/error_source.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

using SystemRow = Eigen::Matrix<double, 1, kSystemParameterCount>;
/// Effect of the parameters on a point, ground frame; single precision, to limit memory.
using PairDesign = Eigen::Matrix<float, 3, kSystemParameterCount, Eigen::DontAlign>;
/// Effect of the three boresight angles on a distance; single precision.
using PairTurn = Eigen::RowVector3f;

/// Which part of the points of a strip a surface consists of, see AreaMatcher::prepare().
enum class Look : std::int8_t {
  whole,
  ahead = whole,  ///< pulses ahead of the sensor
  back,           ///< pulses behind the sensor
};

/** \brief One point-patch pair as one scalar equation, n'(y - A delta) with A = A_A - A_B (Eqs.
 * (11), (12), (34)).
 *
 * a is the strip of the point, b that of the patch. For control, a is kControl, the point is the
 * control point and row_a is zero.
 */
struct PairObservation {
  static constexpr int kControl = -1;
  /// What the error of a control point is an error of.
  enum class ControlError : std::int8_t {
    height,
    along_normal,  ///< of a planar patch
    plan,          ///< of the position of a target in plan; the normal is horizontal
  };

  int a = kControl, b = 0;
  Look look_a = Look::whole, look_b = Look::whole;    ///< of the strips' surfaces
  ControlError control_error = ControlError::height;  ///< of control only
  std::int32_t point = -1;  ///< of strip a, in the area's TIN; -1 for control
  /// Times of emission of the point and of the patch, seconds; the mean of its vertices.
  double time_a = 0.0, time_b = 0.0;
  SystemRow row_a = SystemRow::Zero();  ///< n' A_A
  SystemRow row_b = SystemRow::Zero();  ///< n' A_B, A interpolated in the patch at the point's foot
  /// n' A_A and n' A_B of the three boresight angles, for trajectory errors of strips that are held
  /// fixed, whose rows are zero.
  PairTurn turn_a = PairTurn::Zero(), turn_b = PairTurn::Zero();
  /// A vertex of the patch.
  struct Vertex {
    double time = 0.0;                 ///< of emission, seconds
    float weight = 0.0F;               ///< of the interpolation at the point's foot
    PairTurn turn = PairTurn::Zero();  ///< n' A of the three boresight angles, or that of turn_b
  };
  /// Whether the vertices were measured so far apart in time (rosette scanners) that each has a
  /// trajectory error of its own; that of the patch is their weighted mean.
  bool mixed_times = false;
  std::array<Vertex, 3> vertices;          ///< with mixed_times
  Eigen::Vector3d normal;                  ///< unit, upward or horizontal, ground frame
  PairDesign design = PairDesign::Zero();  ///< A: row() = n' A
  /// Variance of the direction of the normal, rad^2; zero where the distance is vertical.
  double tilt_variance = 0.0;
  /// n'(X_A - X_B) of the corrected coordinates plus the effect of the biases they were corrected
  /// for, metres. The rows are those of the corrected geometry, so that the solution is that of the
  /// model itself and not of its linearisation at the biased points.
  double misclosure = 0.0;
  /// part of the misclosure that represents other pairs, see ChosenPair, metres
  double offset = 0.0;
  double variance = 0.0;  ///< n' Sigma n of the discrepancy, m^2
  double pointing = 0.0;  ///< part of it due to pointing and footprint, m^2
  /// Sum of the absolute covariances with all pairs of the area (itself included) over the
  /// variance: a point may form pairs in several strips and be a vertex of several patches, see
  /// NoiseShares.
  double sharing = 1.0;
  /// Effects of the error sources on the distance, in the order of ErrorSource. Those that are not
  /// considered are zero, except for that of the range scale.
  ErrorSourceRow sources = ErrorSourceRow::Zero();
  /// Of the distance, metres: effect of what is corrected besides the biases of the first system
  /// (error sources, differences between systems). Ignored by the adjustment.
  double further = 0.0;
  double lateral = 0.0,
         height = 0.0;  ///< |x| and |z| of the patch in the laser unit's frame, metres

  SystemRow row() const { return row_a - row_b; }
  /// The surfaces of the point and of the patch, counted over all strips of the block.
  int surfaceA() const { return surfaceIndex(a, look_a); }
  int surfaceB() const { return surfaceIndex(b, look_b); }
  static int surfaceIndex(int strip, Look look) { return 2 * strip + static_cast<int>(look); }
  /// Pairs exist in both directions. Distances are reported as heights of the first strip above the
  /// second, or of the look ahead above the look back: 1, or -1 where the patch is in the first.
  double sign() const { return surfaceA() < surfaceB() ? 1.0 : -1.0; }
  /// The plan position of a target; other control shows the height of strips above it.
  bool isInPlan() const { return a == kControl && control_error == ControlError::plan; }
  /// The effect of the error of a control point on the distance.
  double effectOfControl() const {
    return control_error == ControlError::height ? normal.z() : 1.0;
  }
  /// Of a distance from control: the strip above it, vertically or along the normal of a patch; in
  /// plan, the strip's target beyond the surveyed one in the direction of the normal.
  double aboveControl(double of_distance) const { return -of_distance / effectOfControl(); }
  /// Normal distance of the corrected point above the corrected patch, metres.
  double distance(const SystemVector& biases) const {
    return misclosure - row() * biases - further;
  }
  /// Effect on the distance of the unknowns of a system that measured the point, or the patch.
  double effectAtPoint(const SystemUnknowns& u) const {
    return row_a * u.head<kSystemParameterCount>() + normal.dot(u.tail<3>());
  }
  double effectAtPatch(const SystemUnknowns& u) const {
    return row_b * u.head<kSystemParameterCount>() + normal.dot(u.tail<3>());
  }
};

/// The pairs of one area. Areas are the units of computation, and the clusters of the jackknife.
using AreaObservations = std::vector<PairObservation>;

/// Observations by area, with weights as for Adjustment::accumulate.
struct WeightedObservations {
  std::vector<AreaObservations> observations;
  std::vector<std::vector<double>> weights;
};

/// So many observations represent a block in further adjustments.
inline constexpr std::size_t kRepresentative = 10'000;

/// Every k-th observation of an area with k times its weight and zero misclosure, so that about
/// \a count remain, and all control: nearly the same information at less cost.
WeightedObservations thinned(const std::vector<AreaObservations>& observations,
                             const std::vector<std::vector<double>>& weights, std::size_t count);

/// First and last of some times, seconds.
using TimeSpan = std::pair<double, double>;

/// The spans that some times cover without gaps of more than 10 s, in increasing order.
std::vector<TimeSpan> continuousSpans(const std::vector<double>& times);

/// Times at which each of \a strips strips is observed, one span for every crossing of an area.
std::vector<std::vector<TimeSpan>> observedTimes(const std::vector<AreaObservations>& areas,
                                                 std::size_t strips);

// Rules that measured pairs (AreaMatcher) and synthetic pairs of planned lines (SyntheticPairs of
// module planning) have in common.

/// Tilt over its standard deviation above which it is significant; below, distances are vertical.
constexpr double kSignificantTilt = 5.0;

/// Candidates of a strip in an area, for \a all candidates of a block, the number of combinations
/// of strip and area, and that of two strips and area in both directions. Where many strips overlap
/// each other they are fewer, so that a block has about six pairs for each of \a all, but a strip
/// has some 300 pairs in an area where it has 40 to 150 candidates.
template <typename Amount>
Amount candidatesPerStrip(Amount all, Amount strips_in_areas, Amount pairs_in_areas) {
  constexpr Amount kPairs = 6, kFewestPairs = 300, kFewest = 40, kEnough = 150;
  const Amount pairs = std::max<Amount>(1, pairs_in_areas);
  const Amount fewest =
      std::clamp<Amount>(kFewestPairs * strips_in_areas / pairs, kFewest, kEnough);
  return std::max(std::min(all / strips_in_areas, kPairs * all / pairs), fewest);
}

/// Effect of the stretch of the pulse over the footprint on the normal distance, n'u range
/// divergence tan(incidence), with \a beam = u the unit vector of the pulse.
inline double stretchEffect(double range, const Eigen::Vector3d& beam,
                            const Eigen::Vector3d& normal, double divergence) {
  const double cosine = normal.dot(beam);
  return -range * divergence * std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
}

}  // namespace pcl_als
