// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/waveform/emitted_pulse.h>
#include <pcl_als/waveform/pulse_response.h>

namespace pcl_als {
namespace {

constexpr double kSaturation = 4095.0;

/// A pulse that rises faster than it falls, with its maximum at the time 0.
double skewed(double t) {
  const double width = t < 0.0 ? 1.6 : 2.4;
  return std::exp(-0.5 * t * t / (width * width));
}

std::vector<double> sampled(double peak, double amplitude, int samples, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  std::vector<double> counts;
  for (int i = 0; i < samples; ++i) {
    const double noise = random != nullptr ? normal(*random) : 0.0;
    counts.push_back(50.0 + amplitude * skewed(i - peak) + noise);
  }
  return counts;
}

/// The kink of this pulse is not its maximum after interpolation, which is a little behind it.
constexpr double kMaximum = 0.163;

TEST(EmittedPulse, MeanHasTheShapeOfThePulses) {
  std::mt19937_64 random(3);
  EmittedPulseMean mean;
  for (int i = 0; i < 2000; ++i)
    mean.add(sampled(15.0 + 0.37 * (i % 11), 300.0 + i % 50, 40, &random), kSaturation);
  const auto pulse = mean.result();
  ASSERT_TRUE(pulse);
  EXPECT_EQ(pulse->pulses, 2000U);
  EXPECT_NEAR(pulse->peak, 15.0 + 0.37 * 5.0 + kMaximum, 0.06);
  const double width = kFwhmOfGaussian * PulseResponse::sampled(pulse->samples, 1.0).width();
  EXPECT_NEAR(width, (1.6 + 2.4) * std::sqrt(2.0 * std::log(2.0)), 0.06);
  const auto top = static_cast<int>(std::max_element(pulse->samples.begin(), pulse->samples.end()) -
                                    pulse->samples.begin());
  for (int i = 0; i < static_cast<int>(pulse->samples.size()); ++i)
    EXPECT_NEAR(pulse->samples[static_cast<std::size_t>(i)], skewed(i - top + kMaximum), 0.02)
        << i - top;
}

TEST(EmittedPulse, LeavesOutWhatIsNoWholePulse) {
  EmittedPulseMean mean;
  EXPECT_FALSE(mean.result());
  mean.add(sampled(15.0, 5000.0, 40, nullptr), kSaturation);  // saturated
  mean.add(sampled(15.0, 3.0, 40, nullptr), kSaturation);     // of a few counts
  mean.add(sampled(0.2, 300.0, 40, nullptr), kSaturation);    // begins with its maximum
  mean.add(sampled(3.0, 300.0, 6, nullptr), kSaturation);     // too short
  mean.add(sampled(15.0, 300.0, 600, nullptr), kSaturation);  // longer than a pulse is
  EXPECT_EQ(mean.pulses(), 0U);
  mean.add(sampled(5.0, 300.0, 9, nullptr), kSaturation);  // cut off behind its maximum
  EXPECT_EQ(mean.pulses(), 1U);
  EXPECT_FALSE(mean.result());
}

}  // namespace
}  // namespace pcl_als
