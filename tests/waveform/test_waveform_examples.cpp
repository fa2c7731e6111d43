// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/waveform/waveform_examples.h>
#include <pcl_als/waveform/waveform_reader.h>

namespace pcl_als {
namespace {

constexpr double kWidthOfPulse = 2.0;  // samples of 0.5 ns

Waveform waveformOf(const std::vector<double>& counts) {
  Waveform waveform;
  waveform.reference.descriptor = 3;
  waveform.descriptor.bits = 8;
  waveform.descriptor.samples = static_cast<std::uint32_t>(counts.size());
  waveform.descriptor.spacing_ps = 500;
  waveform.counts = counts;
  return waveform;
}

std::vector<double> echoAt(double time, double amplitude) {
  std::vector<double> counts;
  for (int i = 0; i < 48; ++i)
    counts.push_back(20.0 + 0.5 * ((i * 7) % 5 - 2) +
                     amplitude * std::exp(-0.5 * std::pow((i - time) / kWidthOfPulse, 2)));
  return counts;
}

class ExampleOfAWaveform : public testing::Test {
 protected:
  ExampleOfAWaveform() {
    settings_.pulse_width_ns = 0.5 * kFwhmOfGaussian * kWidthOfPulse;
    echoes_ = std::make_unique<PulseEchoes>(responses_, settings_);
  }
  WaveformExample example(const Waveform& waveform, const std::vector<double>& returns = {}) {
    echoes_->decompose(waveform, returns);
    return echoes_->example(17);
  }

  EchoSettings settings_;
  std::map<unsigned, PulseResponse> responses_{{3, PulseResponse::gaussian(kWidthOfPulse)}};
  std::unique_ptr<PulseEchoes> echoes_;
};

TEST_F(ExampleOfAWaveform, HasEchoesInNanosecondsAndTheAdjustedWaveform) {
  const WaveformExample example = this->example(waveformOf(echoAt(20.3, 100.0)), {11000.0});
  ASSERT_EQ(example.echoes.size(), 1U);
  EXPECT_EQ(example.number, 17U);
  EXPECT_EQ(example.descriptor, 3U);
  const WaveformExample::Echo& echo = example.echoes[0];
  EXPECT_NEAR(echo.time, 10.15, 0.02);  // 20.3 samples
  EXPECT_NEAR(echo.amplitude, 100.0, 1.0);
  EXPECT_NEAR(echo.width, 2.355, 0.03);
  EXPECT_FALSE(echo.new_echo);
  ASSERT_EQ(example.returns.size(), 1U);
  EXPECT_EQ(example.returns[0], 11.0);
  // Four values for each of 47 samples, and the last one; by hand at 20.25 samples and at both
  // ends.
  ASSERT_EQ(example.model.size(), 189U);
  const double by_hand =
      example.baseline +
      echo.amplitude *
          std::exp(-0.5 * std::pow((10.125 - echo.time) * kFwhmOfGaussian / echo.width, 2));
  EXPECT_NEAR(example.model[81], by_hand, 1e-6 * by_hand);
  EXPECT_EQ(example.model.front(), example.baseline);
  EXPECT_EQ(example.model.back(), example.baseline);
  EXPECT_NEAR(example.residual(20), example.samples[20] - example.model[80], 1e-12);
  EXPECT_GT(example.noise, 0.5);
  EXPECT_LT(example.largest_residual, 2.0);
}

TEST_F(ExampleOfAWaveform, SaturatedSamplesAreNoResiduals) {
  std::vector<double> counts = echoAt(20.3, 400.0);
  for (double& count : counts) count = std::min(count, 255.0);
  const WaveformExample example = this->example(waveformOf(counts));
  ASSERT_EQ(example.echoes.size(), 1U);
  EXPECT_TRUE(example.echoes[0].new_echo);
  EXPECT_LT(example.residual(20), -50.0);
  EXPECT_LT(example.largest_residual, 3.0);
}

WaveformExample madeExample(std::uint64_t number, std::size_t echoes, double residual) {
  WaveformExample example;
  example.number = number;
  example.echoes.resize(echoes);
  example.largest_residual = residual;
  return example;
}

TEST(WaveformExamples, AreOfAllNumbersOfEchoesAndTheLargestResiduals) {
  std::vector<WaveformExample> all;
  for (std::uint64_t i = 0; i < 700; ++i)
    all.push_back(madeExample(i, i % 7, 1.0 + 1e-3 * static_cast<double>((i * 31) % 700)));
  all[100].largest_residual = 9.0;
  all[413].largest_residual = 8.0;
  WaveformExamples forward, backward;
  for (const WaveformExample& example : all) forward.offer(example);
  for (auto example = all.rbegin(); example != all.rend(); ++example) backward.offer(*example);
  const std::vector<WaveformExample> chosen = forward.chosen(), other = backward.chosen();
  ASSERT_EQ(chosen.size(), 14U);
  ASSERT_EQ(other.size(), 14U);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    EXPECT_EQ(chosen[i].number, other[i].number);
    EXPECT_EQ(std::min<std::size_t>(chosen[i].echoes.size(), 5),
              i < 12 ? i / 2 : (i == 12 ? 2 : 0));
  }
  EXPECT_EQ(chosen[12].number, 100U);
  EXPECT_EQ(chosen[13].number, 413U);
  // Not the first ones of the file.
  EXPECT_TRUE(std::any_of(chosen.begin(), chosen.end() - 2,
                          [](const WaveformExample& example) { return example.number > 350; }));
}

TEST(WaveformExamples, AWaveformIsChosenOnce) {
  WaveformExamples examples;
  examples.offer(madeExample(5, 1, 3.0));
  EXPECT_EQ(examples.chosen().size(), 1U);
  EXPECT_TRUE(WaveformExamples().chosen().empty());
}

}  // namespace
}  // namespace pcl_als
