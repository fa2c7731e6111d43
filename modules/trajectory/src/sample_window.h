// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als::detail {

/// What is compared: deviations in plan and height are metres, those of angles radians.
constexpr std::size_t kSampleChannels = 5;
enum SampleChannel : std::size_t {
  kChannelPlan,
  kChannelHeight,
  kChannelRoll,
  kChannelPitch,
  kChannelHeading
};
using ChannelValues = std::array<double, kSampleChannels>;

/// Position, then roll, pitch and heading.
using SampleValues = Eigen::Matrix<double, 6, 1>;

/// The values of a sample relative to those of another; angles within half a turn.
inline SampleValues valuesRelativeTo(const TrajectorySample& sample,
                                     const TrajectorySample& origin) {
  SampleValues values;
  values.head<3>() = sample.position - origin.position;
  values[3] = std::remainder(sample.roll - origin.roll, 2.0 * kPi);
  values[4] = std::remainder(sample.pitch - origin.pitch, 2.0 * kPi);
  values[5] = std::remainder(sample.heading - origin.heading, 2.0 * kPi);
  return values;
}

/// Deviations by channel; of angles within half a turn.
inline ChannelValues channelsOf(const SampleValues& difference) {
  return {std::hypot(difference[0], difference[1]), std::abs(difference[2]),
          std::abs(std::remainder(difference[3], 2.0 * kPi)),
          std::abs(std::remainder(difference[4], 2.0 * kPi)),
          std::abs(std::remainder(difference[5], 2.0 * kPi))};
}

/** \brief A polynomial of time through some samples (anchors): cubic, quadratic or linear, as they
 * are many enough for redundancy. */
class SampleWindow {
 public:
  static constexpr std::size_t kMaximumSamples = 8, kMinimumSamples = 4;

  /// \a anchors: kMinimumSamples to kMaximumSamples samples, of different times.
  explicit SampleWindow(const std::vector<const TrajectorySample*>& anchors);

  /// Deviation of a sample from the polynomial; NaN in channels that a sample or anchor lacks.
  ChannelValues deviation(const TrajectorySample& sample) const;
  /// Largest residual of an anchor.
  const ChannelValues& misfit() const { return misfit_; }
  /// What the misfit is multiplied by for a prediction: root of one plus the leverage of the time.
  double amplification(double time) const;

 private:
  using Basis = Eigen::Matrix<double, 4, 1>;
  Basis basis(double time) const;

  const TrajectorySample& origin_;
  double centre_ = 0.0, per_second_ = 1.0;
  int order_ = 2;                                      ///< number of coefficients
  Eigen::Matrix4d inverse_ = Eigen::Matrix4d::Zero();  ///< of the normal matrix
  Eigen::Matrix<double, 4, 6> coefficients_;
  ChannelValues misfit_{};
};

}  // namespace pcl_als::detail
