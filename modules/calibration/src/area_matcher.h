// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/error_source.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/survey/target_location.h>
#include <pcl_als/tin/patch_surface.h>
#include <pcl_als/tin/surface_criterion.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/trajectory.h>

#include "ground_planes.h"
#include "noise_model.h"
#include "pair_observation.h"
#include "pair_selection.h"

namespace pcl_als {

struct FieldDivision;

/// What the points of one strip may differ in although one instrument measured them.
enum class PointField { scanner_channel, user_data, scan_direction };

/// Whether a target was located in a strip.
struct TargetInStrip {
  int strip = 0;
  TargetStatus status = TargetStatus::located;
};

/** \brief The points of one area by strip, their TINs, and the pairs found between them.
 *
 * Fill with add() (different strips may be added from different threads), then prepare() once, then
 * for every iteration correct() and match(). Memory: about 150 bytes per point.
 */
class AreaMatcher {
 public:
  AreaMatcher(const SurveyArea& area, std::size_t strips)
      : area_(area), corrected_for_(strips, SystemUnknowns::Zero()) {
    clear();
  }

  /// \a range_std: standard deviation of its range that a decomposed echo states, in addition to
  /// the noise model, metres; 0: none.
  void add(int strip, const LidarReturn& point, float range_std = 0.0F);
  /// The points of a strip stay where they are. \a std: of their coordinates, metres; \a flown:
  /// their times are those of the trajectory.
  void hold(int strip, double std, bool flown) {
    surfaces_[static_cast<std::size_t>(strip)].held_std = std;
    surfaces_[static_cast<std::size_t>(strip)].flown = flown;
  }
  const SurveyArea& area() const { return area_; }
  std::size_t pointCount() const;
  /// The points of a strip as added, for another process; get() replaces those that are there.
  void put(int strip, ByteWriter& out) const;
  void get(int strip, ByteReader& in);
  bool hasPoints(int strip) const {
    return !surfaces_[static_cast<std::size_t>(strip)].biased.empty();
  }
  void clear();                    ///< deletes all points
  std::size_t stripCount() const;  ///< strips with points in the area or its margin

  /// Times at which a strip measured the area with its margin, a span for each crossing.
  std::vector<TimeSpan> timesOf(int strip) const;

  /// Of the coordinates of each strip, see coordinateSteps(); zero for strips that are held fixed.
  std::vector<Eigen::Vector3d> steps() const;
  /** \brief Distributes the coordinates of a strip evenly over the steps to which they were
   * rounded, before prepare(): a random number of up to half a step is added to each.
   *
   * The rounding errors of neighbouring points depend on each other, and two strips that were
   * rounded to the same values differ by nothing or by a whole step, which robust weights take for
   * outliers. The sum of rounding error and random number is a random error of variance step^2/6.
   */
  void distribute(int strip, const Eigen::Vector3d& steps);

  /** \brief Keeps one point of each strip in every cell of 0.7 of its mean spacing, before
   * prepare().
   *
   * A rosette has many points close to each other along its lines. Range noise moves points along
   * the pulse, and TINs of such points are biased: the scan angle scale of six blocks was 1.4e-5
   * too large with a standard deviation of 1.0e-5, and is 0.7e-5 too large with the same one.
   */
  void evenOut();

  /** \brief Builds the TINs and chooses at most \a candidates points a strip, even over slopes and
   * aspects.
   *
   * Where a strip measures the same ground twice within seconds (conical scanners; several planes
   * whose channels are not recorded), the points ahead of the sensor and those behind it form
   * surfaces of their own, which also form pairs with each other. Triangles with vertices of both
   * halves would have trajectory errors of two times, which differ by centimetres and are the same
   * for all pairs of the area, and biases of two directions of the pulse.
   */
  void prepare(const SurfaceCriterion& criterion, std::size_t candidates, double resolution,
               const Trajectory& trajectory);
  /// Roughness of the patches under the candidates of all strips on gentle slopes, metres (for
  /// setting the limit).
  void collectRoughness(std::vector<double>& values) const;
  void limitRoughness(double most, double plain) {
    criterion_.roughness = most;
    criterion_.plain_roughness = plain;
  }

  /// Sums for the scale of the error sources: the largest scan angle and all intensities.
  void collectSourceScale(const Trajectory& trajectory, double& largest_angle,
                          std::vector<double>& intensities) const;
  /// From now on pairs have the effects of all error sources.
  void considerSources(const ErrorSourceScale& scale) { source_scale_ = scale; }

  /// The numbers of points of strips that are not held fixed, by strip and value of a field, in a
  /// square in the middle of the area with this share of it and the same margin. Scan directions (1
  /// to the left, -1 to the right) that are not recorded are found from the angles of successive
  /// pulses; recorded ones are not counted: they have an error source of their own.
  std::map<int, std::map<int, std::size_t>> valuesOf(PointField field, double share,
                                                     const Trajectory& trajectory) const;
  /// The points of strips that are not held fixed, divided by the value of a field, with surfaces
  /// by the criterion of this matcher, see prepare(). \a share: as of valuesOf().
  AreaMatcher divided(const FieldDivision& division, double share, std::size_t candidates,
                      double resolution, const Trajectory& trajectory) const;

