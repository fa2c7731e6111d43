// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/intensity_job.h>
#include <pcl_als/processing/intensity_run.h>
#include <pcl_als/processing/waveform_job.h>

#include "decomposed_file.h"
#include "test_files.h"

namespace pcl_als {
namespace {

namespace fs = std::filesystem;
using test::DecomposedFile;

long linesOnEnergies(const IntensityRun& run) {
  return std::count_if(run.remarks().begin(), run.remarks().end(), [](const std::string& text) {
    return text.find("energies of echoes") != std::string::npos;
  });
}

class IntensityOfEchoes : public testing::Test {
 protected:
  IntensityOfEchoes() : folder(test::scratch("intensity_energy")) {
    test::WaveformFile file = test::waveformFile(4);
    // The scanner returned a point where the waveform has no echo.
    file.pulses[3] = {{{400.0, 30.0}, {0.0, 60.0}}, 2};
    file.write(folder / "in.las");
    WaveformSettings waveforms;
    waveforms.pulse_width_ns = 4.76;
    decomposeWaveforms(folder / "in.las", folder / "echoes.las", waveforms);
    options.settings.model.incidence_exponent = 0.0;
    options.settings.find_surfaces = false;
    options.settings.echo_energy = true;
    options.output.extra_fields = false;
    options.output.scale = 2.0;
  }
  IntensityResult correct(const char* input = "echoes.las") {
    return correctIntensity({(folder / input).string()}, {(folder / "out.las").string()},
                            test::flightOfWaveforms(), options);
  }

  fs::path folder;
  IntensityOptions options;
};

TEST_F(IntensityOfEchoes, IsAmplitudeTimesWidth) {
  const IntensityResult result = correct();
  const DecomposedFile in(folder / "echoes.las"), out(folder / "out.las");
  const auto amplitude = in.column("amplitude"), width = in.column("echo_width");
  const auto original = out.column("original_intensity");
  ASSERT_EQ(out.size(), in.size());
  std::size_t without = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const int written = LasRecordLayout::intensityOf(out.record(i));
    EXPECT_EQ(original[i], LasRecordLayout::intensityOf(in.record(i)));
    if (std::isnan(amplitude[i])) {
      EXPECT_EQ(written, 0);
      ++without;
      continue;
    }
    const double km =
        1e-3 * test::rangeOfEcho(WaveformReference::of(in.record(i), in.las.layout()).location_ps /
                                 1000.0);
    EXPECT_NEAR(written, 2.0 * amplitude[i] * width[i] * km * km, 0.6);
  }
  EXPECT_EQ(without, 1U);
  EXPECT_EQ(result.counts().zeros, 1U);
  EXPECT_EQ(result.counts().saturated, 0U);
}

TEST_F(IntensityOfEchoes, IsSaidInOneLine) {
  EXPECT_EQ(linesOnEnergies(*correct().run), 1);
}

TEST_F(IntensityOfEchoes, NeedsDecomposedWaveforms) {
  EXPECT_NE(test::messageOf<InputError>([&] { correct("in.las"); }).find("amplitude"),
            std::string::npos);
}

TEST_F(IntensityOfEchoes, DoesNotUseTheRadiometryOfIntensities) {
  options.stored.emplace();
  EXPECT_THROW(correct(), InputError);
}

TEST_F(IntensityOfEchoes, IsNotUsedWithoutBeingAskedFor) {
  options.settings.echo_energy = false;
  options.output.scale = 1.0;
  const IntensityResult result = correct();
  EXPECT_EQ(linesOnEnergies(*result.run), 0);
  const DecomposedFile in(folder / "echoes.las"), out(folder / "out.las");
  const double given = LasRecordLayout::intensityOf(in.record(1));
  EXPECT_NEAR(LasRecordLayout::intensityOf(out.record(1)), given, 0.02 * given);
}

}  // namespace
}  // namespace pcl_als
