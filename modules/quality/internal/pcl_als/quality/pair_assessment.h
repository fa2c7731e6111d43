// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/// Criterion of surfaces that are compared.
struct SurfaceLimits : SurfaceCriterion {
  /// radians (10 degrees): limit of level ground for RMSDz
  double level_slope = 0.17453292519943295;
  double maximum_distance = 1.0;  ///< metres: larger differences are different objects
  /// places of a strip and area on level ground, and as many on slopes
  std::size_t candidates = 400;
};

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
      0.0;  ///< errors are correlated within areas (ClusteredRegression); NaN: unknown
  double std_of_mean_formal = 0.0;  ///< the same with clusters as independent; NaN: unknown
};

/// \param clusters of each value, as many as values
/// \param places plan positions of the values, metres; empty: clusters are independent
OffsetSummary summarize(std::vector<double> values, const std::vector<std::int64_t>& clusters,
                        const std::vector<Eigen::Vector2d>& places = {});

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

/** \brief The movement of strip a onto strip b from signed point-to-plane offsets on slopes (ASPRS
 * Guidelines on Geometric Inter-Swath Accuracy, 2018): n . s = d, with the surface normals n of
 * slopes over 10 degrees.
 */
struct HorizontalShift {
  bool determined = false;
  std::string reason;  ///< why it is not determined
  Eigen::Vector3d shift = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero();  ///< metres
  Eigen::Vector3d std_formal = Eigen::Vector3d::Zero();  ///< metres; with independent cells
  std::size_t count = 0;
  double rms = 0.0;  ///< of the residuals, metres
};

/// Normal distances on slopes of one class of slope and aspect.
struct SlopeAspectClass {
  double slope_from = 0.0, slope_to = 0.0;  ///< degrees
  int aspect = -1;  ///< downhill direction: 0 north, 1 north-east … 7 north-west; -1: all
  std::size_t count = 0;
  double mean = 0.0, rms = 0.0;  ///< a - b along the normal, metres
};
const char* aspectName(int aspect);

/// Agreement of two overlapping strips. Signs are those of a - b, movements take a onto b.
struct PairAssessment {
  enum class Status {
    judged,
    too_little,  ///< too few places of comparison
    copy,        ///< both strips contain the same points
    too_far,     ///< further apart than surfaces are compared
  };
  Status status = Status::too_little;
  std::string reason;  ///< why it is not judged
  double apart = 0.0;  ///< too_far: height of a above b, metres, to decimetres

  OffsetSummary vertical;            ///< smooth ground of single returns below 10 degrees
  OffsetSummary vertical_cells;      ///< of the means of cells of OffsetSample::kCluster metres
  OffsetSummary normal;              ///< all smooth surfaces, along the normal
  std::optional<int> quality_level;  ///< by vertical.rms; empty: none
  HorizontalShift horizontal;
  std::vector<SlopeAspectClass> classes;
  OverlapTrends trends;
};

const char* toString(PairAssessment::Status status);
const char* toString(FlightRelation relation);

PairAssessment assessPair(const std::vector<OffsetSample>& samples,
                          const std::optional<Eigen::Vector2d>& course_a,
                          const std::optional<Eigen::Vector2d>& course_b);

/// Mean height differences of cells of OffsetSample::kCluster metres, by OffsetSample::cluster().
using CellMeans = std::map<std::int64_t, double>;
CellMeans cellMeans(const std::vector<OffsetSample>& samples);

/// The offsets of a pair, for the closure of triangles.
struct PairOffset {
  std::string a, b;
  CellMeans cells;
};

/// Three strips that cover the same ground: closure of the offsets, a-b + b-c - (a-c), as the mean
/// over the cells that all three pairs have. On different ground the trajectory errors of the
/// strips differ, and closure is not expected.
struct TriangleClosure {
  std::string a, b, c;
  std::size_t cells = 0;
  double closure = 0.0, std = 0.0;  ///< metres; of the mean, from the scatter of the cells
};
std::vector<TriangleClosure> closeTriangles(const std::vector<PairOffset>& pairs);

/// Three strips that were aligned in pairs: the difference of the motions a -> b -> c and a -> c at
/// the middle of the three overlaps, metres. Standard deviations assume independent alignments.
struct MotionClosure {
  std::string a, b, c;
  Eigen::Vector3d closure = Eigen::Vector3d::Zero(), std = Eigen::Vector3d::Zero();
};

}  // namespace pcl_als
