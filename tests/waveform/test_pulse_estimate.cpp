// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/waveform/echo_settings.h>
#include <pcl_als/waveform/pulse_estimate.h>
#include <pcl_als/waveform/waveform_decomposer.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "waveform_generator.h"

namespace pcl_als {
namespace {

using test::WaveformGenerator;

constexpr double kLargestCount = 4095.0;
constexpr double kNoise = 4.0;  // counts

/// A pulse of some shape, as the digitizer integrates it over a sample; tabulated, with its maximum
/// at the time 0.
class TruePulse {
 public:
  explicit TruePulse(const std::function<double(double)>& power) {
    for (int i = -kHalfTable; i <= kHalfTable; ++i)
      value_.push_back(WaveformGenerator::integrated(power, i * kStep));
    const auto top = std::max_element(value_.begin(), value_.end());
    const double shift = 0.5 * (top[-1] - top[1]) / (top[-1] - 2.0 * top[0] + top[1]);
    maximum_ = top[0] - 0.25 * (top[-1] - top[1]) * shift;
    zero_ = static_cast<double>(top - value_.begin()) + shift;
  }
  double at(double t) const {
    const double place = t / kStep + zero_;
    if (!(place >= 0.0) || place + 1.0 >= static_cast<double>(value_.size())) return 0.0;
    const auto i = static_cast<std::size_t>(place);
    const double f = place - static_cast<double>(i);
    return ((1.0 - f) * value_[i] + f * value_[i + 1]) / maximum_;
  }

 private:
  static constexpr double kStep = 0.01;  // samples
  static constexpr int kHalfTable = 6000;
  std::vector<double> value_;
  double zero_ = 0.0, maximum_ = 1.0;
};

double gaussian(double t, double width) {
  return std::exp(-0.5 * t * t / (width * width));
}
/// Rises with 0.6 of the width, and decays with 1.4 of it.
TruePulse steepPulse(double width) {
  return TruePulse([width](double t) { return gaussian(t, t < 0.0 ? 0.6 * width : 1.4 * width); });
}

/// An exponential decay behind a Gaussian: skewness 0.6, standard deviation \a width; convolved
/// with the Gaussian spread of a target, with the standard deviation \a spread.
TruePulse decaying(double width, double spread = 0.0) {
  const double decay = std::cbrt(0.3),
               sigma = std::sqrt(1.0 - decay * decay + spread * spread / (width * width));
  return TruePulse([=](double t) {
    const double x = t / width;
    return std::exp(0.5 * sigma * sigma / (decay * decay) - x / decay) *
           std::erfc((sigma / decay - x / sigma) / std::sqrt(2.0));
  });
}

/// Waveforms of whole counts, with the single echo's amplitude and time.
struct Waveforms {
  std::vector<std::vector<double>> counts;
  std::vector<double> amplitude, time;
};

/// Echoes of a pulse; every tenth waveform has a second one, \a scale changes all counts.
Waveforms waveformsOf(const TruePulse& pulse, unsigned seed, int count, double scale = 1.0) {
  WaveformGenerator generator(seed);
  std::mt19937_64 random(seed + 1000);
  std::normal_distribution<double> normal;
  Waveforms made;
  for (int k = 0; k < count; ++k) {
    const double amplitude = generator.uniform(100.0, 3600.0), time = generator.uniform(20.0, 21.0);
    const double behind = k % 10 == 0 ? generator.uniform(6.0, 30.0) : 0.0;
    std::vector<double> counts;
    for (int i = 0; i < 64; ++i) {
      double y = 80.0 + amplitude * pulse.at(i - time) + kNoise * normal(random);
      if (behind > 0.0) y += 0.4 * amplitude * pulse.at(i - time - behind);
      counts.push_back(std::round(scale * y));
    }
    made.counts.push_back(counts);
    made.amplitude.push_back(behind > 0.0 ? 0.0 : scale * amplitude);
    made.time.push_back(time);
  }
  return made;
}

EstimatedPulse estimateOf(const Waveforms& waveforms, double saturation = kLargestCount) {
  PulseEstimate estimate;
  for (const std::vector<double>& counts : waveforms.counts) estimate.add(counts, saturation);
  const auto pulse = estimate.estimate();
  if (!pulse) throw std::runtime_error("no estimate");
  return *pulse;
}

double largestDifference(const PulseResponse& response, const TruePulse& truth) {
  double largest = 0.0;
  for (double t = -20.0; t < 40.0; t += 0.1)
    largest = std::max(largest, std::abs(response.valueAt(t) - truth.at(t)));
  return largest;
}

/// What a response finds in waveforms that it was not estimated from.
struct Found {
  double false_share = 0.0, relative_rms = 0.0;
  double offset = 0.0;  ///< mean error of the time, samples

