// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// Emitted pulse, footprint, receiver, digitizer and detector, against values computed by hand.
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/simulation/simulated_waveforms.h>

#include "emitted_pulse.h"
#include "footprint_tracer.h"
#include "return_detector.h"
#include "waveform_receiver.h"

namespace {

using namespace pcl_als::simulation;
using pcl_als::kPi;
using pcl_als::UsageError;

constexpr double kFwhm = 4.0, kSigma = 1.698644;  // ns: 4 / 2.354820

WaveformOptions noiseless() {
  WaveformOptions options;
  options.noise = 0.0;
  return options;
}

struct Recorded {
  double first = 0.0;  ///< ns
  std::vector<std::uint16_t> counts;

  int at(double time, double spacing = 1.0) const {
    return counts[static_cast<std::size_t>(std::lround((time - first) / spacing))];
  }
  /// Sum, centre and variance of the samples above a baseline; ns.
  Eigen::Vector3d moments(double baseline, double spacing = 1.0) const {
    double sum = 0.0, first_moment = 0.0, second_moment = 0.0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const double value = counts[i] - baseline, t = static_cast<double>(i) * spacing;
      sum += value;
      first_moment += value * t;
      second_moment += value * t * t;
    }
    const double mean = first_moment / sum;
    return {sum * spacing, first + mean, second_moment / sum - mean * mean};
  }
};

Recorded recorded(const WaveformOptions& options, const std::vector<ReceivedPower>& power,
                  std::uint64_t seed = 1) {
  WaveformReceiver receiver(options);
  Random random(seed);
  Recorded result;
  result.first = receiver.record(power, random, result.counts);
  return result;
}

TEST(EmittedPulse, IsAGaussian) {
  const EmittedPulse pulse(noiseless());
  EXPECT_NEAR(pulse.at(0.0), 1.0, 1e-9);
  EXPECT_NEAR(pulse.at(kSigma), std::exp(-0.5), 1e-5);
  EXPECT_NEAR(pulse.at(-kSigma), std::exp(-0.5), 1e-5);
  EXPECT_NEAR(pulse.leading(0.5), -2.0, 1e-4);
  EXPECT_NEAR(pulse.trailing(0.5), 2.0, 1e-4);
  EXPECT_NEAR(pulse.area(), kSigma * std::sqrt(2.0 * kPi), 1e-4);
  EXPECT_EQ(pulse.at(-1.01 * pulse.before()), 0.0);
  EXPECT_EQ(pulse.at(1.01 * pulse.after()), 0.0);
}

TEST(EmittedPulse, HasTheSkewness) {
  WaveformOptions options = noiseless();
  options.pulse_skewness = 0.8;
  const EmittedPulse pulse(options);
  double sum = 0.0, mean = 0.0;
  const double step = 0.01;
  for (double t = -pulse.before(); t < pulse.after(); t += step) {
    sum += pulse.at(t);
    mean += t * pulse.at(t);
  }
  mean /= sum;
  double second = 0.0, third = 0.0;
  for (double t = -pulse.before(); t < pulse.after(); t += step) {
    second += pulse.at(t) * (t - mean) * (t - mean) / sum;
    third += pulse.at(t) * std::pow(t - mean, 3) / sum;
  }
  EXPECT_NEAR(third / std::pow(second, 1.5), 0.8, 0.002);
  EXPECT_NEAR(pulse.width(), kFwhm, 1e-3);
  EXPECT_NEAR(pulse.at(0.0), 1.0, 1e-5);
  EXPECT_GT(mean, 0.1);  // the tail is behind
}

TEST(EmittedPulse, GoesThroughItsSamples) {
  WaveformOptions options = noiseless();
  options.pulse = {0.0, 1.0, 2.0, 1.0, 0.0};
  options.pulse_spacing = 3.0;
  const EmittedPulse pulse(options);
  EXPECT_NEAR(pulse.at(0.0), 1.0, 1e-6);
  EXPECT_NEAR(pulse.at(3.0), 0.5, 1e-6);
  EXPECT_NEAR(pulse.at(-3.0), 0.5, 1e-6);
  EXPECT_NEAR(pulse.at(6.0), 0.0, 1e-6);
  EXPECT_NEAR(pulse.at(-1.5), 0.8125, 1e-6);  // (-0 + 9 + 18 - 1) / 16 / 2
}

TEST(WaveformOptions, AreChecked) {
  WaveformOptions options;
  EXPECT_NO_THROW(options.check());
  options.bits = 17;
  EXPECT_THROW(options.check(), UsageError);
  options = {};
  options.sample_spacing = 0.504;
  EXPECT_NO_THROW(options.check());
  options.sample_spacing = 0.5043;
  EXPECT_THROW(options.check(), UsageError);
  options = {};
  options.pulse = {0.0, 1.0, 2.0, 3.0, 4.0};
  EXPECT_THROW(options.check(), UsageError);
}

