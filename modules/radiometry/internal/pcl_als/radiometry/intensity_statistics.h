// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_als/common/statistics.h>

namespace pcl_als {

class ByteReader;
class ByteWriter;

/// Statistics of the same points before and after a correction.
struct BeforeAfter {
  RunningStatistics before, after;
  void add(double b, double a) { before.add(b), after.add(a); }
  void merge(const BeforeAfter& other) {
    before.merge(other.before);
    after.merge(other.after);
  }
};

/// Variance over mean (Habib et al. 2011, Figure 5); 0 without values.
double varianceToMean(const RunningStatistics& statistics);

/** \brief Effect of a correction of intensity, by slope, by class and by strip.
 *
 * The variance-to-mean ratio has the unit of the intensity: for a comparison, scale the corrected
 * values to the mean of the given ones. Merging in the same order gives the same result. Memory:
 * some kilobytes per strip for any number of points.
 */
class IntensityStatistics {
 public:
  static constexpr std::size_t kSlopeBins = 15;  ///< of 5 degrees, then steeper
  static constexpr double kSlopeStep = 5.0;      ///< degrees

  explicit IntensityStatistics(std::size_t strips);

  /// \a slope: degrees; NaN: no surface.
  void add(std::size_t strip, double before, double after, double slope,
           std::uint8_t classification);
  void merge(const IntensityStatistics& other);
  /// All statistics, for another process.
  void put(ByteWriter& out) const;
  void get(ByteReader& in);

  std::size_t strips() const { return strips_.size(); }
  const BeforeAfter& strip(std::size_t i) const { return strips_[i].all; }
  const BeforeAfter& stripSlope(std::size_t i, std::size_t bin) const {
    return strips_[i].slopes[bin];
  }
  /// Of all strips together; bin kSlopeBins: points without a surface.
  BeforeAfter slope(std::size_t bin) const;
  BeforeAfter all() const;
  const BeforeAfter& classOf(std::uint8_t code) const { return classes_[code]; }

 private:
  struct Strip {
    BeforeAfter all;
    std::array<BeforeAfter, kSlopeBins + 1> slopes;
  };
  std::vector<Strip> strips_;
  std::vector<BeforeAfter> classes_;
};

/// Counts of 16-bit values before and after, one strip.
struct IntensityHistogram {
  std::vector<std::uint64_t> before = std::vector<std::uint64_t>(65536);
  std::vector<std::uint64_t> after = std::vector<std::uint64_t>(65536);

  /// The counts that are not zero, for another process, and their addition to these.
  void put(ByteWriter& out) const;
  void add(ByteReader& in);
};

}  // namespace pcl_als
