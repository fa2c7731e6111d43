// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "las_bytes.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::Bytes;
using test::LasBytes;

constexpr double kPulse = 2.0;         // samples
constexpr unsigned kSamples = 80;      // of 16 bits, 1000 ps apart
constexpr float kSpeed = 1.49896e-4F;  // metres per picosecond of two-way time

/// Echoes of a pulse: amplitude and time; the scanner returned the first of them only.
struct Pulse {
  std::vector<std::pair<double, double>> echoes;
  unsigned returns = 1;
};

/// Counts of a waveform: the pulse is integrated over each sample, with noise, in whole counts.
std::string packetOf(const Pulse& pulse, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, 2.0);
  Bytes bytes;
  for (unsigned i = 0; i < kSamples; ++i) {
    double power = 200.0;
    for (const auto& [amplitude, time] : pulse.echoes)
      for (int k = 0; k < 10; ++k) {
        const double x = (i + (k - 4.5) / 10.0 - time) / kPulse;
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
    const Eigen::Vector3d along = Eigen::Vector3d(0.3, 0.0, -1.0).normalized() * kSpeed;
    return Eigen::Vector3d(0.0, 0.0, 500.0) + along * time_samples * 1000.0;
  }

  void addPoint(const Pulse& pulse, unsigned number, std::uint64_t offset) {
    const double time = pulse.echoes[number - 1].second;
    const Eigen::Vector3d at = positionOf(time);
    const Eigen::Vector3d to_anchor = -Eigen::Vector3d(0.3, 0.0, -1.0).normalized() * kSpeed;
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
                                      .u32(2 * kSamples)
                                      .f32(static_cast<float>(1000.0 * time))
                                      .f32(static_cast<float>(to_anchor.x()))
                                      .f32(static_cast<float>(to_anchor.y()))
                                      .f32(static_cast<float>(to_anchor.z()))
                                      .str();
    record.replace(format < 6 ? 28 : 30, reference.size(), reference);
    points += record;
    ++point_count;
  }

  void write(const fs::path& path) {
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
        "LASF_Spec", 100, Bytes().u8(16).u8(0).u32(kSamples).u32(1000).f64(0.5).f64(0.0).str())};
    las.count = point_count;
    std::string bytes = las.header();
    for (const std::string& vlr : las.vlrs) bytes += vlr;
    test::writeBytes(path, bytes + points);
    fs::path beside = path;
    test::writeBytes(beside.replace_extension(".wdp"), LasBytes::evlr("LASF_Spec", 65535, packets));
  }
};

/// Pulses of one echo, and every fifth with a second one that the scanner did not return.
WaveformFile simpleFile(int format) {
  WaveformFile file;
  file.format = format;
  for (int i = 0; i < 200; ++i) {
    Pulse pulse{{{400.0, 30.0 + 0.01 * i}}, 1};
    if (i % 5 == 0) pulse.echoes.emplace_back(100.0, 45.0 + 0.01 * i);
    file.pulses.push_back(pulse);
  }
  return file;
}

struct Output {
  LasFile las;
  std::vector<std::byte> records;

  explicit Output(const fs::path& path) : las(path) {
    records.resize(las.header().point_count * las.header().record_length);
    las.readRecords(0, las.header().point_count, records.data());
  }
  std::vector<double> column(const std::string& name) const {
    std::vector<double> values;
    const LasExtraField* field = findLasExtraField(las.extraFields(), name, "output");
    decodeLasExtraField(records.data(), las.header().point_count, las.header().record_length,
                        *field, values);
    return values;
  }
  const std::byte* record(std::size_t i) const { return &records[i * las.header().record_length]; }
  Eigen::Vector3d position(std::size_t i) const {
    return LasRecordLayout::positionOf(record(i), las.header().scale, las.header().offset);
  }
};

class WaveformJob : public testing::TestWithParam<const char*> {};

