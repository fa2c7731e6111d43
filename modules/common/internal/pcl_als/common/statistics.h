// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

namespace pcl_als {

/// Mean, standard deviation about the mean and root mean square of values added one by one
/// (Welford), mergeable.
class RunningStatistics {
 public:
  void add(double value);
  void merge(const RunningStatistics& other);
  std::size_t count() const { return count_; }
  double mean() const { return mean_; }
  double standardDeviation() const;  ///< with count - 1; 0 for fewer than two values
  double rms() const;

 private:
  std::size_t count_ = 0;
  double mean_ = 0.0;
  double squares_ = 0.0;  ///< sum of squared deviations from the mean
};

/// Median of the values (mean of the middle two for an even count); NaN when empty. The order of
/// the values is lost.
double medianInPlace(std::vector<double>& values);

/// Median absolute deviation from the median, scaled by 1.4826: the standard deviation if the
/// values were normal (NMAD, Hoehle and Hoehle 2009). NaN when empty.
double robustSigma(std::vector<double> values);
/// The same from zero instead of the median: for errors whose mean should be zero, a mean that is
/// not counts as scatter.
double robustSigmaAboutZero(std::vector<double> values);

}  // namespace pcl_als
