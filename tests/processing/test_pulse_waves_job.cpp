// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/waveform_job.h>

#include "pulse_waves_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::PulseWavesBytes;
using test::SimulatedPulses;

/// The points that were written.
struct Output {
  LasFile las;
  std::vector<std::byte> records;

  explicit Output(const fs::path& path) : las(path) {
    records.resize(las.header().point_count * las.header().record_length);
    las.readRecords(0, las.header().point_count, records.data());
  }
  const std::byte* record(std::size_t i) const { return &records[i * las.header().record_length]; }
  std::vector<double> column(const std::string& name) const {
    std::vector<double> values;
    decodeLasExtraField(records.data(), las.header().point_count, las.header().record_length,
                        *findLasExtraField(las.extraFields(), name, "output"), values);
    return values;
  }
  Eigen::Vector3d position(std::size_t i) const {
    return LasRecordLayout::positionOf(record(i), las.header().scale, las.header().offset);
  }
};

/// Where an echo of pulse i lies.
Eigen::Vector3d placeOf(std::size_t i, const test::PulseEcho& echo) {
  const double along = SimulatedPulses::metresAlong(echo.time);
  return {500000.0 + 0.5 * static_cast<double>(i) + along * SimulatedPulses::directionX(),
          5400000.0, 1000.0 + along * SimulatedPulses::directionZ()};
}

TEST(PulseWavesJob, WritesEchoesAsPoints) {
  for (const char* name : {"out.las", "out.laz"}) {
    const fs::path folder = test::scratch("pulse_waves_job");
    SimulatedPulses simulated;
    simulated.bytes.vlrs = {
        PulseWavesBytes::vlr(2112, "LOCAL_CS[\"here\",UNIT[\"metre\",1]]", "PulseWaves_Proj")};
    simulated.make().write(folder / "in.pls");
    const WaveformResult result = decomposeWaveforms(folder / "in.pls", folder / name);
    EXPECT_EQ(result.counts.pulses, 200U);
    EXPECT_EQ(result.counts.waveforms, 267U);
    EXPECT_EQ(result.counts.echoes, 334U);
    EXPECT_EQ(result.counts.without_waveform, 0U);
    const Output out(folder / name);
    ASSERT_EQ(out.las.header().point_count, 334U);
    EXPECT_EQ(out.las.header().point_format, 6);
    EXPECT_EQ(out.las.header().file_source_id, 7);
    EXPECT_NE(out.las.crs().find("here"), std::string::npos);
    const auto amplitude = out.column("amplitude"), range_std = out.column("range_std");
    const auto is_new = out.column("new_echo"), channel = out.column("channel");
    std::size_t at = 0;
    double square = 0.0;
    for (std::size_t i = 0; i < simulated.echoes.size(); ++i)
      for (std::size_t e = 0; e < simulated.echoes[i].size(); ++e, ++at) {
        const std::byte* record = out.record(at);
        const double error = (out.position(at) - placeOf(i, simulated.echoes[i][e])).norm();
        EXPECT_LT(error, 6.0 * range_std[at] + 0.002);
        square += std::pow(error / std::hypot(range_std[at], 0.0005), 2);
        EXPECT_NEAR(amplitude[at], simulated.echoes[i][e].amplitude, 20.0);
        EXPECT_EQ(is_new[at], 1.0);
        EXPECT_EQ(channel[at], 0.0);
        EXPECT_EQ(out.las.layout().returnNumberOf(record), e + 1);
        EXPECT_EQ(out.las.layout().numberOfReturnsOf(record), simulated.echoes[i].size());
        EXPECT_EQ(out.las.layout().sourceOf(record), 7U);
        EXPECT_EQ(out.las.layout().classOf(record), 1U);
        EXPECT_EQ(out.las.layout().scanDirectionOf(record), i % 2 == 0);
        EXPECT_EQ((record[15] & std::byte{0x80}) != std::byte{0}, i % 2 == 1);
        EXPECT_NEAR(out.las.layout().timeOf(record), 230038.25 + 1e-5 * static_cast<double>(i),
                    1e-7);
        EXPECT_EQ(LasRecordLayout::intensityOf(record), std::lround(amplitude[at]));
      }
    EXPECT_NEAR(std::sqrt(square / 334.0), 1.0, 0.15);  // range_std holds
  }
}

