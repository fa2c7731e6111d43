// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

/// Properties of a strip besides its fit to others.
struct StripFacts {
  std::string id;
  double start = 0.0, end = 0.0;  ///< seconds
  double height = 0.0;            ///< metres above ground; 0: unknown
};

/// A priori errors of a strip's trajectory, as SharedErrorModel.
struct StripErrorPrior {
  double position = 0.02;          ///< metres
  double correlation_time = 20.0;  ///< seconds

  /// Standard deviation of the mean of a Gauss-Markov process over a time in seconds; metres.
  double meanStd(double seconds) const;
};

/** \brief Strips that do not fit the rest of a block after its calibration.
 *
 * The means of the pairs, m_ab = h_a - h_b, give a height offset h of every strip (least squares,
 * mean zero). Each strip is compared with the mean of the others, and each group of strips (a
 * session: three hours or more between its strips and the others; a flying height that differs by a
 * tenth) with the other group, by Student's t. The variance is that of the offsets, to which the
 * prior contributes four degrees of freedom; the level is 5 % for all comparisons together
 * (Bonferroni).
 */
class StripConsistency {
 public:
  StripConsistency(const std::vector<StripFacts>& strips, const std::vector<PairFit>& pairs,
                   const StripErrorPrior& prior);

  /// By strip in the order given; only strips of pairs.
  const std::vector<StripOffset>& offsets() const { return offsets_; }
  /// One sentence for every strip or group that does not fit, and one for sessions that do.
  const Warnings& warnings() const { return warnings_; }

 private:
  void findOffsets(const std::vector<StripFacts>& strips, const std::vector<PairFit>& pairs);
  void compareSessions(double alpha);
  void compareHeights(double alpha);
  void compareStrips(double alpha);
  struct Comparison {
    double difference = 0.0, probability = 1.0;  ///< metres; two-sided
  };
  Comparison compare(const std::vector<bool>& group) const;
  std::string names(const std::vector<bool>& group) const;

  StripErrorPrior prior_;
  std::vector<StripFacts> strips_;  ///< of offsets_
  std::vector<StripOffset> offsets_;
  Warnings warnings_;
};

}  // namespace pcl_als
