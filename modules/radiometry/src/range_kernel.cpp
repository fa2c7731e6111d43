// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The CMakeLists gives this file the flags that let the vectoriser work (sqrt without errno), none
// that changes a result.
#include "range_kernel.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <pcl_als/common/vector_clones.h>

namespace pcl_als::detail {
namespace {

/// exp(x) = 2^n exp(r), |r| <= ln(2) / 2: the Taylor series of exp(r) to r^9, whose rest is under
/// 1.1e-11 of it, in pairs of pairs. Beyond +-600 the exponential of that, which no 16-bit value
/// tells from 0 or infinity.
ALS_INLINE double exponential(double x) {
  constexpr double kPerLn2 = 1.4426950408889634, kLn2 = 0.69314718055994531,
                   kMaximumExponent = 600.0;
  // Adding 1.5 * 2^52 rounds to a whole number, which is then in the low bits.
  constexpr double kShift = 6755399441055744.0;
  x = x < -kMaximumExponent ? -kMaximumExponent : x;
  x = x > kMaximumExponent ? kMaximumExponent : x;
  const double shifted = x * kPerLn2 + kShift;
  const double r = x - (shifted - kShift) * kLn2;
  std::uint64_t bits;
  std::memcpy(&bits, &shifted, sizeof bits);
  bits = (bits << 52U) + (std::uint64_t{1023} << 52U);
  double power;
  std::memcpy(&power, &bits, sizeof power);
  const double r2 = r * r, r4 = r2 * r2;
  const double p0 = 1.0 + r, p1 = 1.0 / 2.0 + r * (1.0 / 6.0);
  const double p2 = 1.0 / 24.0 + r * (1.0 / 120.0), p3 = 1.0 / 720.0 + r * (1.0 / 5040.0);
  const double p4 = 1.0 / 40320.0 + r * (1.0 / 362880.0);
  return power * ((p0 + r2 * p1) + r4 * ((p2 + r2 * p3) + r4 * p4));
}

template <bool kSquare, bool kAir>
ALS_INLINE std::uint64_t kernel(const PathSpan& span, const RadiometricModel& model,
                                const PointColumns& points, std::size_t count,
                                const RangeColumns& out) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const double from = span.from;
  const double px = span.position.x(), py = span.position.y(), pz = span.position.z();
  const double vx = span.velocity.x(), vy = span.velocity.y(), vz = span.velocity.z();
  const double reference = model.reference_range, per_reference = 1.0 / reference;
  const double per_metre = 2.0 * model.extinction_per_km / 1000.0;
  const double* time = points.time;
  const double *east = points.x, *north = points.y, *up = points.z;
  double *ranges = out.range, *factors = out.factor;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double t = time[i] - from;
    const double dx = east[i] - (px + t * vx);
    const double dy = north[i] - (py + t * vy);
    const double dz = up[i] - (pz + t * vz);
    const double range = std::sqrt(dx * dx + dy * dy + dz * dz);
    const double ratio = range * per_reference;
    double factor = kSquare ? ratio * ratio : 1.0;
    if (kAir) factor *= exponential(per_metre * (range - reference));
    ranges[i] = dz < 0.0 ? range : kNone;
    factors[i] = dz < 0.0 ? factor : 1.0;
  }
  std::uint64_t above = 0;
  for (std::size_t i = 0; i < count; ++i) above += ranges[i] != ranges[i] ? 1U : 0U;
  return above;
}

ALS_VECTOR_CLONES std::uint64_t chosenKernel(bool square, bool air, const PathSpan& span,
                                             const RadiometricModel& model,
                                             const PointColumns& points, std::size_t count,
                                             const RangeColumns& out) {
  if (square && air) return kernel<true, true>(span, model, points, count, out);
  if (square) return kernel<true, false>(span, model, points, count, out);
  if (air) return kernel<false, true>(span, model, points, count, out);
  return kernel<false, false>(span, model, points, count, out);
}

}  // namespace

std::uint64_t rangeKernel(const PathSpan& span, const RadiometricModel& model,
                          const PointColumns& points, std::size_t count, const RangeColumns& out) {
  const bool square = model.range_exponent == 2.0, air = model.extinction_per_km != 0.0;
  if (square || model.range_exponent == 0.0)
    return chosenKernel(square, air, span, model, points, count, out);
  // Any other exponent needs a logarithm.
  const std::uint64_t above = chosenKernel(false, false, span, model, points, count, out);
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isnan(out.range[i])) out.factor[i] = model.factor(out.range[i], std::nan(""));
  return above;
}

}  // namespace pcl_als::detail
