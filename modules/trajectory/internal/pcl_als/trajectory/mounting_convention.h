// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// One of the three angles of a mounting, as it is typed into a program.
struct MountingAngle {
  std::string name;  ///< in the program: "roll", "Z"
  char axis = 'x';   ///< x, y or z
  int sign = 1;      ///< -1: the program counts it against the rotation of MountingConvention
};

/** \brief How a program states the rotation and the lever arm between scanner and body.
 *
 * Three elementary rotations, in the order of the matrix product,
 *
 *     A = R_i(s_i a_i) R_j(s_j a_j) R_k(s_k a_k),
 *
 * with R_x(t) = [1 0 0; 0 cos t -sin t; 0 sin t cos t], R_y(t) = [cos t 0 sin t; 0 1 0; -sin t 0
 * cos t], R_z(t) = [cos t -sin t 0; sin t cos t 0; 0 0 1] and signs s. The product describes
 * rotations about axes that move with the scanner, in the order i, j, k, as well as rotations about
 * fixed axes in the order k, j, i. Where scanner_to_body is true, A turns coordinates of the
 * scanner into those of the body, v_body = A v_scanner; else it is the inverse, v_scanner = A
 * v_body.
 *
 * The body is that of the trajectory: the frame whose roll, pitch and heading it has. \a axes are
 * the directions of x, y and z of the program's body frame, one letter each: r(ight) or l(eft),
 * f(orward) or b(ack), u(p) or d(own). They may be left-handed ("frd" is right-handed, "fru"
 * left-handed): the formulae of the matrices stay, so that positive angles turn in the sense of
 * the left hand. The axes of the scanner are those in which it gives its points and do not matter.
 */
struct MountingConvention {
  std::string name;    ///< "novatel"; empty: composed by the user
  std::string use;     ///< one line: what the convention is
  std::string source;  ///< a public document that defines it
  std::array<MountingAngle, 3> angles{{{"X", 'x'}, {"Y", 'y'}, {"Z", 'z'}}};  ///< as typed
  std::array<int, 3> product{0, 1, 2};  ///< indices of angles in the order of the matrix product
  bool scanner_to_body = true;
  std::string axes = "frd";
  std::string unit = "deg";      ///< "deg", "rad", "gon" or "arcsec"
  bool lever_to_scanner = true;  ///< the lever arm points from the body's origin to the scanner
  bool lever_in_body = true;     ///< its components are along the body's axes, else the scanner's
};

/// The documented conventions.
const std::vector<MountingConvention>& mountingConventions();
/// The one of that name; UsageError that lists all names for another name.
const MountingConvention& mountingConventionNamed(const std::string& name);
/// Rotations in the order of three letters, "ZYX" or "ZXZ": about axes that move with the scanner,
/// or about fixed ones. UsageError for other letters and for one axis twice in a row.
MountingConvention mountingOrder(const std::string& order, bool fixed_axes = false);
/// One sentence: order, axes, direction, unit and lever arm.
std::string describe(const MountingConvention& convention);

/// Radians of "deg", "rad", "gon" or "arcsec"; UsageError for another unit.
double radiansPer(std::string_view unit);

/// The matrix from coordinates along \a axes to right, forward, up; orthogonal, its determinant is
/// -1 for left-handed axes. UsageError for letters that are no three perpendicular directions.
Eigen::Matrix3d bodyFromAxes(const std::string& axes);

/// A of three angles in the unit and order of the convention.
Eigen::Matrix3d rotationOf(const MountingConvention& convention, const Eigen::Vector3d& angles);

/** \brief The angles of a rotation A: of the two solutions the one nearer to \a near, within the
 * half turn or, where \a near is beyond it, within the whole turn.
 *
 * Where the first and the third axis coincide (gimbalSine() below kGimbalLock), the first angle of
 * the product stays that of \a near.
 */
Eigen::Vector3d anglesOf(const MountingConvention& convention, const Eigen::Matrix3d& rotation,
                         const Eigen::Vector3d& near);

/// Sine below which two axes coincide; points at 1000 m then move by 1e-9 m at most.
inline constexpr double kGimbalLock = 1e-12;

/// Sine of the angle between the axes of the first and the third rotation, 0 to 1: at 0 their
/// angles cannot be told apart (gimbal lock); their standard deviations grow with its inverse.
double gimbalSine(const MountingConvention& convention, const Eigen::Vector3d& angles);

/// The axes of the three rotations, in the order in which the angles are typed, as columns: a
/// change d of the angles (rad) turns A by the vector axes * d, dA A' = [axes * d]x.
Eigen::Matrix3d rotationAxes(const MountingConvention& convention, const Eigen::Vector3d& angles);

}  // namespace pcl_als
