// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/recovered_attitude.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

/// Position and rotation of the sensor at the time of a point.
struct SensorPose {
  Eigen::Vector3d position;  ///< firing point: the interpolated trajectory, metres, ground frame
  /// Body (right-forward-up) to ground. Without attitude: a rotation about the vertical by kappa,
  /// the direction of the local flight line.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  bool has_attitude = false;
  const ScanPlanes* planes = nullptr;  ///< those of the trajectory; null: one, across the body
};

/// Piece of the trajectory around a time. The position is linear in time. The rotation is about a
/// fixed axis and so small (kLargestTurn) that a quadratic function of time approximates it to
/// 2e-7.
struct FlightSpan {
  static constexpr double kLargestTurn = 0.01;  ///< radians

  double from = 0.0, to = 0.0;  ///< seconds, from < to
  Eigen::Vector3d position;     ///< at \a from, metres, ground frame
  Eigen::Vector3d velocity;     ///< metres per second
  /// Body to ground: rotation + elapsed * rate + elapsed^2 * curve.
  Eigen::Matrix3d rotation, rotation_rate, rotation_curve;
  bool has_attitude = false;
  const ScanPlanes* planes = nullptr;

  SensorPose at(double time) const;
};

/// The path between two samples without attitude: a straight line at constant speed.
struct PathSpan {
  double from = 0.0, to = 0.0;  ///< seconds; from == to: empty
  Eigen::Vector3d position;     ///< at \a from, metres, ground frame
  Eigen::Vector3d velocity;     ///< metres per second

  bool holds(double time) const { return from <= time && time < to; }
  Eigen::Vector3d at(double time) const { return position + (time - from) * velocity; }
};

/// Body (right-forward-up) to ground: Rz(-heading) Rx(pitch) Ry(roll), radians.
Eigen::Quaterniond groundFromBody(double roll, double pitch, double heading);

/** \brief A time-sorted flight trajectory with its gaps, and the local line fit of Habib et al.
 * 2011, section 2.1.
 *
 * At every sample a straight line is fitted (least squares in time) to the samples in [t - w, t +
 * w] on the same side of any gap; its direction in plan gives kappa. The quasi-rigorous model uses
 * no other attitude. The rigorous model uses roll, pitch and heading of the samples, and
 * withAttitude() uses pitch and crab recovered from the points. Between samples, the position is
 * interpolated linearly and the rotation at a constant rate; the time of an interpolation does not
 * depend on the number of samples. Memory: about 130 bytes per sample during construction, 68
 * afterwards.
 *
 * Where the sensor stands still, the direction is that of the last movement, or of the first one
 * before take-off. repairs() lists the repairs of defective samples.
 * \code
 * const pcl_als::Trajectory flight(pcl_als::readTrajectory("trajectory.csv"));
 * pcl_als::SensorPose pose;
 * std::size_t cursor = 0;
 * if (flight.poseAt(time, pose, cursor)) use(pose.position);  // metres, ground frame
 * \endcode
 */
class Trajectory {
 public:
  struct Options {
    /// w, seconds, > 0; enlarged where the interval contains fewer than two samples.
    double line_fit_half_width = 0.5;
    /// Seconds without a sample that count as a gap; 0: max(1 s, 5 median steps).
    double gap_threshold = 0.0;
    /// Use roll, pitch and heading of the samples (rigorous); InputError if a sample has none.
    bool use_attitude = false;
    /// Assume a level body with its heading along the local flight line (rigorous, for scanners
    /// that measure ahead and behind). In contrast to a trajectory without attitude, the coordinate
    /// y of a point is used. Not with use_attitude.
    bool nominal_attitude = false;
    /// Pitch and crab of the body against the local flight line; roll is zero. Not with
    /// use_attitude or nominal_attitude.
    std::function<PitchAndCrab(double time)> body_attitude;
    ScanPlanes scan_planes;  ///< of a scanner with several scan planes
    /// Exclude single samples and short runs of samples that contradict their neighbours
    /// (screenTrajectory()). False: the samples have been screened already.
    bool screen_samples = true;
  };
  enum class Coverage { covered, before_start, after_end, in_gap };
  struct Gap {
    double from, to;  ///< times of the samples on either side, seconds
  };

