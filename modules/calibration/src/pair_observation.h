// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/error_source.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als {

using SystemRow = Eigen::Matrix<double, 1, kSystemParameterCount>;
// Coefficients of pairs are in single precision, to limit memory: a relative rounding of 6e-8 at
// each pair, which misclosures take into account.
constexpr int kPairOptions = static_cast<int>(Eigen::RowMajor) | static_cast<int>(Eigen::DontAlign);
using PairRow = Eigen::Matrix<float, 1, kSystemParameterCount, kPairOptions>;
/// Effect of the system parameters on the two components of a point along a patch.
using PairTilt = Eigen::Matrix<float, 2, kSystemParameterCount, kPairOptions>;
using PairSources = Eigen::Matrix<float, 1, kErrorSourceCount, kPairOptions>;
/// Effect of the three boresight angles on a distance.
using BoresightPartials = Eigen::RowVector3f;

/// Which part of the points of a strip a surface consists of, see AreaMatcher::prepare().
enum class ScanHalf : std::int8_t {
  whole,
  fore = whole,  ///< pulses ahead of the sensor
  aft,           ///< pulses behind the sensor
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
  std::int32_t point = -1;  ///< of strip a, in the area's TIN; -1 for control
  ScanHalf half_a = ScanHalf::whole, half_b = ScanHalf::whole;  ///< of the strips' surfaces
  ControlError control_error = ControlError::height;            ///< of control only
  /// Times of emission of the point and of the patch, seconds; the mean of its vertices.
  double time_a = 0.0, time_b = 0.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit, upward or horizontal, ground frame
  PairRow row_a = PairRow::Zero();                    ///< n' A_A
  PairRow row_b = PairRow::Zero();   ///< n' A_B, A interpolated in the patch at the point's foot
  PairTilt tilt = PairTilt::Zero();  ///< effectOfTilt()
  /// Effects of the error sources on the distance, in the order of ErrorSource. Those that are not
  /// considered are zero, except for that of the range scale.
  PairSources sources = PairSources::Zero();
  /// n'(X_A - X_B) of the corrected coordinates plus the effect of the biases they were corrected
  /// for, metres. The rows are those of the corrected geometry, so that the solution is that of the
  /// model itself and not of its linearisation at the biased points.
  double misclosure = 0.0;
  /// part of the misclosure that represents other pairs, see ChosenPair, metres
  float offset = 0.0F;
  float variance = 0.0F;  ///< n' Sigma n of the discrepancy, m^2
  float pointing = 0.0F;  ///< part of it due to pointing and footprint, m^2
  float echo = 0.0F;      ///< part of it that each echo states of its range, m^2
  /// Sum of the absolute covariances with all pairs of the area (itself included) over the
  /// variance: a point may form pairs in several strips and be a vertex of several patches, see
  /// NoiseShares.
  float variance_inflation = 1.0F;
  /// Of the distance, metres: effect of what is corrected besides the biases of the first system
  /// (error sources, differences between systems). Ignored by the adjustment.
  float other_effects = 0.0F;
  /// |x| and |z| of the patch in the laser unit's frame, metres.
  float lateral = 0.0F, height = 0.0F;

  /// What few pairs have.
  struct Special {
    /// A vertex of the patch.
    struct Vertex {
      double time = 0.0;    ///< of emission, seconds
      float weight = 0.0F;  ///< of the interpolation at the point's foot
      BoresightPartials turn =
          BoresightPartials::Zero();  ///< n' A of the boresight angles, or that of boresight_b
    };
    /// n' A_A and n' A_B of the three boresight angles, for trajectory errors of strips that are
    /// held fixed, whose rows are zero.
    BoresightPartials boresight_a = BoresightPartials::Zero(),
                      boresight_b = BoresightPartials::Zero();
    /// Whether the vertices were measured so far apart in time (rosette scanners) that each has a
    /// trajectory error of its own; that of the patch is their weighted mean.
    bool mixed_times = false;
    std::array<Vertex, 3> vertices;  ///< with mixed_times
  };
  std::shared_ptr<const Special> special;  ///< null: no turns, one time of the patch

  bool hasMixedTimes() const { return special != nullptr && special->mixed_times; }
  /// n' A, with A = A_A - A_B.
  SystemRow row() const { return row_a.cast<double>() - row_b.cast<double>(); }
  /// The effect of errors of the direction of the normal, of variance \a variance (rad^2, on each
  /// of two axes), on the distance: their standard deviation times A along the patch.
  static PairTilt effectOfTilt(const DesignBlock& design, const Eigen::Vector3d& normal,
                               double variance) {
    if (variance == 0.0) return PairTilt::Zero();
    Eigen::Matrix<double, 2, 3> along;
    along.row(0) = normal.unitOrthogonal();
    along.row(1) = normal.cross(along.row(0).transpose());
    return (std::sqrt(variance) * along * design).cast<float>();
  }
  /// The effect of values of the error sources on the distance, metres.
  double effectOfSources(const ErrorSourceVector& values) const {
    return sources.cast<double>() * values;
  }
  /// The surfaces of the point and of the patch, counted over all strips of the block.
  int surfaceA() const { return surfaceIndex(a, half_a); }
  int surfaceB() const { return surfaceIndex(b, half_b); }
  static int surfaceIndex(int strip, ScanHalf half) { return 2 * strip + static_cast<int>(half); }
  /// Pairs exist in both directions. Distances are reported as heights of the first strip above the
  /// second, or of the fore half-scan above the aft half-scan: 1, or -1 where the patch is in the
  /// first.
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
    return misclosure - row() * biases - other_effects;
  }
  /// Effect on the distance of the unknowns of a system that measured the point, or the patch.
  double effectAtPoint(const SystemUnknowns& u) const {
    return row_a.cast<double>() * u.head<kSystemParameterCount>() + normal.dot(u.tail<3>());
  }
  double effectAtPatch(const SystemUnknowns& u) const {
    return row_b.cast<double>() * u.head<kSystemParameterCount>() + normal.dot(u.tail<3>());
  }
};

static_assert(sizeof(PairObservation) <= 300,
              "memory of a calibration is mostly that of its pairs");

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

// Rules that measured pairs (AreaMatcher) and synthetic pairs of planned lines (SyntheticPairs)
// have in common.

/// Tilt over its standard deviation above which it is significant; below, distances are vertical.
constexpr double kSignificantTilt = 5.0;

/// Candidates of a strip in an area, for \a all candidates of a block, the number of combinations
/// of strip and area, and that of two strips and area in both directions. Where many strips overlap
/// each other they are fewer, so that a block has about six pairs for each of \a all, but a strip
/// has some 300 pairs in an area where it has 40 to 150 candidates.
template <typename Amount>
Amount candidatesPerStrip(Amount all, Amount strips_in_areas, Amount pairs_in_areas) {
  constexpr Amount kPairs = 6, kFewestPairs = 300, kFewestCandidates = 40,
                   kSufficientCandidates = 150;
  const Amount pairs = std::max<Amount>(1, pairs_in_areas);
  const Amount fewest = std::clamp<Amount>(kFewestPairs * strips_in_areas / pairs,
                                           kFewestCandidates, kSufficientCandidates);
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
