// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The loop below is written for the compiler's vectoriser: no calls, no branches, one stream per
// column. The CMakeLists gives this file the flags that let it (sqrt without errno), none that
// change a result.
#include "bias_kernel.h"

#include <cmath>

namespace pcl_als::detail {
namespace {

/// Keeps 0 / 0 at the sensor itself from becoming NaN; lost in any other squared distance.
constexpr double kTinySquare = 1e-200;

/// atan on [-1, 1] as an odd polynomial: the Chebyshev series 2 sum (-1)^k (sqrt(2) - 1)^(2k+1) /
/// (2k+1) T_(2k+1) cut after 12 terms. Its error is under 2.6e-11.
inline double arcTangent(double u) {
  const double v = u * u;
  double sum = -0.00057295603926396904;
  sum = sum * v + 0.0042088656540090717;
  sum = sum * v - 0.014509255269694403;
  sum = sum * v + 0.031930507733696954;
  sum = sum * v - 0.052244278904973393;
  sum = sum * v + 0.071273074179690976;
  sum = sum * v - 0.089350893598542827;
  sum = sum * v + 0.11082190622719891;
  sum = sum * v - 0.14282329296523577;
  sum = sum * v + 0.19999775029961883;
  sum = sum * v - 0.33333326328696045;
  sum = sum * v + 0.99999999934929584;
  return sum * u;
}

/// beta = -atan2(x, -z) by the half angle, whose tangent stays within [-1, 1] below the sensor;
/// above it, the angle is taken from the other side.
inline double scanAngle(double x, double z, double range) {
  const double folded = 2.0 * arcTangent(x / (range + std::abs(z) + kTinySquare));
  return z <= 0.0 ? -folded : folded - std::copysign(kPi, x);
}

template <bool kRange, bool kScale>
void kernel(const FlightSpan& span, const SystemVector& biases, const PointColumns& points,
            std::size_t count, const EffectColumns& effect) {
  const double from = span.from;
  const double px = span.position.x(), py = span.position.y(), pz = span.position.z();
  const double vx = span.velocity.x(), vy = span.velocity.y(), vz = span.velocity.z();
  const double rx = span.right.x(), ry = span.right.y();
  const double wx = span.right_rate.x(), wy = span.right_rate.y();
  const double lever_x = biases[0], lever_y = biases[1], lever_z = biases[2];
  const double pitch = biases[3], roll = biases[4], heading = biases[5];
  const double range_bias = biases[6], scale = biases[7];
  const double* time = points.time;
  const double *east = points.x, *north = points.y, *up = points.z;
  double *effect_x = effect.x, *effect_y = effect.y, *effect_z = effect.z;
// Input and output columns may be the same array, element by element; they never overlap otherwise.
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double elapsed = time[i] - from;
    const double from_x = (east[i] - px) - elapsed * vx;
    const double from_y = (north[i] - py) - elapsed * vy;
    const double z = (up[i] - pz) - elapsed * vz;
    double c = rx + elapsed * wx, s = ry + elapsed * wy;
    const double unit = 1.0 / std::sqrt(c * c + s * s);
    c *= unit, s *= unit;
    const double x = from_x * c + from_y * s;
    double to_right = lever_x + z * roll;
    double upwards = lever_z - x * roll;
    const double forward = lever_y - z * pitch + x * heading;
    if (kRange || kScale) {
      const double range = std::sqrt(x * x + z * z + kTinySquare);
      const double along = range_bias / range;  // sin(b) = -x / range, cos(b) = -z / range
      const double turn = kScale ? scale * scanAngle(x, z, range) : 0.0;
      to_right += along * x + turn * z;
      upwards += along * z - turn * x;
    }
    effect_x[i] = c * to_right - s * forward;
    effect_y[i] = s * to_right + c * forward;
    effect_z[i] = upwards;
  }
}

}  // namespace

void biasKernel(const FlightSpan& span, const SystemVector& biases, const PointColumns& points,
                std::size_t count, const EffectColumns& effect) {
  if (biases[indexOf(SystemParameter::scan_angle_scale)] != 0.0) {
    kernel<true, true>(span, biases, points, count, effect);
  } else if (biases[indexOf(SystemParameter::range_bias)] != 0.0) {
    kernel<true, false>(span, biases, points, count, effect);
  } else {
    kernel<false, false>(span, biases, points, count, effect);
  }
}

}  // namespace pcl_als::detail
