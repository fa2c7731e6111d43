// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/pulse_echoes.h>
#include <pcl_als/waveform/waveform_provider.h>

namespace pcl_als {
namespace {

constexpr double kResponseWidth = 2.0;  // of the response, samples of 1 ns

/// Echoes of amplitudes and times (samples) on a baseline of 100, with small changes of sign.
Waveform waveformWith(const std::vector<std::pair<double, double>>& echoes) {
  Waveform waveform;
  waveform.reference.descriptor = 1;
  waveform.descriptor.bits = 16;
  waveform.descriptor.samples = 64;
  waveform.descriptor.spacing_ps = 1000;
  for (int i = 0; i < 64; ++i) {
    double count = 100.0 + 0.4 * ((i * 7) % 5 - 2);
    for (const auto& [amplitude, time] : echoes)
      count += amplitude * std::exp(-0.5 * std::pow((i - time) / kResponseWidth, 2));
    waveform.counts.push_back(count);
  }
  return waveform;
}

class Echoes : public testing::Test {
 protected:
  Echoes() { settings_.pulse_width_ns = kFwhmOfGaussian * kResponseWidth; }
  const EchoSettings& settings() const { return settings_; }

  EchoSettings settings_;
  std::map<unsigned, PulseResponse> responses_{{1, PulseResponse::gaussian(kResponseWidth)}};
};

TEST_F(Echoes, BelongToReturnsWithinTheWidthOfTheResponse) {
  PulseEchoes echoes(responses_, settings());
  // The width is 4.71 ns: the first return is 1.5 ns behind its echo, the second 5 ns.
  echoes.decompose(waveformWith({{400.0, 20.0}, {100.0, 40.0}}), {21500.0, 45000.0});
  ASSERT_EQ(echoes.count(), 2);
  EXPECT_EQ(echoes.echoOf(0), 0);
  EXPECT_EQ(echoes.echoOf(1), -1);
  EXPECT_EQ(echoes.returnOf(0), 0);
  EXPECT_EQ(echoes.returnOf(1), -1);
  EXPECT_NEAR(echoes.timeOf(0), 20000.0, 10.0);
  EXPECT_EQ(echoes.nearestReturn(1), 1U);
  EXPECT_EQ(echoes.intensityRatio(1), 0.0);  // no echo belongs to the second return
}

TEST_F(Echoes, GoToTheNearestOfSeveralReturns) {
  PulseEchoes echoes(responses_, settings());
  echoes.decompose(waveformWith({{400.0, 20.0}, {100.0, 40.0}}), {19000.0, 20500.0});
  ASSERT_EQ(echoes.count(), 2);
  EXPECT_EQ(echoes.echoOf(0), -1);
  EXPECT_EQ(echoes.echoOf(1), 0);
  EXPECT_EQ(echoes.nearestReturn(1), 1U);
  EXPECT_NEAR(echoes.intensityRatio(1), 0.25, 0.01);
}

TEST_F(Echoes, FormTheNearestPairFirst) {
  PulseEchoes echoes(responses_, settings());
  // The first return lies between both echoes, 4 ns from either; the second one is on the first.
  echoes.decompose(waveformWith({{400.0, 20.0}, {300.0, 28.1}}), {24000.0, 20000.0});
  ASSERT_EQ(echoes.count(), 2);
  EXPECT_EQ(echoes.echoOf(1), 0);
  EXPECT_EQ(echoes.echoOf(0), 1);
}

TEST_F(Echoes, HaveAttributesInUnitsOfFiles) {
  PulseEchoes echoes(responses_, settings());
  echoes.decompose(waveformWith({{400.0, 20.0}, {100.0, 40.0}}), {20000.0});
  ASSERT_EQ(echoes.count(), 2);
  const double speed = 1.5e-4;  // m / ps
  const EchoAttributes first = echoes.attributesOf(0, speed),
                       second = echoes.attributesOf(1, speed);
  EXPECT_TRUE(first.hasEcho());
  EXPECT_FALSE(first.new_echo);
  EXPECT_TRUE(second.new_echo);
  EXPECT_NEAR(first.amplitude, 400.0, 1.0);
  EXPECT_NEAR(first.echo_width, 4.7096, 0.02);  // 2.3548 * 2 ns
  EXPECT_FLOAT_EQ(first.range_std,
                  static_cast<float>(echoes.found().echo[0].time_std * 1000.0 * speed));
  EXPECT_EQ(first.saturated, 0);
  EXPECT_FALSE(EchoAttributes().hasEcho());
}

TEST(NumbersByTime, CountFromTheFirst) {
  EXPECT_EQ(numbersByTime({30.0, 10.0, 20.0}), (std::vector<unsigned>{3, 1, 2}));
  EXPECT_EQ(numbersByTime({5.0, 5.0}), (std::vector<unsigned>{1, 2}));
}

TEST(PacketMemory, KnowsWhatItMet) {
  PacketMemory memory;
  EXPECT_FALSE(memory.meets(60));
  EXPECT_FALSE(memory.meets(124));
  EXPECT_TRUE(memory.meets(60));
}

TEST(EchoSettings, AreConvertedToSamples) {
  EchoSettings settings;
  settings.ringing_reach_ns = 30.0;
  WaveformDescriptor descriptor;
  descriptor.bits = 12;
  descriptor.spacing_ps = 500;
  EXPECT_DOUBLE_EQ(settings.decompositionOf(descriptor).ringing_reach, 60.0);
  EXPECT_DOUBLE_EQ(settings.decompositionOf(descriptor).saturation, 4095.0);
  settings.saturation = 1000.0;
  EXPECT_DOUBLE_EQ(settings.decompositionOf(descriptor).saturation, 1000.0);
  settings.pulse_width_ns = 4.0;
  EXPECT_NO_THROW(settings.check());
  settings.pulse = {0.0, 1.0, 3.0, 1.0, 0.0};
  settings.pulse_spacing_ns = 1.0;
  EXPECT_THROW(settings.check(), UsageError);
}

TEST(PulseResponses, HaveTheGivenWidthInSamples) {
  EchoSettings settings;
  settings.pulse_width_ns = 4.7096400900618985;
  WaveformDescriptor one, two;
  two.spacing_ps = 500;
  const auto responses =
      pulseResponses({{1, one}, {2, two}}, settings, 0, {}, "file").by_descriptor;
  EXPECT_NEAR(responses.at(1).width(), 2.0, 1e-12);
  EXPECT_NEAR(responses.at(2).width(), 4.0, 1e-12);
}

TEST(MemoryWaveforms, RefuseWhatTheyDoNotHave) {
  MemoryWaveforms waveforms(2);
  WaveformDescriptor descriptor;
  descriptor.samples = 3;
  EXPECT_THROW(waveforms.setDescriptor(0, descriptor), UsageError);
  EXPECT_THROW(waveforms.addWaveform(1, {1.0, 2.0, 3.0}), UsageError);
  waveforms.setDescriptor(1, descriptor);
  EXPECT_THROW(waveforms.addWaveform(1, {1.0}), UsageError);
  const std::uint64_t pulse = waveforms.addWaveform(1, {1.0, 2.0, 3.0});
  EXPECT_THROW(waveforms.assign(2, pulse, 0.0F, {0, 0, 1.5e-4F}), UsageError);
  EXPECT_THROW(waveforms.assign(0, 7, 0.0F, {0, 0, 1.5e-4F}), UsageError);
  waveforms.assign(1, pulse, 1000.0F, {0, 0, 1.5e-4F});
  Waveform read;
  EXPECT_FALSE(waveforms.access()->read(0, read));
  ASSERT_TRUE(waveforms.access()->read(1, read));
  EXPECT_EQ(read.counts, (std::vector<double>{1.0, 2.0, 3.0}));
  EXPECT_EQ(read.reference.location_ps, 1000.0F);
}

}  // namespace
}  // namespace pcl_als