TEST_P(WaveformJob, WritesEchoesAsPoints) {
  const fs::path folder = test::scratch("waveform_job");
  const fs::path out = folder / (std::string("out") + GetParam());
  WaveformFile file = simpleFile(4);
  file.write(folder / "in.las");
  const WaveformResult result = decomposeWaveforms(folder / "in.las", out);
  EXPECT_EQ(result.counts.points, 200U);
  EXPECT_EQ(result.counts.waveforms, 200U);
  EXPECT_EQ(result.counts.matched, 200U);
  EXPECT_EQ(result.counts.added, 40U);
  EXPECT_EQ(result.counts.single, 160U);
  EXPECT_NEAR(result.counts.meanOffset(), 0.0, 5.0);
  const double width = std::sqrt(kPulse * kPulse + 1.0 / 12.0) * 2.35482;
  EXPECT_NEAR(result.pulse_width_ns.front().second, width, 0.05);

  const Output points(out);
  ASSERT_EQ(points.las.header().point_count, 240U);
  EXPECT_EQ(test::readBytes(folder / "out.wdp"), test::readBytes(folder / "in.wdp"));
  const auto amplitude = points.column("amplitude"), echo_width = points.column("echo_width");
  const auto width_std = points.column("echo_width_std"), range_std = points.column("range_std");
  const auto is_new = points.column("new_echo");
  std::size_t at = 0;
  for (int i = 0; i < 200; ++i)
    for (std::size_t e = 0; e < file.pulses[static_cast<std::size_t>(i)].echoes.size(); ++e, ++at) {
      const auto [truth, time] = file.pulses[static_cast<std::size_t>(i)].echoes[e];
      EXPECT_EQ(is_new[at], e == 1 ? 1.0 : 0.0);
      EXPECT_NEAR(amplitude[at], truth * kPulse / std::sqrt(kPulse * kPulse + 1.0 / 12.0), 10.0);
      EXPECT_NEAR(echo_width[at], width, 6.0 * width_std[at]);
      EXPECT_GT(range_std[at], 1e-4);
      EXPECT_LT(range_std[at], 0.02);
      const double error = (points.position(at) - WaveformFile::positionOf(time)).norm();
      EXPECT_LT(error, 6.0 * range_std[at] + 0.002);
    }
}

INSTANTIATE_TEST_SUITE_P(PlainAndCompressed, WaveformJob, testing::Values(".las", ".laz"));

TEST(WaveformFiles, KeepsRecordsAndNumbersReturns) {
  for (const int format : {4, 9}) {
    const fs::path folder = test::scratch("waveform_job_records");
    WaveformFile file = simpleFile(format);
    file.pulses[5] = {{{400.0, 25.0}, {300.0, 50.0}}, 2};  // both were returned
    file.write(folder / "in.las");
    decomposeWaveforms(folder / "in.las", folder / "out.las");
    const Output before(folder / "in.las"), after(folder / "out.las");
    const std::size_t length = before.las.header().record_length;
    const LasRecordLayout& layout = after.las.layout();
    const auto is_new = after.column("new_echo");
    std::size_t from = 0;
    for (std::size_t i = 0; i < after.las.header().point_count; ++i) {
      if (is_new[i] == 1.0) {
        EXPECT_EQ(layout.returnNumberOf(after.record(i)), 2U);
        EXPECT_EQ(layout.numberOfReturnsOf(after.record(i)), 2U);
        EXPECT_EQ(layout.classOf(after.record(i)), 1U);
        const auto flags = std::to_integer<unsigned>(after.record(i)[15]);
        EXPECT_NE(flags & (format < 6 ? 0x20U : 1U), 0U);
        EXPECT_NEAR(LasRecordLayout::intensityOf(after.record(i)), 250, 40);
        // The location and the position of the new point agree with those of the return.
        const WaveformReference a = WaveformReference::of(after.record(i - 1), layout);
        const WaveformReference b = WaveformReference::of(after.record(i), layout);
        EXPECT_EQ(a.byte_offset, b.byte_offset);
        const Eigen::Vector3d moved =
            after.position(i - 1) + (b.location_ps - a.location_ps) * a.alongPulse();
        EXPECT_LT((after.position(i) - moved).norm(), 0.001);
        continue;
      }
      std::string given(reinterpret_cast<const char*>(before.record(from)), length);
      std::string written(reinterpret_cast<const char*>(after.record(i)), length);
      given[14] = written[14] = 0;  // return numbers
      EXPECT_EQ(given, written) << i;
      ++from;
    }
    EXPECT_EQ(from, before.las.header().point_count);
  }
}