  /// Which points are paired with patches: all candidates, or those of the observations last kept.
  enum class Points { candidates, kept };
  /// Keeps the points of these observations (of match()) for further pairs with the same strips;
  /// these pairs have the weight of those that they represent.
  void keep(const AreaObservations& observations, const std::vector<ChosenPair>& chosen);

  /// The TIN of a strip (or of its fore half-scan), as corrected last; empty where the strip has
  /// too few points in the area.
  const PatchSurface& surfaceOf(int strip) const {
    return surfaces_[static_cast<std::size_t>(strip)].surface;
  }

  /// The correction of the points of a strip; not used of strips that are held fixed.
  struct StripCorrection {
    const BiasEvaluator* biases;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< of the coordinates, metres
  };
  /// Reconstructs the points with Eq. (13), by strip, and removes the effects of error sources,
  /// which are considered, from them; the TINs keep their topology. The value of slope_ranging,
  /// which depends on surfaces, is ignored.
  void correct(const std::vector<StripCorrection>& corrections, const ErrorSourceVector& sources,
               const Trajectory& trajectory);
  /// All strips alike, without sources.
  void correct(const BiasEvaluator& biases, const Trajectory& trajectory) {
    correct(std::vector<StripCorrection>(corrected_for_.size(), {&biases}),
            ErrorSourceVector::Zero(), trajectory);
  }

  /// The pairs between these strips (both directions) whose corrected normal distance is at most \a
  /// threshold; only one of \a every candidates is paired.
  AreaObservations match(const std::vector<StripPair>& pairs, double threshold,
                         const Trajectory& trajectory, const NoiseModel& noise,
                         Points chosen = Points::candidates, std::size_t every = 1) const {
    return matchByDistance(pairs, {threshold, threshold}, trajectory, noise, chosen, every).near;
  }
  struct DistanceLimits {
    double near, far;  ///< metres
  };
  struct PairsByDistance {
    AreaObservations near;
    AreaObservations far;  ///< the others up to the second limit; they share no noise with any
  };
  /// The same, and the pairs whose distance exceeds the threshold.
  PairsByDistance matchByDistance(const std::vector<StripPair>& pairs, const DistanceLimits& limits,
                                  const Trajectory& trajectory, const NoiseModel& noise,
                                  Points chosen = Points::candidates, std::size_t every = 1) const;
  /// The pairs of control points inside the area with the patches above or below them, and the
  /// places of targets, which are searched for within \a threshold in each coordinate.
  AreaObservations matchControl(const std::vector<ControlPoint>& control, double threshold,
                                const Trajectory& trajectory, const NoiseModel& noise,
                                double default_sigma) const;
  /// The strips that cover a target, and whether it was located there.
  std::vector<TargetInStrip> targetsIn(const ControlPoint& point, double window,
                                       const Trajectory& trajectory, const NoiseModel& noise) const;

 private:
  /// Fewer points of a strip or a half-scan in the area and its margin form no surface.
  static constexpr std::size_t kTooFew = 30;
  static constexpr std::size_t kEnoughForEdge = 5000;  ///< triangles, for the typical edge

  /// The points of a strip, or those of one half-scan, and their TIN.
  struct StripPart {
    int strip = 0;
    ScanHalf half = ScanHalf::whole;
    std::vector<Eigen::Vector3d> biased;  ///< ground frame, as read
    std::vector<double> times;
    std::vector<bool> single;
    std::vector<float> intensity;
    std::vector<std::int8_t> scan_direction;  ///< of the mirror: 1 to the left, -1 to the right
    std::vector<std::uint8_t> channel, user_data;
    std::vector<float> range_std;  ///< metres, of the echo
    PatchSurface surface;
    GroundPlanes ground;  ///< of the points as corrected last
    std::vector<std::int32_t> candidates;
    std::vector<double> roughness;  ///< metres, of the neighbourhoods examined on gentle slopes
    double median_edge = 0.0;       ///< metres, in plan
    double held_std = 0.0;          ///< metres, of the points of a strip that is held fixed
    bool flown = true;              ///< false: the points of a surface, without times
    /// Variance of coordinates that were rounded to large steps, m^2.
    Eigen::Vector3d rounding = Eigen::Vector3d::Zero();

    bool held() const { return held_std > 0.0; }
    /// Variance of the range of a point's echo, m^2.
    double echoVariance(std::size_t i) const {
      const auto std = static_cast<double>(range_std[i]);
      return std * std;
    }
    /// By point; 0 for scan directions that are recorded or unknown.
    std::vector<int> values(PointField field, const Trajectory& trajectory) const;
    void add(const StripPart& other, std::size_t point);  ///< a point of another part
    /// The points that an area with its margin covers.
    StripPart within(const SurveyArea& area) const;
  };
  class PointGeometry;

