// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <gtest/gtest.h>

#include <pcl_als/filters/waveform_decomposition.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/processing/waveform_job.h>

#include "test_files.h"
#include "waveform_file.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;

struct Records {
  explicit Records(const fs::path& path) : las(path) {
    bytes.resize(las.header().point_count * las.header().record_length);
    las.readRecords(0, las.header().point_count, bytes.data());
  }
  std::vector<double> column(const std::string& name) const {
    std::vector<double> values;
    decodeLasExtraField(bytes.data(), las.header().point_count, las.header().record_length,
                        *findLasExtraField(las.extraFields(), name, "output"), values);
    return values;
  }
  PointLidar point(std::size_t i) const {
    const std::byte* record = &bytes[i * las.header().record_length];
    const LasRecordLayout& layout = las.layout();
    const Eigen::Vector3d at =
        LasRecordLayout::positionOf(record, las.header().scale, las.header().offset);
    PointLidar point(static_cast<float>(at.x()), static_cast<float>(at.y()),
                     static_cast<float>(at.z()));
    point.intensity = LasRecordLayout::intensityOf(record);
    point.return_number = static_cast<std::uint8_t>(layout.returnNumberOf(record));
    point.number_of_returns = static_cast<std::uint8_t>(layout.numberOfReturnsOf(record));
    point.classification = layout.classOf(record);
    return point;
  }

  LasFile las;
  std::vector<std::byte> bytes;
};

TEST(WaveformCloudOfFile, IsWhatTheFileWouldGet) {
  const fs::path folder = test::scratch("waveform_cloud_file");
  test::WaveformFile file = test::waveformFile(9);
  const std::vector<test::Pulse> pulses = file.pulses;
  for (int i = 0; i < 6; ++i)  // several parts of the work
    file.pulses.insert(file.pulses.end(), pulses.begin(), pulses.end());
  file.write(folder / "in.las");
  decomposeWaveforms(folder / "in.las", folder / "out.las");

  const Records given(folder / "in.las"), written(folder / "out.las");
  pcl::PointCloud<PointLidar>::Ptr cloud(new pcl::PointCloud<PointLidar>);
  for (std::size_t i = 0; i < given.las.header().point_count; ++i) cloud->push_back(given.point(i));
  WaveformDecomposition<PointLidar> filter;
  filter.setWaveforms(std::make_shared<LasWaveforms>(folder / "in.las"));
  filter.setInputCloud(cloud);
  filter.setNumberOfThreads(3);
  pcl::PointCloud<PointLidar> out;
  filter.filter(out);

  ASSERT_EQ(out.size(), written.las.header().point_count);
  ASSERT_GT(out.size(), cloud->size());
  const auto amplitude = written.column("amplitude"), width = written.column("echo_width");
  const auto range_std = written.column("range_std"), is_new = written.column("new_echo");
  for (std::size_t i = 0; i < out.size(); ++i) {
    const PointLidar expected = written.point(i);
    const EchoAttributes& echo = filter.getEchoes()[i];
    EXPECT_EQ(static_cast<double>(echo.amplitude), amplitude[i]);
    EXPECT_EQ(static_cast<double>(echo.echo_width), width[i]);
    EXPECT_EQ(static_cast<double>(echo.range_std), range_std[i]);
    EXPECT_EQ(echo.new_echo, is_new[i] == 1.0);
    EXPECT_LT((out[i].getVector3fMap() - expected.getVector3fMap()).norm(), 0.001F);
    EXPECT_NEAR(out[i].intensity, expected.intensity, 0.51);
    EXPECT_EQ(out[i].return_number, expected.return_number);
    EXPECT_EQ(out[i].number_of_returns, expected.number_of_returns);
    EXPECT_EQ(out[i].classification, expected.classification);
  }
}

}  // namespace
}  // namespace pcl_als
