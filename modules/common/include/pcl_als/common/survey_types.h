// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// One record of a trajectory file. Angles are in radians and NaN when unknown; groundFromBody()
/// defines the rotation.
struct TrajectorySample {
  double time = 0.0;                                          ///< seconds, as in the file
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< metres, ground frame
  double roll = std::numeric_limits<double>::quiet_NaN();     ///< right wing down positive
  double pitch = std::numeric_limits<double>::quiet_NaN();    ///< nose up positive
  double heading = std::numeric_limits<double>::quiet_NaN();  ///< clockwise from grid north

  bool hasAttitude() const {
    return std::isfinite(roll) && std::isfinite(pitch) && std::isfinite(heading);
  }
};

/// Form of the attitude in a file, which decides whether its axes are known.
enum class AttitudeForm {
  heading,  ///< axes known: roll right wing down, pitch nose up, heading clockwise from north
  yaw,      ///< axes open: some programs count the yaw counter-clockwise from east
  /// Axes open: the rotation from body to local frame may be from forward, right, down to north,
  /// east, down, or from forward, left, up to east, north, up.
  quaternion,
};

/// A surveyed point that strips are compared with.
struct ControlPoint {
  enum class Kind {
    height,  ///< on the ground, used vertically: against the TIN patch above or below it
    patch,   ///< centre of a planar patch (a roof), used along the normal of the patch
    target,  ///< centre of a level circular target, used in three dimensions: it is found in the
             ///< points by its contrast of intensity
  };

  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, ground frame
  /// Standard deviation of the height (of a patch: along its normal), metres; 0: not stated.
  double sigma = 0.0;
  Kind kind = Kind::height;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of a patch; unit, upward
  double extent = 0.0;                                ///< diameter of a patch, metres
  double diameter = 0.0;                              ///< of a target, metres
  /// Standard deviation of each horizontal coordinate of a target, metres; 0: that of the height.
  double sigma_plan = 0.0;

  double sigmaInPlan() const { return sigma_plan > 0.0 ? sigma_plan : sigma; }
};

/// A square of ground whose points are kept together with those of a margin around it, so that the
/// TINs inside the square are those of whole strips.
struct SurveyArea {
  Eigen::Vector2d minimum;  ///< metres, ground frame
  double size = 0.0;        ///< metres, side
  double margin = 0.0;      ///< metres

  /// Whether a point lies in the square.
  bool contains(const Eigen::Vector3d& p) const { return within(p, 0.0); }
  /// Whether a point lies in the square or its margin.
  bool covers(const Eigen::Vector3d& p) const { return within(p, margin); }

 private:
  bool within(const Eigen::Vector3d& p, double beyond) const {
    return p.x() >= minimum.x() - beyond && p.y() >= minimum.y() - beyond &&
           p.x() < minimum.x() + size + beyond && p.y() < minimum.y() + size + beyond;
  }
};

/// A target whose reflectance at the laser's wavelength is known.
struct ReferenceTarget {
  std::string id;
  double x = 0.0, y = 0.0;   ///< metres, ground frame
  double reflectance = 0.0;  ///< (0, 2]
  double sigma = 0.0;        ///< standard deviation of the reflectance; 0: not stated
};

/// Gain of the receiver as a function of the value of the automatic gain control (AGC).
struct GainStep {
  double value = 0.0, gain = 1.0;
};

/// A training or check site: a point or an area of known class. Metres, ground frame.
struct ClassSite {
  std::string name;                                 ///< name of the class
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< position of a point
  /// Closed rings of an area, outer boundaries and holes alike; a position is inside if an odd
  /// number of them surrounds it. Empty for a point.
  std::vector<std::vector<Eigen::Vector2d>> rings;

  bool isArea() const { return !rings.empty(); }
};

/// A check point with its reference class and its class in a classification.
struct CheckedSite {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< metres, ground frame
  std::string reference;
  std::string classified;  ///< empty: not classified
};

/// Settings of the choice of areas of a block (SurveyMap::selectAreas()).
struct AreaSelection {
  double area_size = 50.0;  ///< metres, side of an area
  double margin = 8.0;      ///< metres
  /// Largest number of points of all strips in the chosen areas and their margins.
  std::size_t point_budget = 4'000'000;
};

/// Choice of the strips to be used.
struct StripChoice {
  std::vector<std::string> only;     ///< names of the strips that are used; empty: all
  std::vector<std::string> without;  ///< names of the strips that are excluded
  bool split = false;                ///< divide the points into flight lines by splitTrack()
  /// Without split: divide strips that certainly consist of several flight lines (leadBack()),
  /// because a strip is compared with other strips and not with itself.
  bool divide_lines = false;
  /// Without split: keep points of GPS time 0 in files that have times.
  bool keep_timeless = false;
  /// Treat each scanner channel of a strip as a strip of its own: 3.ch0, 3.ch1 (SurveyReader).
  bool by_channel = false;
};

}  // namespace pcl_als
