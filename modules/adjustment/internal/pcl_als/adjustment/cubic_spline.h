// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl_als {

/** \brief Uniform cubic B-splines over [from, to]: four of them differ from zero at any time.
 *
 * A spline is the sum of count() coefficients times basis functions; the coefficient k belongs to
 * the time from + (k - 1) * step. Sums of the basis functions are 1, and coefficients that are
 * linear in k give a function that is linear in time.
 */
class UniformCubicSpline {
 public:
  /// \param step seconds (or any unit) between knots, at most; [from, to] is divided evenly
  UniformCubicSpline(double from, double to, double step)
      : from_(from), pieces_(std::max(1, static_cast<int>(std::ceil((to - from) / step - 1e-9)))) {
    step_ = to > from ? (to - from) / pieces_ : step;
  }

  int count() const { return pieces_ + 3; }
  double step() const { return step_; }
  double from() const { return from_; }
  double to() const { return from_ + pieces_ * step_; }

  /// The coefficients first … first + 3 with their weights. Beyond the ends: the extension of the
  /// first and last piece.
  struct Weights {
    int first = 0;
    std::array<double, 4> value{}, slope{};  ///< slope: per second
  };
  Weights at(double time) const {
    const double place = (time - from_) / step_;
    const int piece = std::clamp(static_cast<int>(std::floor(place)), 0, pieces_ - 1);
    const double u = place - piece, v = 1.0 - u;
    Weights weights;
    weights.first = piece;
    weights.value = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                     (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0};
    weights.slope = {-0.5 * v * v / step_, (1.5 * u * u - 2.0 * u) / step_,
                     (-1.5 * v * v + 2.0 * v) / step_, 0.5 * u * u / step_};
    return weights;
  }

 private:
  double from_, step_ = 1.0;
  int pieces_;
};

}  // namespace pcl_als