  Found(const PulseResponse& response, const Waveforms& waveforms) {
    WaveformDecomposer decomposer(response);
    Decomposition result;
    int single = 0, more = 0, used = 0;
    for (std::size_t i = 0; i < waveforms.counts.size(); ++i) {
      if (waveforms.amplitude[i] == 0.0) continue;
      decomposer.decompose(waveforms.counts[i].data(), waveforms.counts[i].size(), result);
      ++single;
      more += result.count - 1;
      if (result.count != 1) continue;
      const double error = (result.echo[0].time - waveforms.time[i]) / result.echo[0].time_std;
      relative_rms += error * error;
      offset += result.echo[0].time - waveforms.time[i];
      ++used;
    }
    false_share = static_cast<double>(more) / single;
    relative_rms = std::sqrt(relative_rms / used);
    offset /= used;
  }
};

class PulseEstimateOfSeeds : public testing::TestWithParam<unsigned> {};

TEST_P(PulseEstimateOfSeeds, GiveTheShapeOfADecayingPulse) {
  const TruePulse truth = decaying(2.0);
  const EstimatedPulse pulse = estimateOf(waveformsOf(truth, GetParam(), 2000));
  ASSERT_FALSE(pulse.response.isGaussian());
  EXPECT_GT(pulse.echoes, 400U);
  EXPECT_LT(largestDifference(pulse.response, truth), 2e-3);
  const Found found(pulse.response, waveformsOf(truth, GetParam() + 50, 2000));
  EXPECT_EQ(describe(pulse).find("skewness 0.5"), 0U);
  EXPECT_LE(found.false_share, 1e-3);
  EXPECT_NEAR(found.relative_rms, 1.0, 0.1);
  EXPECT_NEAR(found.offset, 0.0, 0.02);
}

TEST_P(PulseEstimateOfSeeds, KeepTheGaussianOfAGaussianPulse) {
  const TruePulse truth([](double t) { return gaussian(t, 2.0); });
  const EstimatedPulse pulse = estimateOf(waveformsOf(truth, GetParam(), 2000));
  ASSERT_TRUE(pulse.response.isGaussian());
  EXPECT_NEAR(pulse.response.width(), WaveformGenerator::digitisedWidth(2.0), 0.01);
}

TEST_P(PulseEstimateOfSeeds, GiveTheShapeFromEightBits) {
  const TruePulse truth = decaying(2.0);
  const EstimatedPulse pulse = estimateOf(waveformsOf(truth, GetParam(), 2000, 1.0 / 16.0), 255.0);
  ASSERT_FALSE(pulse.response.isGaussian());
  EXPECT_LT(largestDifference(pulse.response, truth), 3e-3);
  const Found found(pulse.response, waveformsOf(truth, GetParam() + 50, 2000, 1.0 / 16.0));
  EXPECT_LE(found.false_share, 1e-3);
  EXPECT_NEAR(found.relative_rms, 1.0, 0.1);
}

TEST_P(PulseEstimateOfSeeds, ResolveAPulseWhoseCurvatureJumps) {
  const TruePulse truth = steepPulse(2.0);
  const EstimatedPulse pulse = estimateOf(waveformsOf(truth, GetParam(), 2000));
  EXPECT_LT(largestDifference(pulse.response, truth), 5e-3);
}

INSTANTIATE_TEST_SUITE_P(Three, PulseEstimateOfSeeds, testing::Values(1U, 2U, 3U));

TEST(PulseEstimate, KeepsTheTailsOfARingingReceiver) {
  const TruePulse truth([](double t) {
    return gaussian(t, 2.0) - 0.06 * gaussian(t - 9.0, 2.0) + 0.04 * gaussian(t - 16.0, 2.5);
  });
  const EstimatedPulse pulse = estimateOf(waveformsOf(truth, 7, 2000));
  ASSERT_FALSE(pulse.response.isGaussian());
  EXPECT_LT(largestDifference(pulse.response, truth), 2e-3);
  const Found found(pulse.response, waveformsOf(truth, 57, 2000));
  EXPECT_LE(found.false_share, 1e-3);
}

TEST(PulseEstimate, ResolvesPulsesOfFewSamples) {
  const TruePulse truth = decaying(1.0);  // 2.2 samples in the full width at half maximum
  const EstimatedPulse pulse = estimateOf(waveformsOf(truth, 8, 2000));
  ASSERT_FALSE(pulse.response.isGaussian());
  // A hundredth of a sample in the time of the maximum is a difference of 0.006.
  EXPECT_LT(largestDifference(pulse.response, truth), 1e-2);
}

TEST(PulseEstimate, LeavesOutSaturatedWaveforms) {
  constexpr double kClipped = 2000.0;
  const TruePulse truth = decaying(2.0);
  Waveforms waveforms = waveformsOf(truth, 9, 3000);
  std::size_t unsaturated = 0;
  for (std::vector<double>& counts : waveforms.counts) {
    for (double& y : counts) y = std::min(y, kClipped);
    unsaturated += *std::max_element(counts.begin(), counts.end()) < kClipped ? 1 : 0;
  }
  const EstimatedPulse pulse = estimateOf(waveforms, kClipped);
  EXPECT_LE(static_cast<double>(pulse.echoes), 0.3 * static_cast<double>(unsaturated) + 1.0);
  EXPECT_LT(largestDifference(pulse.response, truth), 4e-3);
}

TEST(PulseEstimate, IsThatOfTheNarrowestEchoes) {
  // Half of the echoes are of surfaces that spread the pulse by 0.3 to 1.5 of its width.
  const TruePulse truth = decaying(2.0);
  Waveforms waveforms = waveformsOf(truth, 10, 1500);
  for (unsigned k = 0; k < 5; ++k) {
    const Waveforms wide = waveformsOf(decaying(2.0, 0.6 + 0.6 * k), 20 + k, 300);
    waveforms.counts.insert(waveforms.counts.end(), wide.counts.begin(), wide.counts.end());
  }
  EXPECT_LT(largestDifference(estimateOf(waveforms).response, truth), 5e-3);
}

TEST(PulseEstimate, NeedsEnoughEchoes) {
  const TruePulse truth = decaying(2.0);
  const TruePulse symmetric([](double t) { return gaussian(t, 2.0); });
  const EstimatedPulse pulse = estimateOf(waveformsOf(symmetric, 11, 200));
  EXPECT_TRUE(pulse.response.isGaussian());
  EXPECT_EQ(describe(pulse).find("a Gaussian: too few strong single echoes"), 0U);
  PulseEstimate estimate;
  for (const std::vector<double>& counts : waveformsOf(truth, 12, 19).counts)
    estimate.add(counts, kLargestCount);
  EXPECT_FALSE(estimate.estimate().has_value());
}

TEST(PulseResponses, OfADescriptorWithoutWaveformsAreThoseOfAnother) {
  const Waveforms waveforms = waveformsOf(decaying(2.0), 13, 1000);
  WaveformDescriptor one, two;
  one.spacing_ps = 1000;
  two.spacing_ps = 500;
  one.bits = 12;
  const WaveformRunReader read = [&](std::uint64_t first, std::size_t count, const auto& take) {
    for (std::uint64_t i = first; i < first + count; ++i) {
      Waveform waveform;
      waveform.reference.descriptor = 1;
      waveform.reference.byte_offset = 100 * i;
      waveform.descriptor = one;
      waveform.counts = waveforms.counts[i];
      take(waveform);
    }
  };
  const ResponseChoice choice = pulseResponses({{1, one}, {2, two}}, {}, 1000, read, "file");
  ASSERT_EQ(choice.estimates.size(), 1U);
  EXPECT_EQ(choice.usual, 1U);
  const PulseResponse &own = choice.by_descriptor.at(1), &other = choice.by_descriptor.at(2);
  ASSERT_FALSE(other.isGaussian());
  EXPECT_NEAR(other.width(), 2.0 * own.width(), 1e-3);
  for (double t = -3.0; t < 6.0; t += 0.5)
    EXPECT_NEAR(other.valueAt(2.0 * t), own.valueAt(t), 1e-4);
}

}  // namespace
}  // namespace pcl_als
