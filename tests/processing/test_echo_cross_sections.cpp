// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/waveform_job.h>
#include <pcl_als/waveform/waveform_descriptor.h>

#include "decomposed_file.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::DecomposedFile;

/// Single echoes of 400 counts, and every fifth pulse with echoes of 100 and 300 counts.
void writeInput(const fs::path& path) {
  test::WaveformFile file;
  for (int i = 0; i < 200; ++i) {
    const double time = 30.0 + 0.01 * i;
    if (i % 5 == 0)
      file.pulses.push_back({{{100.0, time}, {300.0, time + 15.0}}, 2});
    else
      file.pulses.push_back({{{400.0, time}}, 1});
  }
  file.write(path);
}

class EchoCrossSections : public testing::Test {
 protected:
  EchoCrossSections() : folder(test::scratch("echo_cross_sections")) {
    writeInput(folder / "in.las");
    settings.pulse_width_ns = 4.76;
    settings.cross_sections.trajectory = test::flightOfWaveforms();
    settings.cross_sections.model.extinction_per_km = 0.1;
    settings.cross_sections.model.beam_divergence = 0.3;
  }
  WaveformResult run() {
    return decomposeWaveforms(folder / "in.las", folder / "out.las", settings);
  }

  fs::path folder;
  WaveformSettings settings;
};

TEST_F(EchoCrossSections, AreRelativeWithoutACalibration) {
  const WaveformResult result = run();
  ASSERT_TRUE(result.cross_sections);
  EXPECT_FALSE(result.cross_sections->calibrated);
  EXPECT_NE(describe(result).find("constant 1, they are relative"), std::string::npos);
  const DecomposedFile out(folder / "out.las");
  const auto amplitude = out.column("amplitude"), width = out.column("echo_width");
  const auto section = out.column("cross_section"), gamma = out.column("backscatter_coefficient");
  ASSERT_EQ(out.size(), 240U);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double km =
        1e-3 * test::rangeOfEcho(
                   WaveformReference::of(out.record(i), out.las.layout()).location_ps / 1000.0);
    const double expected = std::pow(km, 4) * std::exp(0.2 * km) * amplitude[i] * width[i];
    EXPECT_NEAR(section[i] / expected, 1.0, 2e-4);
    const double area = 0.25 * 3.14159265 * std::pow(0.3 * km, 2);  // 0.3 m in 1 km
    EXPECT_NEAR(gamma[i] * area / section[i], 1.0, 2e-4);
  }
}

TEST_F(EchoCrossSections, AreCalibratedByTargets) {
  // All points lie about 1.3 m east of the origin.
  settings.cross_sections.targets = {{"asphalt", 1.3, 0.0, 0.3, 0.0}};
  const WaveformResult result = run();
  ASSERT_TRUE(result.cross_sections && result.cross_sections->reference);
  EXPECT_TRUE(result.cross_sections->calibrated);
  EXPECT_EQ(result.cross_sections->reference->targets.front().points, 160U);
  const DecomposedFile out(folder / "out.las");
  const auto gamma = out.column("backscatter_coefficient");
  double sum = 0.0, singles = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.las.layout().numberOfReturnsOf(out.record(i)) != 1) continue;
    sum += gamma[i];
    singles += 1.0;
  }
  // 4 * 0.3 * cos(theta), with the tangent 0.3: 1.2 * 0.957826
  EXPECT_NEAR(sum / singles, 1.14939, 0.005);
}

TEST_F(EchoCrossSections, BehindOthersGetWhatTheseTook) {
  settings.cross_sections.correct_attenuation = true;
  const WaveformResult result = run();
  EXPECT_EQ(result.counts.attenuated, 40U);
  EXPECT_EQ(result.counts.opaque, 0U);
  const double full = result.cross_sections->full_coefficient;
  const DecomposedFile out(folder / "out.las");
  const auto gamma = out.column("backscatter_coefficient");
  double first = 0.0, second = 0.0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.las.layout().numberOfReturnsOf(out.record(i)) != 2) continue;
    (out.las.layout().returnNumberOf(out.record(i)) == 1 ? first : second) +=
        gamma[i] / full / 40.0;
  }
  EXPECT_NEAR(first, 0.25, 0.01);  // 100 of 400 counts
  EXPECT_NEAR(second, 1.0, 0.02);  // 300 of 400 counts, through a transmission of 0.75
}

TEST_F(EchoCrossSections, UseAGivenConstant) {
  settings.cross_sections.model.constant = 1e-5;
  const WaveformResult result = run();
  EXPECT_TRUE(result.cross_sections->calibrated);
  const DecomposedFile out(folder / "out.las");
  settings.cross_sections.model.constant = 1.0;
  run();
  const DecomposedFile relative(folder / "out.las");
  EXPECT_NEAR(out.column("cross_section")[1] / relative.column("cross_section")[1], 1e-5, 1e-10);
}

TEST_F(EchoCrossSections, AreNotWrittenWithoutATrajectory) {
  settings.cross_sections.trajectory = nullptr;
  const WaveformResult result = run();
  EXPECT_FALSE(result.cross_sections);
  EXPECT_FALSE(DecomposedFile(folder / "out.las").has("cross_section"));
}

TEST_F(EchoCrossSections, RefuseWhatGivesNoRangeOrConstant) {
  settings.cross_sections.targets = {{"far", 500.0, 0.0, 0.3, 0.0}};
  EXPECT_NE(test::messageOf<InputError>([&] { run(); }).find("no reference target"),
            std::string::npos);
  settings.cross_sections.targets.clear();
  settings.cross_sections.model.beam_divergence = 0.0;
  EXPECT_THROW(run(), UsageError);
  EXPECT_FALSE(fs::exists(folder / "out.las"));
}

}  // namespace
}  // namespace pcl_als
