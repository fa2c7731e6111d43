// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <pcl_als/waveform/waveform_descriptor.h>

#include "test_files.h"
#include "waveform_direction.h"
#include "waveform_file.h"

namespace pcl_als {
namespace {

/// Turns points about a place above them, as a boresight angle does, and shifts them.
void turn(const LasHeader& header, std::byte* records, std::size_t count) {
  const Eigen::Vector3d sensor(0.0, 0.0, 1500.0), shift(0.2, -0.1, 0.05);
  const Eigen::AngleAxisd rotation(1e-3, Eigen::Vector3d(1.0, 0.5, 0.2).normalized());
  for (std::size_t i = 0; i < count; ++i) {
    std::byte* record = records + i * header.record_length;
    const Eigen::Vector3d p = LasRecordLayout::positionOf(record, header.scale, header.offset);
    const Eigen::Vector3d moved = sensor + rotation * (p - sensor) + shift;
    for (int axis = 0; axis < 3; ++axis)
      LasRecordLayout::storeCoordinate(
          static_cast<std::int32_t>(
              std::lround((moved[axis] - header.offset[axis]) / header.scale[axis])),
          axis, record);
  }
}

TEST(WaveformDirection, TurnsWithThePoint) {
  for (const int format : {4, 9}) {
    const auto folder = test::scratch("waveform_direction");
    test::waveformFile(format).write(folder / "in.las");
    const LasFile file(folder / "in.las");
    const std::size_t count = file.header().point_count, length = file.header().record_length;
    std::vector<std::byte> given(count * length);
    file.readRecords(0, count, given.data());
    std::vector<std::byte> records = given;
    const LasRecordBlock block{records.data(), count, length, 0};
    detail::DisplacedPoints second(file, block);
    ASSERT_TRUE(second.any());
    turn(file.header(), records.data(), count);
    turn(file.header(), second.records(), count);
    second.storeDirections(block);
    const Eigen::AngleAxisd rotation(1e-3, Eigen::Vector3d(1.0, 0.5, 0.2).normalized());
    for (std::size_t i = 0; i < count; ++i) {
      const auto before = WaveformReference::of(&given[i * length], file.layout());
      const auto after = WaveformReference::of(&records[i * length], file.layout());
      const Eigen::Vector3d expected = rotation * before.direction.cast<double>();
      // Over 100 m of the waveform, less than 2 mm; without the correction 100 mm.
      EXPECT_LT((after.direction.cast<double>() - expected).norm() * 1e6 / 1.5, 0.002);
      EXPECT_EQ(after.location_ps, before.location_ps);
      EXPECT_EQ(after.byte_offset, before.byte_offset);
    }
  }
}

TEST(WaveformDirection, KeepsTheBytesOfPointsThatAreNotMoved) {
  const auto folder = test::scratch("waveform_direction_kept");
  test::waveformFile(4).write(folder / "in.las");
  const LasFile file(folder / "in.las");
  const std::size_t count = file.header().point_count, length = file.header().record_length;
  std::vector<std::byte> records(count * length);
  file.readRecords(0, count, records.data());
  const std::vector<std::byte> given = records;
  const LasRecordBlock block{records.data(), count, length, 0};
  const detail::DisplacedPoints second(file, block);
  second.storeDirections(block);
  EXPECT_EQ(records, given);
}

}  // namespace
}  // namespace pcl_als