  /// Whether the vertices of a triangle were measured so far apart in time that their trajectory
  /// errors differ.
  static bool isMixed(const std::vector<double>& times,
                      const std::array<std::int32_t, 3>& triangle);
  /// The share of such triangles.
  static double mixedShare(const StripPart& part);
  /// The points of a strip, corrected.
  static std::vector<Eigen::Vector3d> reconstructed(const StripPart& part,
                                                    const StripCorrection& correction);
  void removeSourceEffects(const StripPart& part, const Trajectory& trajectory,
                           std::vector<Eigen::Vector3d>& points) const;
  void buildSurface(StripPart& part, double resolution) const;
  void buildSurfaces(std::size_t candidates, double resolution, const Trajectory& trajectory);
  /// Divides the points of a strip by half-scan where that separates times which its TIN mixes.
  bool divideByScanHalf(std::size_t strip, double resolution, const Trajectory& trajectory);
  /// The surfaces of the point and of the patch, one entry for each direction: of all halves of
  /// these strips, and of the two half-scans of each strip.
  std::vector<std::pair<std::size_t, std::size_t>> surfacePairs(
      const std::vector<StripPair>& pairs) const;
  /// The criterion of a strip's patches: that of the block, or of the points of a surface that are
  /// noisier.
  SurfaceCriterion criterionOf(const StripPart& part) const;

  /// The direction in which the distance of a pair is measured: the normal of the plane of the cell
  /// where the triangle lies on it (GroundPlanes), otherwise of the neighbourhood's plane, which is
  /// less noisy than that of the triangle; the vertical where the tilt of the plane is not
  /// significant. Noise of the normal would otherwise act as information about plan positions.
  struct Direction {
    Eigen::Vector3d normal;
    double variance = 0.0;  ///< rad^2
  };
  Direction measuringDirection(const StripPart& part, std::int32_t triangle,
                               const PatchQuality& quality) const;
  /// The pairs of the points of one surface with the patches of another.
  struct Matching;
  void matchSurfaces(Matching& matching, std::size_t a, std::size_t b,
                     PairsByDistance& found) const;
  /// Fills the equation of the pair of a point and its foot in a patch.
  void measure(const PointGeometry& point, const PointGeometry& foot, const Direction& direction,
               PairObservation& observation) const;
  /// Keeps the vertices of the foot where their times are mixed.
  /// \param point null: control
  static void keepSpecial(const PointGeometry* point, const PointGeometry& foot,
                          PairObservation& observation);
  // The pairs of a control point with one strip.
  void matchHeight(const ControlPoint& point, const StripPart& part, double threshold,
                   PointGeometry& foot, PointGeometry& vertex, AreaObservations& found) const;
  /// All single returns on the patch.
  void matchPatch(const ControlPoint& point, const StripPart& part, double threshold,
                  PointGeometry& measured, AreaObservations& found) const;
  /// Searches a target in a strip; its certain returns are those of the strip.
  TargetLocation targetIn(const ControlPoint& point, const StripPart& part, double window,
                          const NoiseModel& noise, PointGeometry& measured) const;
  /// The height and the plan position of a target that is located in a strip.
  void matchTarget(const ControlPoint& point, const StripPart& part, double window,
                   const NoiseModel& noise, PointGeometry& foot, PointGeometry& vertex,
                   AreaObservations& found) const;
  /// \param vertex a return of the target; \param foot its centre, which gets the height
  void addHeight(const ControlPoint& point, const StripPart& part, const TargetLocation& target,
                 const PointGeometry& vertex, PointGeometry& foot, AreaObservations& found) const;
  /// Along the principal axes of the covariance of the place, whose errors are independent.
  void addPlan(const ControlPoint& point, const StripPart& part, const TargetLocation& target,
               const PointGeometry& foot, AreaObservations& found) const;
  PairObservation controlObservation(const ControlPoint& point, const StripPart& part,
                                     const Direction& direction, const PointGeometry& foot) const;
  void chooseCandidates(StripPart& part, std::size_t count) const;

  SurveyArea area_;
  /// By strip; aft half-scans at the end.
  std::vector<StripPart> surfaces_;
  struct KeptPoint {
    std::int32_t point = 0;
    float variance_inflation = 1.0F, offset = 0.0F;  ///< of its pair, see ChosenPair
  };
  /// Points of the first surface that form pairs with the second, PairObservation::surfaceIndex().
  std::map<std::pair<int, int>, std::vector<KeptPoint>> kept_;
  SurfaceCriterion criterion_;
  std::vector<SystemUnknowns> corrected_for_;  ///< by strip, taken out of the surfaces
  ErrorSourceVector corrected_sources_ = ErrorSourceVector::Zero();  ///< the same, of all strips
  std::optional<ErrorSourceScale> source_scale_;  ///< empty: sources are not considered
};

}  // namespace pcl_als
