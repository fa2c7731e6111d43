// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
// Files of simulated waveforms, read back by module waveform.
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "test_files.h"

namespace pcl_als {
namespace {

using simulation::SimulatedPulse;
using simulation::SimulatedWaveforms;
using simulation::SimulationOptions;
using simulation::Simulator;

SimulationOptions oneStrip() {
  auto options = SimulationOptions::preset("small", 0.2, 0.02);
  options.lines.resize(1);
  options.pairs.clear();
  options.waveform.emplace();
  return options;
}

/// Goes through a file beside the simulation in memory.
void compare(const Simulator& simulator, const LasFile& las) {
  const WaveformSource source(las);
  WaveformReader reader(source);
  Waveform waveform;
  std::vector<std::byte> records(las.header().point_count * las.header().record_length);
  las.readRecords(0, las.header().point_count, records.data());
  std::uint64_t at = 0, packets_end = kLasEvlrHeader;
  simulator.simulateWaveforms(0, 2, [&](const SimulatedWaveforms& truth) {
    for (const SimulatedPulse& pulse : truth.pulses) {
      for (std::size_t i = pulse.point; i < pulse.point + pulse.points; ++i, ++at) {
        const std::byte* record = &records[at * las.header().record_length];
        ASSERT_TRUE(reader.read(record, at, waveform));
        ASSERT_EQ(waveform.counts.size(), pulse.counts);
        for (std::size_t k = 0; k < pulse.counts; ++k)
          ASSERT_EQ(waveform.counts[k], truth.counts[pulse.count + k]);
        EXPECT_EQ(waveform.reference.location_ps, truth.locations[i]);
        EXPECT_EQ(waveform.reference.byte_offset, packets_end);
        // Metres per picosecond of two-way time, towards the sensor.
        const Eigen::Vector3d towards = waveform.reference.direction.cast<double>();
        EXPECT_NEAR((towards - 1.49896229e-4 * pulse.to_sensor).norm(), 0.0, 1e-11);
        const Eigen::Vector3d position =
            LasRecordLayout::positionOf(record, las.header().scale, las.header().offset);
        EXPECT_NEAR((position - truth.points[i].position).norm(), 0.0, 0.001);
      }
      packets_end += waveform.reference.bytes;
    }
  });
  EXPECT_EQ(at, las.header().point_count);
  EXPECT_EQ(source.packetBytes(), packets_end);
}

TEST(SimulatedWaveformFile, IsReadBack) {
  const auto folder = test::scratch("simulated_waveforms");
  const Simulator simulator(oneStrip());
  for (const int format : {4, 5, 9, 10}) {
    for (const bool compressed : {false, true}) {
      StripFileOptions files;
      files.folder = folder;
      files.waveform_format = format;
      files.compressed = compressed;
      const StripSummary summary = writeStrip(simulator, 0, files, 2, [](double) {});
      const LasFile las(folder / summary.file);
      EXPECT_EQ(las.header().point_format, format);
      EXPECT_EQ(las.header().version_minor, format < 6 ? 3 : 4);
      EXPECT_NE(las.header().global_encoding & kLasWaveformExternal, 0);
      EXPECT_EQ(las.header().point_count, summary.points);
      EXPECT_GT(summary.points, 500U);
      EXPECT_EQ(readWaveformDescriptors(las).size(), 7U);
      compare(simulator, las);
    }
  }
}

TEST(SimulatedWaveformFile, HasTheLengthOfItsPackets) {
  const auto folder = test::scratch("simulated_waveforms");
  SimulationOptions options = oneStrip();
  options.waveform->bits = 8;
  const Simulator simulator(options);
  StripFileOptions files;
  files.folder = folder;
  writeStrip(simulator, 0, files, 2, [](double) {});
  const auto packets = folder / "strip1.wdp";
  std::ifstream file(packets, std::ios::binary);
  std::vector<char> header(kLasEvlrHeader);
  file.read(header.data(), static_cast<std::streamsize>(header.size()));
  std::uint64_t length = 0;
  std::memcpy(&length, &header[20], sizeof length);
  EXPECT_EQ(length + kLasEvlrHeader, std::filesystem::file_size(packets));
  EXPECT_EQ(std::string(&header[2]), "LASF_Spec");
  EXPECT_EQ(length % 64, 0U);  // a byte for each sample
}

}  // namespace
}  // namespace pcl_als