  explicit Trajectory(std::vector<TrajectorySample> samples)
      : Trajectory(std::move(samples), Options()) {}
  /// Excludes samples that contradict their neighbours, sorts by time, and replaces samples of
  /// equal time by their mean if they are at most 1 m apart. InputError for outliers that cannot be
  /// excluded, fewer than two distinct times, a time or position that is not finite, samples of one
  /// time that are further apart, or a trajectory that does not move in plan; UsageError for
  /// impossible options.
  Trajectory(std::vector<TrajectorySample> samples, const Options& options);

  std::size_t size() const { return nodes_.size(); }
  double startTime() const { return nodes_.front().time; }
  double endTime() const { return nodes_.back().time; }
  double lineFitHalfWidth() const { return half_width_; }  ///< seconds
  const std::vector<Gap>& gaps() const { return gaps_; }
  /// Whether all samples have attitude, used or not.
  bool samplesHaveAttitude() const { return samples_have_attitude_; }
  /// Whether poses have an attitude and not only the direction of flight.
  bool hasAttitude() const { return has_attitude_; }
  /// Whether the attitude is nominal: level, with the heading along the flight line.
  bool attitudeIsNominal() const { return nominal_; }

  /// The same flight with other options and without the attitude of its samples. The samples are
  /// not screened again, and the gaps remain.
  Trajectory rebuilt(Options options) const;
  /// The same flight without attitude.
  Trajectory withoutAttitude() const;
  /// The same flight with nominal attitude.
  Trajectory withNominalAttitude() const;

  /// The same flight for a scanner with several scan planes. Poses of the result refer to the
  /// result, which must exist as long as they do.
  Trajectory withScanPlanes(ScanPlanes planes) const;
  const ScanPlanes& scanPlanes() const { return planes_; }

  /// The same flight with a body rotated against the local flight line; roll is zero. For a
  /// trajectory without attitude.
  Trajectory withAttitude(const std::function<PitchAndCrab(double time)>& attitude) const;

  /// One line for each kind of repair (outliers, samples out of order, equal times, single samples
  /// between gaps, sensor at rest); empty if nothing was repaired.
  const std::vector<std::string>& repairs() const { return repairs_; }

  /// Whether the trajectory covers a time. NaN counts as before the start.
  Coverage coverage(double time) const;

  /// The pose at a time; false (and \a pose unchanged) if the trajectory does not cover it. \a
  /// cursor accelerates the search for successive times that are nearly in order: begin with 0 and
  /// pass the same variable each time.
  bool poseAt(double time, SensorPose& pose, std::size_t& cursor) const;

  /// As poseAt(), but gives the whole piece of the trajectory around the time, for many points.
  bool spanAt(double time, FlightSpan& span, std::size_t& cursor) const;
  /// As spanAt(), without attitude.
  bool pathAt(double time, PathSpan& span, std::size_t& cursor) const;

 private:
  using Rotation = Eigen::Quaternion<double, Eigen::DontAlign>;  ///< body to ground
  struct Node {
    double time;
    Eigen::Vector3d position;
    Rotation rotation;
  };

  void excludeOutliers(std::vector<TrajectorySample>& samples);
  void findGaps(const std::vector<TrajectorySample>& samples);
  void fitDirections(const std::vector<TrajectorySample>& samples);
  void takeAttitude(const std::vector<TrajectorySample>& samples);
  void turnBody(const std::function<PitchAndCrab(double time)>& attitude);
  void buildIndex();
  std::size_t bucketOf(double time) const {
    return static_cast<std::size_t>((time - nodes_.front().time) * buckets_per_second_);
  }
  std::size_t locate(double time, std::size_t hint) const;
  /// The node that begins the span of a covered time.
  bool spanNode(double time, std::size_t& cursor, std::size_t& node) const;
  const ScanPlanes* planes() const { return planes_.empty() ? nullptr : &planes_; }
  bool isGap(std::size_t node) const {
    return nodes_[node + 1].time - nodes_[node].time > gap_threshold_;
  }

  std::vector<Node> nodes_;
  std::vector<Gap> gaps_;
  std::vector<std::string> repairs_;
  std::vector<std::uint32_t> buckets_;  ///< of equal duration: the first node at or after its start
  double buckets_per_second_ = 0.0;
  double gap_threshold_ = 0.0, half_width_ = 0.0;
  ScanPlanes planes_;
  bool samples_have_attitude_ = false, has_attitude_ = false, nominal_ = false;
};

}  // namespace pcl_als
