// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <Eigen/Geometry>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/nearest_name.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/common/text_values.h>
#include <pcl_als/trajectory/mounting_convention.h>

namespace pcl_als {
namespace {

int axisIndex(char axis) {
  return axis - 'x';
}

Eigen::Matrix3d elementary(const MountingAngle& angle, double radians) {
  return Eigen::AngleAxisd(angle.sign * radians, Eigen::Vector3d::Unit(axisIndex(angle.axis)))
      .toRotationMatrix();
}

/// Axes of the rotations in the order of the product: i, j, k of R_i R_j R_k. Where the third is
/// the first again, k is the axis that is left.
struct ProductAxes {
  explicit ProductAxes(const MountingConvention& convention) {
    const auto axis = [&](std::size_t at) {
      return axisIndex(convention.angles[static_cast<std::size_t>(convention.product[at])].axis);
    };
    i = axis(0), j = axis(1), k = 3 - i - j;
    is_proper_euler = axis(2) == i;
    parity = (j - i + 3) % 3 == 1 ? 1.0 : -1.0;
  }

  int i, j, k;
  bool is_proper_euler;
  double parity;  ///< 1: i, j, k is x, y, z in cyclic order
};

/// Angles of R_i(a) R_j(b) R_k(c) or R_i(a) R_j(b) R_i(c) in the order of the product. The second
/// and third are those of the rotation that the first leaves, so that the product is exact also
/// near gimbal lock.
Eigen::Vector3d productAngles(const ProductAxes& axes, const Eigen::Matrix3d& rotation,
                              double near_first) {
  const int i = axes.i, j = axes.j, k = axes.k;
  const double e = axes.parity;
  const double sine = axes.is_proper_euler ? rotation(j, i) : -e * rotation(j, k);
  const double cosine = axes.is_proper_euler ? -e * rotation(k, i) : rotation(k, k);
  const double first =
      std::hypot(sine, cosine) < kGimbalLock ? near_first : std::atan2(sine, cosine);
  const Eigen::Matrix3d rest =
      Eigen::AngleAxisd(-first, Eigen::Vector3d::Unit(i)).toRotationMatrix() * rotation;
  if (axes.is_proper_euler)
    return {first, std::atan2(-e * rest(k, i), rest(i, i)),
            std::atan2(-e * rest(j, k), rest(j, j))};
  return {first, std::atan2(e * rest(i, k), rest(k, k)), std::atan2(e * rest(j, i), rest(j, j))};
}

/// The same rotation by the other set of angles.
Eigen::Vector3d otherAngles(const ProductAxes& axes, const Eigen::Vector3d& angles) {
  return {angles[0] + kPi, axes.is_proper_euler ? -angles[1] : kPi - angles[1], angles[2] + kPi};
}

double distanceOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) sum += std::abs(std::remainder(a[i] - b[i], 2.0 * kPi));
  return sum;
}

/// The angle in the range that a program uses which has \a near: half a turn to either side, or a
/// whole turn from zero.
double inRangeOf(double near, double angle) {
  const double turn = 2.0 * kPi;
  const double half = std::remainder(angle, turn);
  if (std::abs(near) <= kPi) return half;
  if (near > 0.0 && near < turn) return half < 0.0 ? half + turn : half;
  return near + std::remainder(angle - near, turn);
}

std::string lowerCase(std::string text) {
  for (char& letter : text) letter = letter >= 'A' && letter <= 'Z' ? char(letter + 32) : letter;
  return text;
}

}  // namespace

double radiansPer(std::string_view unit) {
  if (unit == "deg") return kRadiansPerDegree;
  if (unit == "rad") return 1.0;
  if (unit == "gon") return kPi / 200.0;
  if (unit == "arcsec") return kRadiansPerArcsec;
  throw UsageError("'" + std::string(unit) + "' is no unit of angles (deg, rad, gon, arcsec)");
}

