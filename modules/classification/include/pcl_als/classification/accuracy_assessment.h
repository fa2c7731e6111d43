// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

using CountMatrix = Eigen::Matrix<std::int64_t, Eigen::Dynamic, Eigen::Dynamic>;

/// Numbers of check points by the class found (rows) and the reference class (columns).
struct ConfusionMatrix {
  std::vector<std::string> classes;
  CountMatrix counts;

  explicit ConfusionMatrix(std::vector<std::string> names);
  /// UsageError unless the counts are square, as many as the names, and none is negative.
  ConfusionMatrix(std::vector<std::string> names, CountMatrix values);
  std::int64_t total() const { return counts.sum(); }
};

/// An estimate with its 95 % confidence interval; all NaN where it is not determined.
struct Proportion {
  double value, low, high;
};

struct ClassAccuracy {
  std::string name;
  std::int64_t classified = 0, reference = 0, correct = 0;  ///< row, column, diagonal
  Proportion users{};      ///< share of the points classified as this class that belong to it
  Proportion producers{};  ///< share of the points of this class that are classified as it
  double kappa = 0.0;      ///< conditional, by row; NaN where undefined
  double kappa_std = 0.0;
};

struct AccuracyResult {
  std::int64_t points = 0, correct = 0;
  Proportion overall{};
  double kappa = 0.0, kappa_std = 0.0;
  Proportion kappa_interval{};
  std::vector<ClassAccuracy> classes;
  std::vector<std::string> remarks;  ///< classes without points and the like
};

/** \brief Accuracy of a classification from its confusion matrix.
 *
 * With p_ij the share of points classified as i with reference class j: overall accuracy sum p_ii;
 * kappa =
 * (sum p_ii - sum p_i+ p_+i) / (1 - sum p_i+ p_+i) (Cohen 1960); conditional kappa of row i
 * (p_ii - p_i+ p_+i) / (p_i+ - p_i+ p_+i), as Habib et al. 2011, Table 6. Standard deviations are
 * those of large samples (delta method; Bishop, Fienberg and Holland 1975), intervals of
 * proportions are Wilson's, of kappa normal. They hold for check points drawn independently of each
 * other; clustered points contain less information than their number.
 *
 * UsageError for a matrix without points.
 */
AccuracyResult assessAccuracy(const ConfusionMatrix& matrix);

/// A check point: indices into the names of classes.
struct CheckedPoint {
  int classified = 0, reference = 0;
};

/// Counts check points. UsageError for an index that has no name.
ConfusionMatrix countPoints(const std::vector<std::string>& classes,
                            const std::vector<CheckedPoint>& points);

/// Two classifications, first minus second.
struct AccuracyComparison {
  double overall_difference = 0.0, kappa_difference = 0.0;
  double kappa_difference_std = 0.0;
  double kappa_z = 0.0, kappa_p = 1.0;  ///< two-sided; NaN where the deviation is 0
  bool same_points = false;             ///< whether the following values are known
  std::int64_t only_first_right = 0, only_second_right = 0;
  double mcnemar_chi_sq = 0.0;  ///< with Edwards' continuity correction, one degree of freedom
  double mcnemar_p = 1.0;       ///< exact (binomial), two-sided
};

/// For different check points: the kappas are independent.
AccuracyComparison compareAccuracy(const ConfusionMatrix& first, const ConfusionMatrix& second);

/** \brief For the same check points in the same order: McNemar's test, and the difference of the
 * kappas with their covariance due to common points (delta method on pairs of outcomes).
 *
 * UsageError when the numbers of points or their references differ.
 */
AccuracyComparison compareAccuracy(const std::vector<std::string>& classes,
                                   const std::vector<CheckedPoint>& first,
                                   const std::vector<CheckedPoint>& second);

}  // namespace pcl_als
