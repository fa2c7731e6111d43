// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

namespace pcl_als {

/** \brief Sizes of the corrections of many points, in constant memory.
 *
 * The correction of a point is in proportion to its range, so that those of a flight differ by a
 * small factor. Where position or attitude of the trajectory are wrong at some time, the range of
 * the points of that time is wrong as well, and their corrections exceed what biases can cause.
 */
class CorrectionSizes {
 public:
  /// A correction (metres) at a time of the trajectory; zero is not counted.
  void add(double x, double y, double z, double time);
  void merge(const CorrectionSizes& other);

  std::size_t count() const { return count_; }
  double largest() const;  ///< metres
  /// The size that nine tenths do not exceed, metres, up to a factor of 1.41; 0 without any.
  double typical() const;
  /// Why biases cannot have caused the largest correction, with its time; empty where they can.
  std::string objection() const;

 private:
  // Classes by the binary exponent of the squared size, from 1e-6 m to 4 km.
  static constexpr int kFirstExponent = -40;
  std::array<std::size_t, 64> classes_{};
  std::size_t count_ = 0;
  double largest_sq_ = 0.0, time_of_largest_ = 0.0;
};

}  // namespace pcl_als
