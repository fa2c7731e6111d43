// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/waveform_reader.h>

#include "las_bytes.h"
#include "test_files.h"
#include "waveform_file.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::LasBytes;

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
  test::WaveformFile file = test::waveformFile(4);
  file.write(folder / "in.las");
  const WaveformResult result = decomposeWaveforms(folder / "in.las", out);
  EXPECT_EQ(result.counts.points, 200U);
  EXPECT_EQ(result.counts.waveforms, 200U);
  EXPECT_EQ(result.counts.matched, 200U);
  EXPECT_EQ(result.counts.added, 40U);
  EXPECT_EQ(result.counts.single, 160U);
  EXPECT_NEAR(result.counts.meanOffset(), 0.0, 5.0);
  const double width = std::sqrt(test::kPulseWidth * test::kPulseWidth + 1.0 / 12.0) * 2.35482;
  EXPECT_NEAR(result.pulses.front().width_ns, width, 0.05);

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
      EXPECT_NEAR(
          amplitude[at],
          truth * test::kPulseWidth / std::sqrt(test::kPulseWidth * test::kPulseWidth + 1.0 / 12.0),
          10.0);
      EXPECT_NEAR(echo_width[at], width, 6.0 * width_std[at]);
      EXPECT_GT(range_std[at], 1e-4);
      EXPECT_LT(range_std[at], 0.02);
      const double error = (points.position(at) - test::WaveformFile::positionOf(time)).norm();
      EXPECT_LT(error, 6.0 * range_std[at] + 0.002);
    }
}

INSTANTIATE_TEST_SUITE_P(PlainAndCompressed, WaveformJob, testing::Values(".las", ".laz"));

TEST(WaveformFiles, KeepsRecordsAndNumbersReturns) {
  for (const int format : {4, 9}) {
    const fs::path folder = test::scratch("waveform_job_records");
    test::WaveformFile file = test::waveformFile(format);
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
  test::WaveformFile file = test::waveformFile(4);
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
    EXPECT_LT((after.position(i) - test::WaveformFile::positionOf(time)).norm(), 0.01);
    EXPECT_NEAR(WaveformReference::of(after.record(i), after.las.layout()).location_ps,
                1000.0 * time, 60.0);
  }
}

TEST(WaveformFiles, GivesTheSameOnAnyNumberOfThreads) {
  const fs::path folder = test::scratch("waveform_job_threads");
  test::WaveformFile file = test::waveformFile(9);
  const std::vector<test::Pulse> pulses = file.pulses;
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
  test::WaveformFile file = test::waveformFile(4);
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
  test::WaveformFile few;
  few.pulses.assign(5, test::Pulse{{{400.0, 30.0}}, 1});
  few.write(folder / "few.las");
  EXPECT_NE(test::messageOf<InputError>([&] {
              decomposeWaveforms(folder / "few.las", folder / "out.las");
            }).find("width of the pulse"),
            std::string::npos);
}

}  // namespace
}  // namespace pcl_als
