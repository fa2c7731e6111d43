// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The loop below is written for the compiler's vectoriser: no calls, no branches, one stream per
// column. The CMakeLists gives this file the flags that let it (sqrt without errno), none that
// change a result.
#include "bias_kernel.h"

#include <cmath>

#include <pcl_als/common/vector_clones.h>
#include <pcl_als/trajectory/scan_geometry.h>

namespace pcl_als::detail {
namespace {

/// Keep 0 / 0 at the sensor itself from becoming NaN; lost in any other distance.
constexpr double kTiny = 1e-100, kTinySquare = 1e-200;

/// atan on [-1, 1] as an odd polynomial: the Chebyshev series 2 sum (-1)^k (sqrt(2) - 1)^(2k+1) /
/// (2k+1) T_(2k+1) cut after 12 terms. Its error is under 2.6e-11. Summed in pairs of pairs
/// (Estrin), for a Horner chain of 12 would be all latency.
ALS_INLINE double arcTangent(double u) {
  const double v = u * u, w = v * v, x = w * w;
  const double p0 = 0.99999999934929584 - 0.33333326328696045 * v;
  const double p1 = 0.19999775029961883 - 0.14282329296523577 * v;
  const double p2 = 0.11082190622719891 - 0.089350893598542827 * v;
  const double p3 = 0.071273074179690976 - 0.052244278904973393 * v;
  const double p4 = 0.031930507733696954 - 0.014509255269694403 * v;
  const double p5 = 0.0042088656540090717 - 0.00057295603926396904 * v;
  const double q0 = p0 + p1 * w, q1 = p2 + p3 * w, q2 = p4 + p5 * w;
  return u * (q0 + x * (q1 + x * q2));
}

/// beta = -atan2(x, -z) by the half angle, whose tangent stays within [-1, 1] below the sensor;
/// above it, the angle is taken from the other side.
ALS_INLINE double scanAngle(double x, double z, double range) {
  const double folded = 2.0 * arcTangent(x / (range + std::abs(z) + kTiny));
  return z <= 0.0 ? -folded : folded - std::copysign(kPi, x);
}

/// sin and cos of the small angles by which a scale bias turns beams, to 1e-15 up to 0.05 rad.
ALS_INLINE double smallSine(double a) {
  const double q = a * a;
  return a * (1.0 - q * (1.0 / 6.0) * (1.0 - q * (1.0 / 20.0) * (1.0 - q * (1.0 / 42.0))));
}
ALS_INLINE double smallCosine(double a) {
  const double q = a * a;
  return 1.0 - 0.5 * q * (1.0 - q * (1.0 / 12.0) * (1.0 - q * (1.0 / 30.0) * (1.0 - q / 56.0)));
}

/// value(t) = constant + t * rate + t^2 * curve
struct Quadratic {
  double constant, rate, curve;
  ALS_INLINE double at(double t) const { return constant + t * (rate + t * curve); }
};

template <bool kRange, bool kScale>
ALS_INLINE void kernel(const FlightSpan& span, const MountingBias& bias, const PointColumns& points,
                       std::size_t count, const EffectColumns& effect) {
  const double from = span.from;
  const double px = span.position.x(), py = span.position.y(), pz = span.position.z();
  const double vx = span.velocity.x(), vy = span.velocity.y(), vz = span.velocity.z();
  const auto entry = [&](int row, int column) {
    return Quadratic{span.rotation(row, column), span.rotation_rate(row, column),
                     span.rotation_curve(row, column)};
  };
  const Quadratic q00 = entry(0, 0), q01 = entry(0, 1), q02 = entry(0, 2);
  const Quadratic q10 = entry(1, 0), q11 = entry(1, 1), q12 = entry(1, 2);
  const Quadratic q20 = entry(2, 0), q21 = entry(2, 1), q22 = entry(2, 2);
  const double forward_share = span.has_attitude ? 1.0 : 0.0;
  const double lever_x = bias.lever_arm.x(), lever_y = bias.lever_arm.y();
  const double lever_z = bias.lever_arm.z();
  const double b00 = bias.boresight(0, 0), b01 = bias.boresight(0, 1), b02 = bias.boresight(0, 2);
  const double b10 = bias.boresight(1, 0), b11 = bias.boresight(1, 1), b12 = bias.boresight(1, 2);
  const double b20 = bias.boresight(2, 0), b21 = bias.boresight(2, 1), b22 = bias.boresight(2, 2);
  const double range_bias = bias.range, turn = -bias.scale / (1.0 + bias.scale);
  const double* time = points.time;
  const double *east = points.x, *north = points.y, *up = points.z;
  double *effect_x = effect.x, *effect_y = effect.y, *effect_z = effect.z;
// Input and output columns may be the same array, element by element; they never overlap otherwise.
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double t = time[i] - from;
    const double dx = (east[i] - px) - t * vx;
    const double dy = (north[i] - py) - t * vy;
    const double dz = (up[i] - pz) - t * vz;
    const double r00 = q00.at(t), r01 = q01.at(t), r02 = q02.at(t);
    const double r10 = q10.at(t), r11 = q11.at(t), r12 = q12.at(t);
    const double r20 = q20.at(t), r21 = q21.at(t), r22 = q22.at(t);
    const double x = r00 * dx + r10 * dy + r20 * dz;
    const double y = forward_share * (r01 * dx + r11 * dy + r21 * dz);
    const double z = r02 * dx + r12 * dy + r22 * dz;
    const double lx = x - lever_x, ly = y - lever_y, lz = z - lever_z;
    double wx = b00 * lx + b10 * ly + b20 * lz;
    double wy = b01 * lx + b11 * ly + b21 * lz;
    double wz = b02 * lx + b12 * ly + b22 * lz;
    // The scan angle does not change with the range: two chains, side by side.
    const double in_plane_sq = wx * wx + wz * wz + kTinySquare;
    const double shrink = kRange ? 1.0 - range_bias / std::sqrt(in_plane_sq + wy * wy) : 1.0;
    if (kScale) {
      const double angle = turn * scanAngle(wx, wz, std::sqrt(in_plane_sq));
      const double sine = smallSine(angle), cosine = smallCosine(angle);
      const double turned = wx * cosine + wz * sine;
      wz = wz * cosine - wx * sine;
      wx = turned;
    }
    if (kRange) wx *= shrink, wy *= shrink, wz *= shrink;
    const double ex = x - wx, ey = y - wy, ez = z - wz;
    effect_x[i] = r00 * ex + r01 * ey + r02 * ez;
    effect_y[i] = r10 * ex + r11 * ey + r12 * ez;
    effect_z[i] = r20 * ex + r21 * ey + r22 * ez;
  }
}

ALS_VECTOR_CLONES void turns(const FlightSpan& span, const MountingBias& bias,
                             const PointColumns& points, std::size_t count,
                             const EffectColumns& effect) {
  kernel<false, false>(span, bias, points, count, effect);
}
ALS_VECTOR_CLONES void turnsAndRange(const FlightSpan& span, const MountingBias& bias,
                                     const PointColumns& points, std::size_t count,
                                     const EffectColumns& effect) {
  kernel<true, false>(span, bias, points, count, effect);
}
ALS_VECTOR_CLONES void turnsAndScale(const FlightSpan& span, const MountingBias& bias,
                                     const PointColumns& points, std::size_t count,
                                     const EffectColumns& effect) {
  kernel<false, true>(span, bias, points, count, effect);
}
ALS_VECTOR_CLONES void all(const FlightSpan& span, const MountingBias& bias,
                           const PointColumns& points, std::size_t count,
                           const EffectColumns& effect) {
  kernel<true, true>(span, bias, points, count, effect);
}

/// The scale acts in the plane of each pulse, which is searched for.
void inSeveralPlanes(const FlightSpan& span, const MountingBias& bias, const PointColumns& points,
                     std::size_t count, const EffectColumns& effect) {
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d point(points.x[i], points.y[i], points.z[i]);
    const Eigen::Vector3d moved = point - corrected(span.at(points.time[i]), point, bias.all);
    effect.x[i] = moved.x(), effect.y[i] = moved.y(), effect.z[i] = moved.z();
  }
}

}  // namespace

MountingBias::MountingBias(const SystemVector& biases)
    : all(biases),
      lever_arm(biases.head<3>()),
      boresight(boresightRotation(biases)),
      range(biases[indexOf(SystemParameter::range_bias)]),
      scale(biases[indexOf(SystemParameter::scan_angle_scale)]) {}

void biasKernel(const FlightSpan& span, const MountingBias& bias, const PointColumns& points,
                std::size_t count, const EffectColumns& effect) {
  const bool range = bias.range != 0.0, scale = bias.scale != 0.0;
  if (scale && span.planes != nullptr) {
    inSeveralPlanes(span, bias, points, count, effect);
    return;
  }
  const auto chosen = range ? (scale ? all : turnsAndRange) : (scale ? turnsAndScale : turns);
  chosen(span, bias, points, count, effect);
}

}  // namespace pcl_als::detail
