// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

namespace pcl_als::detail {

/** \brief A sampled response, convolved with Gaussians of growing widths and tabulated.
 *
 * Between the widths of the table, which have constant ratios, cubic Hermite interpolation is used;
 * the derivative by the variance of the Gaussian is half the second derivative by time (heat
 * equation). In time, cubic Lagrange interpolation between eight values per sample. All samples of
 * an echo have the same place between these values, so that one set of weights serves all: the
 * values are stored by their phase within a sample.
 */
class PulseTable {
 public:
  PulseTable(const std::vector<double>& samples, double spacing);

  double width() const { return width_; }
  double leastWidth() const;
  double largestWidth() const;
  double before(double width) const;
  double after(double width) const;
  void evaluate(double time, double width, int first, int last, double* value, double* by_time,
                double* by_width) const;

 private:
  /// Values at one width: phase by phase, and by sample within a phase.
  struct Level {
    int first = 0;    ///< index of the first value, in steps of the table from the maximum
    int columns = 0;  ///< values of each phase
    std::vector<double> value, by_log_width;
  };
  struct Place {  ///< of a width among the levels
    std::size_t level = 0;
    double fraction = 0.0;
  };

  Place placeOf(double width) const;
  void addLevel(double width, int first_step, const std::vector<double>& values,
                const std::vector<double>& curvatures);

  double width_ = 0.0;
  std::vector<Level> levels_;
};

}  // namespace pcl_als::detail
