// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/byte_stream.h>
#include <pcl_als/common/recovered_attitude.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

namespace detail {

/// Sums over the unit vectors of pulses (right, forward, up of the local flight line).
struct PulseSums {
  double n = 0.0, time = 0.0;  ///< time: since the bin's start, seconds
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  /// Extent across: x / -z of the outermost pulses.
  double leftmost = std::numeric_limits<double>::infinity();
  double rightmost = -std::numeric_limits<double>::infinity();
  /// Sums for pulses with a recorded scan angle: their number, sums of the angle to the right as
  /// seen from the flight line and of the recorded one (radians), and of their products.
  double angles = 0.0, seen = 0.0, recorded = 0.0;
  double seen_sq = 0.0, seen_recorded = 0.0, recorded_sq = 0.0;

  void add(const PulseSums& other);
  void addAngle(double seen_angle, double recorded_angle);
};

}  // namespace detail

/** \brief Pitch and crab of the laser unit from measured points and the positions of the flight.
 *
 * The pulses of a linear scanner lie in one plane of its body, x-z. In the frame of the local
 * flight line (x right, y forward, z up; for a pulse d from the firing point to the ground point) a
 * body with crab c and pitch p has this plane at y = tan(c) x - tan(p) / cos(c) z. Both are
 * estimated for every tenth of a second as a random walk of 2.5 mrad per step, so that times with
 * few pulses are bridged from their neighbours; roll maps the plane onto itself and is not
 * observable.
 *
 * A short arc of a conical scanner is plane as well, and so is each plane of a scanner with
 * several. Whether the scanner is linear is therefore decided over whole passes (uninterrupted
 * pieces of flight, usually strips): by the deviation from one plane against that from one cone, by
 * the range of the angles and by their rates, none of which depends on the length of a bin. The
 * limits are those of survey flights, helicopters and drones that fly forward.
 *
 * The estimated plane is that of the laser unit as mounted: a scanner that is tilted or rotated in
 * its mount has its offset in pitch or crab, as the effect of biases requires. This effect depends
 * on the angles to some arc-minutes only.
 *
 * Some points of all flight lines are sufficient (one in ten), in any order; parts from different
 * threads can be merged. Memory: 190 bytes for every tenth of a second with points.
 */
class AttitudeRecovery {
 public:
  /// \a flight: without attitude
  explicit AttitudeRecovery(std::shared_ptr<const Trajectory> flight);

  void add(const PointColumns& points, std::size_t count);
  /// \a scan_angle as recorded, radians; NaN: none
  void add(double time, const Eigen::Vector3d& point,
           double scan_angle = std::numeric_limits<double>::quiet_NaN());
  void merge(const AttitudeRecovery& other);
  /// All points so far, for another process.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);

  /// From the 2nd to the 98th percentile over time, radians.
  struct Range {
    double low = 0.0, high = 0.0;
  };
  enum class Verdict {
    linear,
    undetermined,  ///< too few pulses, or too narrow a part of the swath
    conical,       ///< the pulses lie on a cone
    not_planar,    ///< in no plane, even for a tenth of a second: several planes, or another flight
    implausible,   ///< in planes for a tenth of a second, but with angles that do not occur in
                   ///< flight
  };
  /// An uninterrupted piece of flight.
  struct Pass {
    double from = 0.0, to = 0.0;  ///< seconds
    double points = 0.0;
    Verdict verdict = Verdict::undetermined;
    Range pitch, crab;
    double off_plane = 0.0;     ///< radians, RMS from the plane of each bin, median
    double share_off = 0.0;     ///< of the bins, whose pulses are far off their plane
    double off_constant = 0.0;  ///< radians, RMS from one plane over the whole pass
    double off_cone = 0.0;      ///< radians, RMS from one cone over the whole pass
    double cone_angle = 0.0;    ///< radians, half the angle of that cone
  };
  /// Attitude from the pulses of a well-covered tenth of a second.
  struct Instant {
    double time = 0.0;
    double pitch = 0.0, crab = 0.0;  ///< radians, smoothed
    std::size_t pass = 0;
  };
  /// Position of the pulses of a tenth of a second across the flight line, which roll changes.
  struct Swath {
    double time = 0.0;
    double left = 0.0, right = 0.0;  ///< radians from the vertical to the right, outermost pulses
    /// Radians: the recorded scan angle (scaled, as its sign is a convention) minus the angle from
    /// the vertical, mean of the pulses; the roll, where recorded angles are those of the mirror.
    /// NaN: no recorded angle follows the pulses.
    double recorded = 0.0;
    std::size_t pass = 0;
  };

  struct Outcome {
    /// The flight with the recovered attitude; without attitude where none was recovered.
    std::shared_ptr<const Trajectory> flight;
    /// that of the flight; from recover() only, where it was recovered
    RecoveredAttitude attitude;
    bool found = false;
    bool linear = true;  ///< false: the scanner is not a linear one (or the flight is another)
    /// Radians, RMS angle of a bin's pulses with their plane, median over time: mostly motion
    /// within the tenth of a second.
    double off_plane = 0.0;
    double size = 0.0;   ///< radians, RMS over time of pitch and crab together
    std::string remark;  ///< the result, or the reason for which there is none
    std::vector<Pass> passes;
    std::vector<Instant> instants;  ///< of the passes that are linear
    std::vector<Swath> swath;       ///< of all passes
  };
  Outcome recover() const;
  /// The same without the flight (a copy of the trajectory): the scanner, ranges and instants.
  Outcome assess() const;

  /// "pitch -1.20 ... 2.35, crab 0.10 ... 3.02 degrees"
  static std::string describe(const Range& pitch, const Range& crab);

 private:
  std::shared_ptr<const Trajectory> flight_;
  std::size_t cursor_ = 0;
  std::unordered_map<std::int64_t, detail::PulseSums> bins_;
};

}  // namespace pcl_als
