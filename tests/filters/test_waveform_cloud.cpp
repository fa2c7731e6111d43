// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/filters/waveform_decomposition.h>

namespace pcl_als {
namespace {

constexpr double kWidth = 2.0;     // of the response, samples of 1 ns
constexpr float kSpeed = 1.5e-4F;  // metres per picosecond

/// A pulse that points downwards from z = 100 m at the first sample.
PointLidar pulsePoint(float time_ps, unsigned number, unsigned of) {
  PointLidar point(3.0F, 4.0F, 100.0F - kSpeed * time_ps);
  point.gps_time = 7.0;
  point.intensity = 800.0F;
  point.return_number = static_cast<std::uint8_t>(number);
  point.number_of_returns = static_cast<std::uint8_t>(of);
  point.classification = 2;
  return point;
}

std::vector<double> countsOf(const std::vector<std::pair<double, double>>& echoes) {
  std::vector<double> counts;
  for (int i = 0; i < 64; ++i) {
    double count = 100.0 + 0.4 * ((i * 7) % 5 - 2);
    for (const auto& [amplitude, time] : echoes)
      count += amplitude * std::exp(-0.5 * std::pow((i - time) / kWidth, 2));
    counts.push_back(count);
  }
  return counts;
}

/// Three pulses: echoes at 20 and 40 ns, of which only the second was returned; an echo with its
/// return; a point without a waveform.
class WaveformCloud : public testing::Test {
 protected:
  WaveformCloud() : cloud(new pcl::PointCloud<PointLidar>) {
    cloud->push_back(pulsePoint(41000.0F, 1, 1));  // late by 1 ns
    cloud->push_back(pulsePoint(30000.0F, 1, 1));
    cloud->push_back(pulsePoint(25000.0F, 1, 1));
    waveforms = std::make_shared<MemoryWaveforms>(cloud->size());
    WaveformDescriptor descriptor;
    descriptor.bits = 16;
    descriptor.samples = 64;
    waveforms->setDescriptor(1, descriptor);
    const Eigen::Vector3f up(0.0F, 0.0F, kSpeed);
    waveforms->assign(0, waveforms->addWaveform(1, countsOf({{100.0, 20.0}, {400.0, 40.0}})),
                      41000.0F, up);
    waveforms->assign(1, waveforms->addWaveform(1, countsOf({{300.0, 30.0}})), 30000.0F, up);
    EchoSettings settings;
    settings.pulse_width_ns = kFwhmOfGaussian * kWidth;
    filter.setSettings(settings);
    filter.setWaveforms(waveforms);
    filter.setInputCloud(cloud);
  }

  pcl::PointCloud<PointLidar>::Ptr cloud;
  std::shared_ptr<MemoryWaveforms> waveforms;
  WaveformDecomposition<PointLidar> filter;
  pcl::PointCloud<PointLidar> out;
};

TEST_F(WaveformCloud, GetsAllEchoes) {
  filter.filter(out);
  ASSERT_EQ(out.size(), 4U);
  EXPECT_EQ(filter.getSourceIndices(), (pcl::Indices{0, 0, 1, 2}));
  ASSERT_EQ(filter.getEchoes().size(), 4U);
  // The return of the first pulse, as it was, and the new point 20 ns above it.
  EXPECT_EQ(out[0].z, (*cloud)[0].z);
  EXPECT_EQ(out[0].return_number, 2);
  EXPECT_EQ(out[0].number_of_returns, 2);
  EXPECT_EQ(out[0].classification, 2);
  EXPECT_NEAR(filter.getEchoes()[0].amplitude, 400.0, 1.0);
  EXPECT_FALSE(filter.getEchoes()[0].new_echo);
  EXPECT_NEAR(out[1].z, 97.0, 0.005);  // 100 m - 20000 ps * 1.5e-4 m/ps
  EXPECT_EQ(out[1].x, 3.0F);
  EXPECT_EQ(out[1].return_number, 1);
  EXPECT_EQ(out[1].number_of_returns, 2);
  EXPECT_EQ(out[1].classification, 1);
  EXPECT_EQ(out[1].flags, kSynthetic);
  EXPECT_NEAR(out[1].intensity, 200.0, 2.0);  // 800 * 100 / 400
  EXPECT_EQ(out[1].gps_time, 7.0);
  EXPECT_TRUE(filter.getEchoes()[1].new_echo);
  EXPECT_NEAR(filter.getEchoes()[1].echo_width, 4.71, 0.1);
  // The others keep their numbers.
  EXPECT_EQ(out[2].number_of_returns, 1);
  EXPECT_TRUE(filter.getEchoes()[2].hasEcho());
  EXPECT_FALSE(filter.getEchoes()[3].hasEcho());
  EXPECT_NEAR(filter.getPulseWidths().at(1), 4.7096, 1e-3);
}

TEST_F(WaveformCloud, MovesReturnsWithoutNewPoints) {
  filter.setNewEchoes(false);
  filter.setMoveReturns(true);
  filter.filter(out);
  ASSERT_EQ(out.size(), 3U);
  EXPECT_NEAR(out[0].z, 94.0, 0.005);  // 100 m - 40000 ps * 1.5e-4 m/ps
  EXPECT_EQ(out[0].number_of_returns, 1);
}

TEST_F(WaveformCloud, KeepsPointsOutsideIndices) {
  const pcl::IndicesPtr indices(new pcl::Indices{1});
  filter.setIndices(indices);
  filter.filter(out);
  ASSERT_EQ(out.size(), 3U);
  EXPECT_FALSE(filter.getEchoes()[0].hasEcho());
  EXPECT_TRUE(filter.getEchoes()[1].hasEcho());
  EXPECT_EQ(out[0].return_number, 1);
}

TEST_F(WaveformCloud, AddsNoEchoOfAPulseTwice) {
  // The same waveform again, behind that of another pulse.
  const WaveformReference& first = waveforms->reference(0);
  waveforms->assign(2, first.byte_offset, 25000.0F, first.direction);
  filter.filter(out);
  EXPECT_EQ(out.size(), 4U);
}

TEST_F(WaveformCloud, RefusesWaveformsOfOtherPoints) {
  cloud->push_back(pulsePoint(25000.0F, 1, 1));
  EXPECT_THROW(filter.filter(out), UsageError);
  filter.setWaveforms(nullptr);
  EXPECT_THROW(filter.filter(out), UsageError);
}

}  // namespace
}  // namespace pcl_als