TEST(PulseWavesJob, TakesTheResponseFromEmittedPulses) {
  const fs::path folder = test::scratch("pulse_waves_response");
  SimulatedPulses simulated;
  simulated.shape = [](double t) {
    const double width = t < 0.0 ? 1.5 : 3.0;
    return std::exp(-0.5 * t * t / (width * width));
  };
  simulated.make().write(folder / "in.pls");
  const WaveformResult by_emitted = decomposeWaveforms(folder / "in.pls", folder / "emitted.las");
  EXPECT_EQ(by_emitted.counts.echoes, 334U);
  EXPECT_NE(by_emitted.pulses.at(0).origin.find(" emitted pulses"), std::string::npos);
  EXPECT_NEAR(by_emitted.pulses.at(0).width_ns, 4.5 * std::sqrt(2.0 * std::log(2.0)), 0.15);
  WaveformSettings gaussian;
  gaussian.pulse_width_ns = by_emitted.pulses.at(0).width_ns;
  const WaveformResult by_width =
      decomposeWaveforms(folder / "in.pls", folder / "gaussian.las", gaussian);
  EXPECT_GT(by_width.counts.echoes, 345U);  // tails are taken for echoes
}

/// Errors of the points of a file with jitter along the pulse, over their standard deviations, and
/// in metres.
std::pair<double, double> errorsOf(const SimulatedPulses& simulated, const fs::path& path) {
  const Output out(path);
  const auto range_std = out.column("range_std");
  double relative = 0.0, absolute = 0.0;
  std::size_t at = 0;
  for (std::size_t i = 0; i < simulated.echoes.size(); ++i)
    for (const test::PulseEcho& echo : simulated.echoes[i]) {
      const double error = (out.position(at) - placeOf(i, echo)).norm();
      relative += std::pow(error / std::hypot(range_std[at++], 0.0005), 2);
      absolute += error * error;
    }
  const auto count = static_cast<double>(at);
  return {std::sqrt(relative / count), std::sqrt(absolute / count)};
}

TEST(PulseWavesJob, CountsTimesFromEmittedPulses) {
  const fs::path folder = test::scratch("pulse_waves_jitter");
  SimulatedPulses simulated;
  simulated.jitter = 0.5;
  WaveformSettings settings;
  // Where the begin of the emitted samples is stated: by default.
  simulated.state_emitted = true;
  simulated.make().write(folder / "stated.pls");
  decomposeWaveforms(folder / "stated.pls", folder / "stated.las", settings);
  EXPECT_NEAR(errorsOf(simulated, folder / "stated.las").first, 1.0, 0.15);
  settings.range_from = RangeOrigin::anchor;
  decomposeWaveforms(folder / "stated.pls", folder / "anchor.las", settings);
  EXPECT_NEAR(errorsOf(simulated, folder / "anchor.las").second, 0.15 / std::sqrt(12.0), 0.005);
  // Where it is not: if that is asked for, as deviations from the mean.
  simulated.state_emitted = false;
  simulated.make().write(folder / "other.pls");
  settings.range_from = RangeOrigin::emitted;
  decomposeWaveforms(folder / "other.pls", folder / "other.las", settings);
  EXPECT_LT(errorsOf(simulated, folder / "other.las").second, 0.012);
  settings.range_from = RangeOrigin::automatic;
  decomposeWaveforms(folder / "other.pls", folder / "other.las", settings);
  EXPECT_GT(errorsOf(simulated, folder / "other.las").second, 0.035);
}