Scene plane() {
  SceneOptions options;
  options.relief = options.buildings = options.trees = 0.0;
  return {Eigen::Vector2d::Constant(-900.0), Eigen::Vector2d::Constant(900.0), options, 1};
}

TEST(FootprintTracer, HasTheMomentsOfAGaussianBeam) {
  const Scene scene = plane();
  const ScannerOptions scanner;
  for (const int rings : {1, 2, 4, 7}) {
    const FootprintTracer tracer(scene, scanner, rings);
    const auto& rays = tracer.subRays();
    ASSERT_EQ(rays.size(), static_cast<std::size_t>(3 * rings * rings));
    Eigen::Matrix2d moments = Eigen::Matrix2d::Zero();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& ray : rays) {
      mean += ray / static_cast<double>(rays.size());
      moments += ray * ray.transpose() / static_cast<double>(rays.size());
    }
    EXPECT_NEAR(mean.norm(), 0.0, 1e-12);
    EXPECT_NEAR((moments - Eigen::Matrix2d::Identity()).norm(), 0.0, 1e-12);
  }
}

std::vector<ReceivedPower> powerOf(const std::vector<Backscatter>& parts, double number) {
  std::vector<ReceivedPower> power;
  for (const Backscatter& part : parts)
    power.push_back({2.0 * part.range / kLightSpeed, number * part.share});
  return power;
}

TEST(WaveformReceiver, RecordsAPlaneAcrossTheBeam) {
  const Scene scene = plane();
  ScannerOptions scanner;
  FootprintTracer tracer(scene, scanner, 4);
  const auto parts = tracer.trace({0.0, 0.0, 540.0}, {0.0, 0.0, -1.0});
  ASSERT_EQ(parts.size(), 48U);
  double share = 0.0;
  for (const Backscatter& part : parts) share += part.share;
  EXPECT_NEAR(share, 1.0, 1e-12);
  WaveformOptions options = noiseless();
  options.bits = 16;
  options.baseline = 0.0;
  const Recorded wave = recorded(options, powerOf(parts, 8192.0));
  ASSERT_EQ(wave.counts.size(), 64U);
  // A quarter of 65535 counts; the time of 540 m is 3602.492 ns.
  const Eigen::Vector3d moments = wave.moments(0.0);
  EXPECT_NEAR(moments[0], 16383.75 * kSigma * std::sqrt(2.0 * kPi), 5.0);
  EXPECT_NEAR(moments[1], 3602.492, 0.002);
  EXPECT_NEAR(moments[2], kSigma * kSigma, 0.005);
  const double phase = 3602.492 - 3602.0;
  EXPECT_NEAR(wave.at(3602.0), 16383.75 * std::exp(-0.5 * std::pow(phase / kSigma, 2)), 3.0);
}

/// A beam of 1 mrad (standard deviation) that meets a plane at an incidence of 30 degrees in 1000
/// m: its footprint has a standard deviation of 1 m, the time 2 tan(30 deg) / c = 3.8516 ns.
TEST(WaveformReceiver, StretchesAnEchoOfASlope) {
  const Scene scene = plane();
  ScannerOptions scanner;
  scanner.divergence = 4e-3;
  FootprintTracer tracer(scene, scanner, 12);
  const double incidence = kPi / 6.0;
  const Eigen::Vector3d beam(std::sin(incidence), 0.0, -std::cos(incidence));
  const auto parts = tracer.trace(-1000.0 * beam, beam);
  WaveformOptions options = noiseless();
  options.bits = 16;
  options.baseline = 0.0;
  const Recorded wave = recorded(options, powerOf(parts, 16384.0));
  const Eigen::Vector3d moments = wave.moments(0.0);
  EXPECT_NEAR(moments[1], 2000.0 / kLightSpeed, 0.05);
  EXPECT_NEAR(std::sqrt(moments[2] - kSigma * kSigma), 3.8516, 0.03);
  EXPECT_NEAR(moments[0], 32767.5 * kSigma * std::sqrt(2.0 * kPi), 100.0);  // the energy is kept
}

TEST(WaveformReceiver, Quantises) {
  WaveformOptions options = noiseless();
  options.bits = 4;
  options.baseline = 0.2;  // 3 of 15 counts
  // 15 * 16500 / 32768 = 7.553 counts above the baseline.
  const Recorded wave = recorded(options, {{100.0, 16500.0}});
  EXPECT_EQ(wave.at(100.0), 11);  // 10.55
  EXPECT_EQ(wave.at(99.0), 9);    // 3 + 7.553 * 0.841 = 9.35
  EXPECT_EQ(wave.at(102.0), 7);   // 3 + 7.553 * 0.5 = 6.78
  EXPECT_EQ(wave.at(106.0), 3);   // 3 + 7.553 * 0.002
  EXPECT_EQ(wave.counts.front(), 3);
}