Eigen::Matrix3d bodyFromAxes(const std::string& axes) {
  constexpr std::string_view kPositive = "rfu", kNegative = "lbd";
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  const std::string letters = lowerCase(axes);
  for (std::size_t column = 0; column < 3 && letters.size() == 3; ++column) {
    const std::size_t up = kPositive.find(letters[column]), down = kNegative.find(letters[column]);
    if (up != std::string_view::npos) matrix(Eigen::Index(up), Eigen::Index(column)) = 1.0;
    if (down != std::string_view::npos) matrix(Eigen::Index(down), Eigen::Index(column)) = -1.0;
  }
  if (std::abs(matrix.determinant()) != 1.0)
    throw UsageError("'" + axes +
                     "' are no axes: the directions of x, y and z, each one of r(ight) or l(eft), "
                     "f(orward) or b(ack), u(p) or d(own), such as frd");
  return matrix;
}

MountingConvention mountingOrder(const std::string& order, bool fixed_axes) {
  const std::string letters = lowerCase(order);
  const bool are_axes = letters.size() == 3 && letters.find_first_not_of("xyz") == letters.npos;
  if (!are_axes || letters[0] == letters[1] || letters[1] == letters[2])
    throw UsageError("'" + order +
                     "' is no order of three rotations: x, y or z each, none twice in a row, such "
                     "as ZYX or ZXZ");
  MountingConvention convention;
  for (std::size_t i = 0; i < 3; ++i)
    convention.angles[i] = {std::string(1, char(letters[i] - 32)), letters[i], 1};
  if (letters[0] == letters[2]) convention.angles[2].name += "'";
  if (fixed_axes) convention.product = {2, 1, 0};
  return convention;
}

const MountingConvention& mountingConventionNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const MountingConvention& convention : mountingConventions()) {
    if (convention.name == name) return convention;
    names.push_back(convention.name);
  }
  const std::string near = nearestName(name, names);
  throw UsageError("unknown convention '" + name + "'" +
                   (near.empty() ? " (" + joined(names) + ")" : "; did you mean " + near + "?"));
}

Eigen::Matrix3d rotationOf(const MountingConvention& convention, const Eigen::Vector3d& angles) {
  const double unit = radiansPer(convention.unit);
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (const int at : convention.product)
    rotation *= elementary(convention.angles[static_cast<std::size_t>(at)], unit * angles[at]);
  return rotation;
}

Eigen::Vector3d anglesOf(const MountingConvention& convention, const Eigen::Matrix3d& rotation,
                         const Eigen::Vector3d& near) {
  const double unit = radiansPer(convention.unit);
  const ProductAxes axes(convention);
  Eigen::Vector3d wanted;  // in the order of the product, along the axes
  for (std::size_t i = 0; i < 3; ++i) {
    const int at = convention.product[i];
    wanted[Eigen::Index(i)] =
        convention.angles[static_cast<std::size_t>(at)].sign * unit * near[at];
  }
  Eigen::Vector3d found = productAngles(axes, rotation, wanted[0]);
  const Eigen::Vector3d other = otherAngles(axes, found);
  if (distanceOf(other, wanted) < distanceOf(found, wanted)) found = other;
  Eigen::Vector3d angles;
  for (std::size_t i = 0; i < 3; ++i) {
    const int at = convention.product[i];
    const double typed =
        convention.angles[static_cast<std::size_t>(at)].sign * found[Eigen::Index(i)];
    angles[at] = inRangeOf(unit * near[at], typed) / unit;
  }
  return angles;
}

double gimbalSine(const MountingConvention& convention, const Eigen::Vector3d& angles) {
  const Eigen::Matrix3d axes = rotationAxes(convention, angles);
  return axes.col(convention.product[0]).cross(axes.col(convention.product[2])).norm();
}

Eigen::Matrix3d rotationAxes(const MountingConvention& convention, const Eigen::Vector3d& angles) {
  const double unit = radiansPer(convention.unit);
  Eigen::Matrix3d axes, before = Eigen::Matrix3d::Identity();
  for (const int at : convention.product) {
    const MountingAngle& angle = convention.angles[static_cast<std::size_t>(at)];
    axes.col(at) = angle.sign * before.col(axisIndex(angle.axis));
    before *= elementary(angle, unit * angles[at]);
  }
  return axes;
}

}  // namespace pcl_als
