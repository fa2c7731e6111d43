// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>

#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als {

/** \brief Pitch and crab of the laser unit from the points it measured and the flight's positions.
 *
 * A linear scanner's pulses lie in one plane of its body, x-z. In the frame of the local flight
 * line (x right, y forward, z up; of a pulse d from the firing point to the ground point) a body
 * turned by crab c and pitch p has that plane where y = tan(c) x - tan(p) / cos(c) z. Both are
 * found by least squares for every tenth of a second (smoothed over its neighbours), so they are
 * smooth functions of time; roll turns the plane into itself and cannot be seen.
 *
 * The plane found is that of the laser unit as it was mounted: a scanner that looks ahead or is
 * turned in its mount has its offset in pitch or crab, which is where it matters. With the points'
 * noise the angles are good to some arc-seconds; the effect of biases on a point needs them to a
 * hundred times less.
 *
 * Add some points of all flight lines (one in ten will do), in any order; parts made in different
 * threads can be merged. Memory: 80 bytes for every tenth of a second with points.
 */
class AttitudeRecovery {
 public:
  /// \a flight: without attitude
  explicit AttitudeRecovery(std::shared_ptr<const Trajectory> flight);

  void add(const PointColumns& points, std::size_t count);
  void add(double time, const Eigen::Vector3d& point);
  void merge(const AttitudeRecovery& other);

  struct Outcome {
    /// The flight with the attitude found; without it, where the points lie in no plane.
    std::shared_ptr<const Trajectory> flight;
    bool found = false;
    /// Radians, RMS angle of a bin's pulses with their plane, median over time: mostly motion
    /// within the tenth of a second.
    double off_plane = 0.0;
    double size = 0.0;   ///< radians, RMS over time of pitch and crab together
    std::string remark;  ///< what was found, or why nothing was
  };
  Outcome recover() const;

 private:
  /// Sums over points in the frame of the flight line, metres; time since the bin's start.
  struct Sums {
    double n = 0.0, t = 0.0, xx = 0.0, xz = 0.0, zz = 0.0, xy = 0.0, zy = 0.0, yy = 0.0;
    void add(const Sums& other, double weight);
  };
  struct Plane;
  static Plane planeOf(const Sums& sums);

  std::shared_ptr<const Trajectory> flight_;
  std::size_t cursor_ = 0;
  std::unordered_map<std::int64_t, Sums> bins_;
};

}  // namespace pcl_als
