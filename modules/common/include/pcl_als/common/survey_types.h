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

/// One record of a trajectory, as read. Angles in radians (module trajectory states the rotation),
/// NaN when unknown.
struct TrajectorySample {
  double time = 0.0;                                          ///< seconds
  Eigen::Vector3d position = Eigen::Vector3d::Zero();         ///< metres, ground frame
  double roll = std::numeric_limits<double>::quiet_NaN();     ///< right wing down positive
  double pitch = std::numeric_limits<double>::quiet_NaN();    ///< nose up positive
  double heading = std::numeric_limits<double>::quiet_NaN();  ///< clockwise from grid north

  bool hasAttitude() const {
    return std::isfinite(roll) && std::isfinite(pitch) && std::isfinite(heading);
  }
};

/// How a file gives attitudes, as far as this leaves their axes open.
enum class AttitudeForm {
  heading,  ///< nothing is open: roll right wing down, pitch nose up, heading clockwise from north
  yaw,      ///< the heading is a yaw, which some write counter-clockwise from east
  /// The rotation from the body to the local frame: of axes forward, right, down to north, east,
  /// down, or of axes forward, left, up to east, north, up.
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

/// A square of ground whose points are kept; points up to \a margin outside belong to it too,
/// so that its TINs are those of the whole.
struct SurveyArea {
  Eigen::Vector2d minimum;  ///< metres, ground frame
  double size = 0.0;        ///< metres, side
  double margin = 0.0;      ///< metres

  bool contains(const Eigen::Vector3d& p) const { return within(p, 0.0); }
  bool covers(const Eigen::Vector3d& p) const { return within(p, margin); }

 private:
  bool within(const Eigen::Vector3d& p, double beyond) const {
    return p.x() >= minimum.x() - beyond && p.y() >= minimum.y() - beyond &&
           p.x() < minimum.x() + size + beyond && p.y() < minimum.y() + size + beyond;
  }
};

/// A place of known reflectance at the laser's wavelength.
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

/// A place or an area whose class is known: training or check. Metres, ground frame.
struct ClassSite {
  std::string name;                                 ///< of the class
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< of a point
  /// Of an area: closed rings, outer ones and holes alike; inside is what an odd number of them
  /// surround.
  std::vector<std::vector<Eigen::Vector2d>> rings;

  bool isArea() const { return !rings.empty(); }
};

/// A check point with what it is and what it was classified as.
struct CheckedSite {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  std::string reference;
  std::string classified;  ///< empty: the classification gave none
};

/// Which areas of a block SurveyMap::selectAreas() chooses.
struct AreaSelection {
  double area_size = 50.0;  ///< metres
  double margin = 8.0;      ///< metres
  /// points in the chosen areas and their margins, all strips
  std::size_t point_budget = 4'000'000;
};

/// Choice of the strips to be used.
struct StripChoice {
  std::vector<std::string> only;     ///< names of the strips that are used; empty: all
  std::vector<std::string> without;  ///< names of strips to exclude
  bool split = false;                ///< cut into flight lines by splitTrack()
  /// Without split: cut strips that are certainly several flight lines (leadBack()), as they are
  /// compared with others and not with themselves.
  bool divide_lines = false;
  /// Without split: keep points of GPS time 0 in files that have times.
  bool keep_timeless = false;
  /// The channels of the scanner in a strip are strips of their own: 3.ch0, 3.ch1 (SurveyReader).
  bool by_channel = false;
};

}  // namespace pcl_als
