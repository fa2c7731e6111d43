// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// The factor from corrected intensity to reflectance: reflectance = intensity / constant.
struct ReferenceResult {
  struct Target {
    std::string id;
    std::size_t points = 0;
    /// given; from the points with the estimated constant
    double reflectance = 0.0, measured = 0.0;
    double relative_std = 0.0;  ///< of the points' median and the given value
    bool used = false;
  };
  double constant = 0.0;      ///< corrected intensity of reflectance 1; 0: not determined
  double relative_std = 0.0;  ///< of the constant
  /// Root mean square of (measured - given) / given over used targets; 0 for a single one.
  double relative_rms = 0.0;
  std::vector<Target> targets;
  std::vector<std::string> warnings;
};

/** \brief Estimates the constant from corrected points within a radius around targets.
 *
 * The median of a target's points over its reflectance estimates the constant; targets are weighted
 * by the spread of their points and their own sigma, and where they differ by more than that the
 * standard deviation is increased accordingly. A single target cannot show such differences, which
 * the result states. Memory: 8 bytes for each point in a target.
 */
class ReferenceCalibration {
 public:
  static constexpr std::size_t kLeastPoints = 3;

  /// UsageError for no targets, a reflectance outside (0, 2], a radius that is not positive.
  ReferenceCalibration(std::vector<ReferenceTarget> targets, double radius);

  /// Whether any target is within its radius of a box.
  bool touches(double min_x, double min_y, double max_x, double max_y) const;
  /// Points with a surface, neither zero nor saturated.
  void add(double x, double y, double corrected_intensity);
  ReferenceResult solve() const;

 private:
  std::vector<ReferenceTarget> targets_;
  double radius_;
  std::vector<std::vector<double>> values_;
};

}  // namespace pcl_als
