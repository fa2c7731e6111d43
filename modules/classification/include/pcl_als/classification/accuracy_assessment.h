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

/// Confusion matrix: numbers of check points by assigned class (rows) and reference class
/// (columns).
struct ConfusionMatrix {
  std::vector<std::string> classes;
  CountMatrix counts;

  /// A matrix of zeros.
  explicit ConfusionMatrix(std::vector<std::string> names);
  /// UsageError unless the counts have a row and a column for each name and are not negative.
  ConfusionMatrix(std::vector<std::string> names, CountMatrix values);
  std::int64_t total() const { return counts.sum(); }
};

/// An estimate with its 95 % confidence interval; all NaN where it is not determined.
struct Proportion {
  double value, low, high;
};

/// Accuracy of one class.
struct ClassAccuracy {
  std::string name;
  std::int64_t classified = 0, reference = 0, correct = 0;  ///< sums of row, column; diagonal
  Proportion users{};      ///< share of the points classified as this class that belong to it
  Proportion producers{};  ///< share of the points of this class that are classified correctly
  double kappa = 0.0;      ///< conditional, by row; NaN where undefined
  double kappa_std = 0.0;
};

/// Accuracy of a classification. Proportions are between 0 and 1, not in percent.
struct AccuracyResult {
  std::int64_t points = 0, correct = 0;
  Proportion overall{};                 ///< overall accuracy
  double kappa = 0.0, kappa_std = 0.0;  ///< NaN if all points are of one class
  Proportion kappa_interval{};
  std::vector<ClassAccuracy> classes;
  std::vector<std::string> remarks;  ///< classes without points and the like
};

/** \brief Accuracy of a classification from its confusion matrix.
 *
 * p_ij is the share of points that are classified as i and have the reference class j.
 *
 * - Overall accuracy: sum p_ii.
 * - Kappa (Cohen 1960): (sum p_ii - sum p_i+ p_+i) / (1 - sum p_i+ p_+i).
 * - Conditional kappa of row i, as in Habib et al. 2011, Table 6: (p_ii - p_i+ p_+i) / (p_i+ - p_i+
 *   p_+i).
 *
 * Standard deviations are those of large samples (delta method; Bishop, Fienberg and Holland 1975).
 * Intervals of proportions are Wilson's, those of kappa are normal. They hold for check points that
 * were drawn independently of each other; clustered points contain less information than their
 * number. UsageError for a matrix without points.
 * \code
 * pcl_als::ConfusionMatrix matrix({"ground", "roof"});
 * matrix.counts << 95, 4, 5, 96;  // rows: classified, columns: reference
 * const double overall = pcl_als::assessAccuracy(matrix).overall.value;  // 0.955
 * \endcode
 */
AccuracyResult assessAccuracy(const ConfusionMatrix& matrix);

/// A check point: indices into the names of classes.
struct CheckedPoint {
  int classified = 0, reference = 0;
};

/// Counts check points. UsageError for an index that has no name.
ConfusionMatrix countPoints(const std::vector<std::string>& classes,
                            const std::vector<CheckedPoint>& points);

/// Comparison of two classifications; differences are first minus second.
struct AccuracyComparison {
  double overall_difference = 0.0, kappa_difference = 0.0;
  double kappa_difference_std = 0.0;
  double kappa_z = 0.0, kappa_p = 1.0;  ///< two-sided; NaN if the standard deviation is 0
  bool same_points = false;             ///< whether the following values are known
  std::int64_t only_first_right = 0, only_second_right = 0;  ///< numbers of points
  double mcnemar_chi_sq = 0.0;  ///< with Edwards' continuity correction, one degree of freedom
  double mcnemar_p = 1.0;       ///< exact (binomial), two-sided
};

/// Compares two classifications at different check points, whose kappas are independent. UsageError
/// for a matrix without points.
AccuracyComparison compareAccuracy(const ConfusionMatrix& first, const ConfusionMatrix& second);

/** \brief Compares two classifications at the same check points in the same order.
 *
 * McNemar's test, and the difference of the kappas with their covariance due to the common points
 * (delta method on pairs of outcomes). UsageError if the numbers of points or their reference
 * classes differ.
 */
AccuracyComparison compareAccuracy(const std::vector<std::string>& classes,
                                   const std::vector<CheckedPoint>& first,
                                   const std::vector<CheckedPoint>& second);

}  // namespace pcl_als