TEST(WaveformFiles, MovesReturnsToTheirEchoes) {
  const fs::path folder = test::scratch("waveform_job_moved");
  WaveformFile file = simpleFile(4);
  file.write(folder / "in.las");
  // A detector that is late by 1.5 ns: positions and locations of all points.
  std::string bytes = test::readBytes(folder / "in.las");
  const std::size_t length = 57, begin = bytes.size() - 200 * length;
  for (std::size_t i = 0; i < 200; ++i) {
    std::byte* record = reinterpret_cast<std::byte*>(&bytes[begin + i * length]);
    WaveformReference reference = WaveformReference::of(record, LasRecordLayout::of(4));
    const Eigen::Vector3d shift = 1500.0 * reference.alongPulse() / 0.001;
    for (int axis = 0; axis < 3; ++axis)
      LasRecordLayout::storeCoordinate(
          static_cast<std::int32_t>(
              std::lround(LasRecordLayout::coordinateOf(record, axis) + shift[axis])),
          axis, record);
    reference.location_ps += 1500.0F;
    reference.store(record, LasRecordLayout::of(4));
  }
  test::writeBytes(folder / "in.las", bytes);
  WaveformSettings settings;
  settings.move_returns = true;
  settings.new_echoes = false;
  const WaveformResult result = decomposeWaveforms(folder / "in.las", folder / "out.las", settings);
  EXPECT_NEAR(result.counts.meanOffset(), -1500.0, 10.0);
  EXPECT_EQ(result.counts.added, 0U);
  const Output after(folder / "out.las");
  ASSERT_EQ(after.las.header().point_count, 200U);
  for (std::size_t i = 0; i < 200; ++i) {
    const double time = file.pulses[i].echoes[0].second;
    EXPECT_LT((after.position(i) - WaveformFile::positionOf(time)).norm(), 0.01);
    EXPECT_NEAR(WaveformReference::of(after.record(i), after.las.layout()).location_ps,
                1000.0 * time, 60.0);
  }
}

TEST(WaveformFiles, GivesTheSameOnAnyNumberOfThreads) {
  const fs::path folder = test::scratch("waveform_job_threads");
  WaveformFile file = simpleFile(9);
  const std::vector<Pulse> pulses = file.pulses;
  for (int i = 0; i < 8; ++i)  // several chunks
    file.pulses.insert(file.pulses.end(), pulses.begin(), pulses.end());
  file.write(folder / "in.las");
  WaveformSettings settings;
  settings.threads = 1;
  decomposeWaveforms(folder / "in.las", folder / "one.las", settings);
  settings.threads = 3;
  decomposeWaveforms(folder / "in.las", folder / "three.las", settings);
  EXPECT_EQ(test::readBytes(folder / "one.las"), test::readBytes(folder / "three.las"));
}

TEST(WaveformFiles, RefusesWhatItCannotUse) {
  const fs::path folder = test::scratch("waveform_job_refused");
  WaveformFile file = simpleFile(4);
  file.write(folder / "in.las");
  WaveformSettings settings;
  settings.pulse_width_ns = -1.0;
  EXPECT_THROW(decomposeWaveforms(folder / "in.las", folder / "out.las", settings), UsageError);
  EXPECT_THROW(decomposeWaveforms(folder / "in.las", folder / "in.las"), UsageError);
  test::writeBytes(folder / "plain.las", LasBytes().str());
  EXPECT_THROW(decomposeWaveforms(folder / "plain.las", folder / "out.las"), InputError);
  test::writeBytes(folder / "in.wdp", test::readBytes(folder / "in.wdp").substr(0, 3000));
  settings.pulse_width_ns = 4.7;
  EXPECT_THROW(decomposeWaveforms(folder / "in.las", folder / "out.las", settings), InputError);
  EXPECT_FALSE(fs::exists(folder / "out.las"));
  EXPECT_FALSE(fs::exists(folder / "out.wdp"));
  WaveformFile few;
  few.pulses.assign(5, Pulse{{{400.0, 30.0}}, 1});
  few.write(folder / "few.las");
  EXPECT_NE(test::messageOf<InputError>([&] {
              decomposeWaveforms(folder / "few.las", folder / "out.las");
            }).find("width of the pulse"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als
