// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <pcl_als/trajectory/coverage_count.h>

namespace pcl_als {
namespace {

/// Ranges within a flight differ by less: the ground near the sensor and the horizon.
constexpr double kLargestRatio = 30.0;
constexpr double kLeastLimit = 0.2;     // metres
constexpr double kLargestSize = 200.0;  // metres: 0.04 rad at a range of 5 km

/// The binary exponent of a positive normal number.
int exponentOf(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return static_cast<int>(bits >> 52U) - 1023;
}

}  // namespace

void CorrectionSizes::add(double x, double y, double z, double time) {
  const double sq = x * x + y * y + z * z;
  if (!(sq > 0.0)) return;
  const int last = static_cast<int>(classes_.size()) - 1;
  ++classes_[static_cast<std::size_t>(std::clamp(exponentOf(sq) - kFirstExponent, 0, last))];
  ++count_;
  if (sq <= largest_sq_) return;
  largest_sq_ = sq;
  time_of_largest_ = time;
}

void CorrectionSizes::merge(const CorrectionSizes& other) {
  for (std::size_t i = 0; i < classes_.size(); ++i) classes_[i] += other.classes_[i];
  count_ += other.count_;
  // The earlier one of equal corrections, so that the order of merging does not matter.
  if (other.largest_sq_ > largest_sq_ ||
      (other.largest_sq_ == largest_sq_ && other.time_of_largest_ < time_of_largest_)) {
    largest_sq_ = other.largest_sq_;
    time_of_largest_ = other.time_of_largest_;
  }
}

double CorrectionSizes::largest() const {
  return std::sqrt(largest_sq_);
}

double CorrectionSizes::typical() const {
  std::size_t below = 0;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    below += classes_[i];
    if (10 * below >= 9 * count_ && count_ > 0)
      return std::exp2(0.5 * (static_cast<int>(i) + kFirstExponent + 1));
  }
  return 0.0;
}

std::string CorrectionSizes::objection() const {
  const double limit = std::min(kLargestRatio * typical() + kLeastLimit, kLargestSize);
  if (!(largest() > limit)) return {};
  char text[300];
  std::snprintf(
      text, sizeof text,
      "the point at %.3f s of the trajectory would be moved by %.3g m, nine tenths of the "
      "points by at most %.2g m: the position or attitude of the trajectory at that time "
      "is wrong, or the points were not measured from it",
      time_of_largest_, largest(), typical());
  return text;
}

}  // namespace pcl_als