TEST(WaveformReceiver, Saturates) {
  // Twice the full scale: 4013.1 counts of 8190 are reached at 0.49 of the maximum, up to 2.03 ns
  // from it.
  const Recorded wave = recorded(noiseless(), {{100.0, 65536.0}});
  const auto saturated = std::count(wave.counts.begin(), wave.counts.end(), 4095);
  EXPECT_EQ(saturated, 5);
  EXPECT_EQ(wave.at(97.0), std::lround(81.9 + 8190.0 * std::exp(-0.5 * 9.0 / (kSigma * kSigma))));
}

TEST(WaveformReceiver, HasNoiseAndChoosesTheLength) {
  WaveformOptions options;
  options.noise = 0.01;
  options.baseline = 0.1;
  double square = 0.0;
  int samples = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Recorded wave = recorded(options, {{100.0, 1e-9}}, seed);
    for (const std::uint16_t count : wave.counts) {
      square += std::pow(count - 409.5, 2);
      ++samples;
    }
  }
  EXPECT_NEAR(std::sqrt(square / samples), std::sqrt(40.95 * 40.95 + 1.0 / 12.0), 0.8);
  EXPECT_NEAR(WaveformReceiver(options).noise(), 40.951, 0.001);
  EXPECT_EQ(recorded(options, {{100.0, 1.0}, {150.0, 1.0}}).counts.size(), 128U);
  EXPECT_EQ(recorded(options, {{100.0, 1.0}, {90000.0, 1.0}}).counts.size(), 4096U);
  // Samples are at multiples of their spacing after the emission.
  options.sample_spacing = 0.7;
  const double first = recorded(options, {{100.3, 1.0}}).first / 0.7;
  EXPECT_NEAR(first, std::round(first), 1e-9);
}

std::vector<DetectedReturn> detected(const WaveformOptions& options, const Recorded& wave) {
  const WaveformReceiver receiver(options);
  ReturnDetector detector(receiver, 1.5, 5);
  return detector.detect(wave.counts.data(), wave.counts.size());
}

TEST(ReturnDetector, TimesEchoes) {
  const WaveformOptions options = noiseless();
  const Recorded wave = recorded(options, {{100.3, 8192.0}, {125.6, 4096.0}});
  const auto returns = detected(options, wave);
  ASSERT_EQ(returns.size(), 2U);
  EXPECT_NEAR(wave.first + returns[0].time, 100.3, 0.02);
  EXPECT_NEAR(wave.first + returns[1].time, 125.6, 0.02);
  EXPECT_NEAR(returns[0].height, 1023.75, 10.0);
  EXPECT_NEAR(returns[1].height, 511.9, 6.0);
}

TEST(ReturnDetector, IsBlindBehindAReturn) {
  const WaveformOptions options = noiseless();
  // 1.5 m are 10.007 ns.
  EXPECT_EQ(detected(options, recorded(options, {{100.0, 8192.0}, {109.5, 8192.0}})).size(), 1U);
  EXPECT_EQ(detected(options, recorded(options, {{100.0, 8192.0}, {110.5, 8192.0}})).size(), 2U);
}

TEST(ReturnDetector, HasAThreshold) {
  WaveformOptions options = noiseless();
  const Recorded weak = recorded(options, {{100.0, 7.5 * 4.0}}),
                 strong = recorded(options, {{100.0, 8.5 * 40.0}});
  // 32768 digital numbers are 4095 counts: echoes of 3.75 and 42.5 counts.
  options.noise = 0.001;  // of the detector only: 8 sqrt(4.095^2 + 1/12) = 32.8 counts
  EXPECT_EQ(detected(options, weak).size(), 0U);
  EXPECT_EQ(detected(options, strong).size(), 1U);
}

TEST(ReturnDetector, IsTooEarlyOnStretchedEchoes) {
  WaveformOptions options = noiseless();
  options.sample_spacing = 0.25;
  options.bits = 16;
  // The pulse over a plane that spreads it by 1.2 ns: its standard deviation becomes 2.0798 ns, and
  // its edge at half the height lies 1.17741 (2.0798 - 1.6986) = 0.4488 ns earlier.
  std::vector<ReceivedPower> power;
  for (double t = -5.0; t <= 5.0; t += 0.05)
    power.push_back({200.0 + 1.2 * t, 600.0 * std::exp(-0.5 * t * t)});
  const Recorded wave = recorded(options, power);
  const auto returns = detected(options, wave);
  ASSERT_EQ(returns.size(), 1U);
  EXPECT_NEAR(wave.first + returns[0].time, 200.0 - 0.4488, 0.005);
}

}  // namespace
