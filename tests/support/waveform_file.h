// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <filesystem>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "las_bytes.h"

namespace pcl_als::test {

inline constexpr double kPulseWidth = 2.0;         // samples
inline constexpr unsigned kWaveformSamples = 80;   // of 16 bits, 1000 ps apart
inline constexpr float kPulseSpeed = 1.49896e-4F;  // metres per picosecond of two-way time

/// Echoes of a pulse: amplitude and time; the scanner returned the first of them only.
struct Pulse {
  std::vector<std::pair<double, double>> echoes;
  unsigned returns = 1;
};

/// Counts of a waveform: the pulse is integrated over each sample, with noise, in whole counts.
inline std::string packetOf(const Pulse& pulse, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, 2.0);
  Bytes bytes;
  for (unsigned i = 0; i < kWaveformSamples; ++i) {
    double power = 200.0;
    for (const auto& [amplitude, time] : pulse.echoes)
      for (int k = 0; k < 10; ++k) {
        const double x = (i + (k - 4.5) / 10.0 - time) / kPulseWidth;
        power += 0.1 * amplitude * std::exp(-0.5 * x * x);
      }
    bytes.u16(static_cast<unsigned>(std::lround(power + noise(random))));
  }
  return bytes.str();
}

/// Points at the returns of pulses: the pulse points downwards and to the east, with the first
/// sample 500 m above the origin of the coordinates.
struct WaveformFile {
  int format = 4;
  unsigned encoding = 4;
  std::vector<Pulse> pulses;
  std::string packets, points;
  unsigned point_count = 0;

  static Eigen::Vector3d positionOf(double time_samples) {
    const Eigen::Vector3d along = Eigen::Vector3d(0.3, 0.0, -1.0).normalized() * kPulseSpeed;
    return Eigen::Vector3d(0.0, 0.0, 500.0) + along * time_samples * 1000.0;
  }

  void addPoint(const Pulse& pulse, unsigned number, std::uint64_t offset) {
    const double time = pulse.echoes[number - 1].second;
    const Eigen::Vector3d at = positionOf(time);
    const Eigen::Vector3d to_anchor = -Eigen::Vector3d(0.3, 0.0, -1.0).normalized() * kPulseSpeed;
    LasBytes las;
    las.format = format;
    std::string record = las.record(0);
    const std::string place = Bytes()
                                  .i32(static_cast<int>(std::lround(at.x() * 1000.0)))
                                  .i32(static_cast<int>(std::lround(at.y() * 1000.0)))
                                  .i32(static_cast<int>(std::lround(at.z() * 1000.0)))
                                  .u16(1000)
                                  .str();
    record.replace(0, place.size(), place);
    record[14] =
        static_cast<char>(format < 6 ? number | pulse.returns << 3U : number | pulse.returns << 4U);
    const std::string reference = Bytes()
                                      .u8(1)
                                      .u64(offset)
                                      .u32(2 * kWaveformSamples)
                                      .f32(static_cast<float>(1000.0 * time))
                                      .f32(static_cast<float>(to_anchor.x()))
                                      .f32(static_cast<float>(to_anchor.y()))
                                      .f32(static_cast<float>(to_anchor.z()))
                                      .str();
    const std::size_t at_byte = format == 4 ? 28 : format == 5 ? 34 : format == 9 ? 30 : 38;
    record.replace(at_byte, reference.size(), reference);
    points += record;
    ++point_count;
  }

  void write(const std::filesystem::path& path) {
    std::mt19937_64 random(5);
    packets.clear();
    for (const Pulse& pulse : pulses) {
      const std::uint64_t offset = 60 + packets.size();
      packets += packetOf(pulse, random);
      for (unsigned r = 1; r <= pulse.returns; ++r) addPoint(pulse, r, offset);
    }
    LasBytes las;
    las.format = format;
    las.minor = format < 6 ? 3 : 4;
    las.encoding = 1 | encoding;
    las.offset_x = las.offset_y = las.offset_z = 0.0;
    las.vlrs = {LasBytes::vlr(
        "LASF_Spec", 100,
        Bytes().u8(16).u8(0).u32(kWaveformSamples).u32(1000).f64(0.5).f64(0.0).str())};
    las.count = point_count;
    std::string bytes = las.header();
    for (const std::string& vlr : las.vlrs) bytes += vlr;
    writeBytes(path, bytes + points);
    std::filesystem::path beside = path;
    writeBytes(beside.replace_extension(".wdp"), LasBytes::evlr("LASF_Spec", 65535, packets));
  }
};

/// Pulses of one echo, and every fifth with a second one that the scanner did not return.
inline WaveformFile waveformFile(int format) {
  WaveformFile file;
  file.format = format;
  for (int i = 0; i < 200; ++i) {
    Pulse pulse{{{400.0, 30.0 + 0.01 * i}}, 1};
    if (i % 5 == 0) pulse.echoes.emplace_back(100.0, 45.0 + 0.01 * i);
    file.pulses.push_back(pulse);
  }
  return file;
}

}  // namespace pcl_als::test
