// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/adjustment/overlap_variation.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/quality/pair_assessment.h>

namespace pcl_als {

std::int64_t OffsetSample::cluster() const {
  const auto cell = [](double v) { return static_cast<std::int64_t>(std::floor(v / kCluster)); };
  constexpr std::int64_t kColumns = std::int64_t{1} << 31U;
  return cell(position.y()) * kColumns + cell(position.x());
}

Eigen::Vector2d OffsetSample::centreOf(std::int64_t cluster) {
  constexpr std::int64_t kColumns = std::int64_t{1} << 31U;
  const auto row = static_cast<std::int64_t>(
      std::floor(static_cast<double>(cluster) / static_cast<double>(kColumns) + 0.5));
  const auto column = cluster - row * kColumns;
  return kCluster * (Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row)) +
                     Eigen::Vector2d::Constant(0.5));
}

OffsetSummary summarize(std::vector<double> values, const std::vector<std::int64_t>& clusters,
                        const std::vector<Eigen::Vector2d>& places) {
  OffsetSummary summary;
  summary.count = values.size();
  summary.std_of_mean = summary.std_of_mean_formal = std::numeric_limits<double>::quiet_NaN();
  if (values.empty()) return summary;
  RunningStatistics statistics;
  ClusteredRegression mean(1);
  OverlapVariation variation;
  for (std::size_t i = 0; i < values.size(); ++i) {
    statistics.add(values[i]);
    if (places.empty()) {
      mean.add(clusters[i], Eigen::VectorXd::Ones(1), values[i]);
    } else {
      mean.add(clusters[i], Eigen::VectorXd::Ones(1), values[i], places[i]);
      variation.add(clusters[i], places[i], values[i]);
    }
  }
  summary.mean = statistics.mean();
  summary.std = statistics.standardDeviation();
  summary.rms = statistics.rms();
  const ClusteredRegression::Result solved = mean.solve();
  summary.std_of_mean = solved.std(0);
  summary.std_of_mean_formal = solved.formalStd(0);
  if (solved.determined && !places.empty())
    summary.std_of_mean = std::max(
        summary.std_of_mean,
        std::sqrt(summary.std_of_mean_formal * summary.std_of_mean_formal + variation.ofOffset()));
  summary.nmad = robustSigma(values);
  summary.median = medianInPlace(values);
  for (double& value : values) value = std::abs(value);
  // Nearest rank: the smallest value that 95 % do not exceed.
  const auto rank =
      static_cast<std::ptrdiff_t>(std::ceil(0.95 * static_cast<double>(values.size())));
  const auto place = values.begin() + rank - 1;
  std::nth_element(values.begin(), place, values.end());
  summary.percentile_95 = *place;
  summary.largest = *std::max_element(place, values.end());
  return summary;
}

}  // namespace pcl_als