/// A pulse whose second channel, of an eighth of the gain, has one of the two echoes.
PulseWavesBytes twoChannels(SimulatedPulses& simulated, double amplitude) {
  PulseWavesBytes::Sampling low;
  low.bits = 8;
  low.duration_bits = 32;
  low.duration_offset = 4000.0F;
  PulseWavesBytes::Sampling high = low;
  high.channel = 1;
  PulseWavesBytes file;
  file.descriptors = {{low, high}};
  PulseWavesBytes::Pulse p;
  p.target[2] = -150000;
  const auto waveform = [&](double gain, int samples) {
    std::vector<unsigned> counts;
    for (const unsigned count :
         simulated.counts({{amplitude, 4030.0}, {80.0, 4070.0}}, 4000.0, samples))
      counts.push_back(static_cast<unsigned>(
          std::min(255.0, 10.0 + gain * std::max(0.0, count - SimulatedPulses::kBaseline + 8.0))));
    return counts;
  };
  p.samplings = {{{0, waveform(1.0, 100)}}, {{0, waveform(0.125, 60)}}};
  p.first = 4000;
  p.last = 4099;
  file.pulses = {p};
  return file;
}

TEST(PulseWavesJob, PrefersChannelsWithoutSaturation) {
  const fs::path folder = test::scratch("pulse_waves_channels");
  SimulatedPulses simulated;
  WaveformSettings settings;
  settings.pulse_width_ns = 4.8;
  twoChannels(simulated, 1500.0).write(folder / "strong.pls");
  decomposeWaveforms(folder / "strong.pls", folder / "strong.las", settings);
  const Output strong(folder / "strong.las");
  ASSERT_EQ(strong.las.header().point_count, 2U);  // each of the channel that has it best
  EXPECT_EQ(strong.column("channel"), std::vector<double>({1.0, 0.0}));
  EXPECT_EQ(strong.column("number_of_samples_saturated"), std::vector<double>({0.0, 0.0}));
  EXPECT_NEAR(strong.position(0).z(), 1000.0 - 0.15 * 4030.0, 0.05);
  EXPECT_NEAR(strong.position(1).z(), 1000.0 - 0.15 * 4070.0, 0.05);

  twoChannels(simulated, 150.0).write(folder / "weak.pls");
  decomposeWaveforms(folder / "weak.pls", folder / "weak.las", settings);
  EXPECT_EQ(Output(folder / "weak.las").column("channel"), std::vector<double>({0.0, 0.0}));
}

TEST(PulseWavesJob, ResultDoesNotDependOnThreads) {
  const fs::path folder = test::scratch("pulse_waves_threads");
  SimulatedPulses().make().write(folder / "in.pls");
  for (const int threads : {1, 3}) {
    WaveformSettings settings;
    settings.threads = threads;
    decomposeWaveforms(folder / "in.pls", folder / (std::to_string(threads) + ".las"), settings);
  }
  EXPECT_EQ(test::readBytes(folder / "1.las"), test::readBytes(folder / "3.las"));
}

TEST(PulseWavesJob, RefusesWhatNeedsReturns) {
  const fs::path folder = test::scratch("pulse_waves_refused");
  SimulatedPulses().make().write(folder / "in.pls");
  const auto refused = [&](const WaveformSettings& settings) {
    return test::messageOf<UsageError>(
        [&] { decomposeWaveforms(folder / "in.pls", folder / "x.las", settings); });
  };
  WaveformSettings settings;
  settings.new_echoes = false;
  EXPECT_NE(refused(settings).find("pulses and no returns"), std::string::npos);
  settings = {};
  settings.move_returns = true;
  EXPECT_NE(refused(settings).find("pulses and no returns"), std::string::npos);

  SimulatedPulses damaged;
  damaged.make();
  damaged.bytes.pulses[150].offset = 1 << 30;
  damaged.bytes.write(folder / "in.pls");
  EXPECT_NE(test::messageOf<InputError>([&] {
              decomposeWaveforms(folder / "in.pls", folder / "x.las");
            }).find("pulse 150: its waves at byte 1073741824 reach past the end"),
            std::string::npos);
  damaged.bytes.descriptors[0].pop_back();
  damaged.bytes.write(folder / "in.pls");
  EXPECT_NE(test::messageOf<InputError>([&] {
              decomposeWaveforms(folder / "in.pls", folder / "x.las");
            }).find("none of its pulse descriptors has a returning waveform"),
            std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "x.las"));
}

}  // namespace
}  // namespace pcl_als
