// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The loop below is written for the compiler's vectoriser: no calls, no branches, one stream per
// column. The CMakeLists gives this file the flags that let it (sqrt without errno), none that
// change a result.
#include "bias_kernel.h"

#include <cmath>

namespace pcl_als::detail {
namespace {

/// Keep 0 / 0 at the sensor itself from becoming NaN; lost in any other distance.
constexpr double kTiny = 1e-100, kTinySquare = 1e-200;

/// atan on [-1, 1] as an odd polynomial: the Chebyshev series 2 sum (-1)^k (sqrt(2) - 1)^(2k+1) /
/// (2k+1) T_(2k+1) cut after 12 terms. Its error is under 2.6e-11. Summed in pairs of pairs
/// (Estrin), for a Horner chain of 12 would be all latency.
inline double arcTangent(double u) {
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
inline double scanAngle(double x, double z, double range) {
  const double folded = 2.0 * arcTangent(x / (range + std::abs(z) + kTiny));
  return z <= 0.0 ? -folded : folded - std::copysign(kPi, x);
}

/// 1 / sqrt(q) for q within 1 +- 1e-4 to 4e-13: the series in 1 - q up to its square.
inline double inverseRootNearOne(double q) {
  const double e = 1.0 - q;
  return 1.0 + e * (0.5 + 0.375 * e);
}

/// Whether the direction interpolated linearly between the ends of a span stays that near to a unit
/// vector: in the middle its square is 1 - (chord / 2)^2.
bool turnsLittle(const FlightSpan& span) {
  return (span.right_rate * (span.to - span.from)).squaredNorm() < 4e-4;
}

template <bool kTurn, bool kRange, bool kScale>
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
    const double square = c * c + s * s;
    const double unit = kTurn ? 1.0 / std::sqrt(square) : inverseRootNearOne(square);
    c *= unit, s *= unit;
    const double x = from_x * c + from_y * s;
    double to_right = lever_x + z * roll;
    double upwards = lever_z - x * roll;
    const double forward = lever_y - z * pitch + x * heading;
    if (kRange || kScale) {
      const double range = std::sqrt(x * x + z * z + kTinySquare);
      if (kRange) {
        const double along = range_bias / range;  // sin(b) = -x / range, cos(b) = -z / range
        to_right += along * x;
        upwards += along * z;
      }
      if (kScale) {
        const double turn = scale * scanAngle(x, z, range);
        to_right += turn * z;
        upwards -= turn * x;
      }
    }
    effect_x[i] = c * to_right - s * forward;
    effect_y[i] = s * to_right + c * forward;
    effect_z[i] = upwards;
  }
}

template <bool kRange, bool kScale>
void choose(const FlightSpan& span, const SystemVector& biases, const PointColumns& points,
            std::size_t count, const EffectColumns& effect) {
  const auto chosen =
      turnsLittle(span) ? kernel<false, kRange, kScale> : kernel<true, kRange, kScale>;
  chosen(span, biases, points, count, effect);
}

}  // namespace

void biasKernel(const FlightSpan& span, const SystemVector& biases, const PointColumns& points,
                std::size_t count, const EffectColumns& effect) {
  const bool range = biases[indexOf(SystemParameter::range_bias)] != 0.0;
  const bool scale = biases[indexOf(SystemParameter::scan_angle_scale)] != 0.0;
  if (range && scale) {
    choose<true, true>(span, biases, points, count, effect);
  } else if (scale) {
    choose<false, true>(span, biases, points, count, effect);
  } else if (range) {
    choose<true, false>(span, biases, points, count, effect);
  } else {
    choose<false, false>(span, biases, points, count, effect);
  }
}

}  // namespace pcl_als::detail
