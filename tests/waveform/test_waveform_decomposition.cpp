// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/waveform_decomposer.h>

#include "waveform_generator.h"

namespace pcl_als {
namespace {

using test::EchoErrors;
using test::TrueEcho;
using test::WaveformGenerator;

constexpr double kWidth = 2.12;  // samples: a full width at half maximum of 5 ns at 1 ns

WaveformDecomposer decomposerFor(double width, const DecompositionSettings& settings = {}) {
  return WaveformDecomposer(PulseResponse::gaussian(WaveformGenerator::digitisedWidth(width)),
                            settings);
}

Decomposition decomposed(WaveformDecomposer& decomposer, const std::vector<double>& counts) {
  Decomposition result;
  decomposer.decompose(counts.data(), counts.size(), result);
  return result;
}

void addErrors(const WaveformEcho& found, const TrueEcho& truth, EchoErrors& errors) {
  errors.add(
      {found.amplitude - WaveformGenerator::digitisedAmplitude(truth), found.time - truth.time,
       found.width - WaveformGenerator::digitisedWidth(truth.width)},
      {found.amplitude_std, found.time_std, found.width_std});
}

/// Number of waveforms of single echoes that are not decomposed into one; errors of the others.
int singleEchoes(double snr, int waveforms, EchoErrors& errors) {
  WaveformGenerator generator(static_cast<unsigned>(7 + snr));
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  int wrong = 0;
  for (int i = 0; i < waveforms; ++i) {
    const TrueEcho truth{snr, generator.uniform(20.0, 44.0), kWidth};
    const Decomposition found = decomposed(decomposer, generator.gaussians({truth}));
    if (found.count == 1)
      addErrors(found.echo[0], truth, errors);
    else
      ++wrong;
  }
  return wrong;
}

/// Noise below a step of the digitizer does not show in the baseline, and samples of an echo have
/// errors of rounding that the baseline has not.
TEST(RoundedSamples, HaveFewFalseEchoes) {
  WaveformGenerator generator(17);
  generator.baseline = 5.1;
  generator.noise = 0.25;
  generator.step = 1.0;
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  EchoErrors errors;
  int wrong = 0;
  for (int i = 0; i < 8000; ++i) {
    const TrueEcho truth{generator.uniform(10.0, 200.0), generator.uniform(20.0, 44.0), kWidth};
    const Decomposition found = decomposed(decomposer, generator.gaussians({truth}));
    if (found.count == 1)
      addErrors(found.echo[0], truth, errors);
    else
      ++wrong;
  }
  EXPECT_LE(wrong, 8);
  for (int part = 0; part < 3; ++part) {
    EXPECT_GT(errors.relativeRms()[part], 0.7) << part;
    EXPECT_LT(errors.relativeRms()[part], 1.1) << part;
  }
}

class SignalToNoise : public testing::TestWithParam<double> {};

TEST_P(SignalToNoise, LeavesErrorsOfTheSizeOfTheirStandardDeviations) {
  EchoErrors errors;
  EXPECT_LE(singleEchoes(GetParam(), 6000, errors), 8);
  for (int part = 0; part < 3; ++part) {
    EXPECT_GT(errors.relativeRms()[part], 0.9) << part;
    EXPECT_LT(errors.relativeRms()[part], 1.1) << part;
  }
}

TEST_P(SignalToNoise, ReachesTheCramerRaoBound) {
  EchoErrors errors;
  singleEchoes(GetParam(), 6000, errors);
  // Of the bound itself: amplitude and width before integration have nearly the same one.
  const Eigen::Vector3d bound = WaveformGenerator(1).bound({GetParam(), 32.3, kWidth});
  for (int part = 0; part < 3; ++part) {
    EXPECT_LT(errors.rms()[part], 1.1 * bound[part]) << part;
    EXPECT_GT(errors.rms()[part], 0.95 * bound[part]) << part;  // no estimate beats it
  }
}

INSTANTIATE_TEST_SUITE_P(FiveToFiveHundred, SignalToNoise,
                         testing::Values(5.0, 10.0, 50.0, 200.0, 500.0));

TEST(FalseEchoes, AreRareInNoise) {
  WaveformGenerator generator(11);
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  int wrong = 0;
  for (int i = 0; i < 20000; ++i)
    wrong += decomposed(decomposer, generator.gaussians({})).count > 0 ? 1 : 0;
  EXPECT_LE(wrong, 20);
}

/// Share of waveforms of one echo, widened by up to a factor, in which more are found.
double shareOfFalse(double widest, int waveforms) {
  WaveformGenerator generator(12);
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  int wrong = 0;
  for (int i = 0; i < waveforms; ++i) {
    const TrueEcho truth{5.0 * std::pow(100.0, generator.uniform(0.0, 1.0)),
                         generator.uniform(20.0, 44.0),
                         kWidth * std::pow(widest, generator.uniform(0.0, 1.0))};
    wrong += decomposed(decomposer, generator.gaussians({truth})).count > 1 ? 1 : 0;
  }
  return static_cast<double>(wrong) / waveforms;
}

TEST(FalseEchoes, AreRareBesideSingleEchoes) {
  EXPECT_LE(shareOfFalse(1.0, 20000), 1e-3);
  EXPECT_LE(shareOfFalse(2.0, 20000), 2e-3);  // inclined and rough surfaces
}

struct TwoEchoes {
  double found = 0.0;  ///< share of waveforms in which both are found
  EchoErrors first, second;
};

/// Waveforms of two echoes at a distance of full widths at half maximum.
TwoEchoes twoEchoes(double width, double snr, double ratio, double distance, int waveforms) {
  WaveformGenerator generator(13);
  WaveformDecomposer decomposer = decomposerFor(width);
  TwoEchoes result;
  int both = 0;
  for (int i = 0; i < waveforms; ++i) {
    const double time = generator.uniform(18.0, 38.0);
    const TrueEcho a{snr, time, width};
    const TrueEcho b{snr / ratio, time + distance * kFwhmOfGaussian * width, width};
    const Decomposition found = decomposed(decomposer, generator.gaussians({a, b}));
    if (found.count != 2) continue;
    ++both;
    addErrors(found.echo[0], a, result.first);
    addErrors(found.echo[1], b, result.second);
  }
  result.found = static_cast<double>(both) / waveforms;
  return result;
}

TEST(CloseEchoes, AreFoundAtSixTenthsOfTheWidth) {
  // A signal-to-noise ratio of 50 of the stronger echo: what remains of both beside one wide echo
  // grows with the samples of a pulse, seven here.
  EXPECT_GE(twoEchoes(7.0 / kFwhmOfGaussian, 50.0, 3.0, 0.6, 2000).found, 0.95);
  // The same of the weaker one, five samples.
  EXPECT_GE(twoEchoes(kWidth, 150.0, 3.0, 0.6, 2000).found, 0.99);
  EXPECT_GE(twoEchoes(kWidth, 50.0, 3.0, 0.7, 2000).found, 0.99);
}

TEST(CloseEchoes, HaveStandardDeviationsThatHold) {
  for (const double distance : {0.6, 0.8, 1.0, 1.5}) {
    const TwoEchoes two = twoEchoes(kWidth, 150.0, 3.0, distance, 2000);
    for (const EchoErrors* errors : {&two.first, &two.second})
      for (int part = 0; part < 3; ++part) {
        // The prior of the widths makes them smaller than stated if all widths are the same.
        EXPECT_LT(errors->relativeRms()[part], 1.15) << distance << ' ' << part;
        EXPECT_GT(errors->relativeRms()[part], 0.6) << distance << ' ' << part;
      }
  }
}

TEST(ManyEchoes, OfDifferentWidthsAreFound) {
  WaveformGenerator generator(14);
  generator.samples = 128;
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  const std::vector<TrueEcho> truth{{100, 20, kWidth}, {40, 29, 1.3 * kWidth}, {70, 41, kWidth},
                                    {25, 48, kWidth},  {90, 60, kWidth},       {50, 75, kWidth},
                                    {60, 90, kWidth},  {80, 104, kWidth}};
  int right = 0;
  for (int i = 0; i < 200; ++i) {
    const Decomposition found = decomposed(decomposer, generator.gaussians(truth));
    if (found.count != 8) continue;
    bool near = true;
    for (int k = 0; k < 8; ++k) {
      const WaveformEcho& echo = found.echo[static_cast<std::size_t>(k)];
      near = near &&
             std::abs(echo.time - truth[static_cast<std::size_t>(k)].time) < 6.0 * echo.time_std;
    }
    right += near ? 1 : 0;
  }
  EXPECT_GE(right, 190);
}

TEST(SaturatedSamples, AreBounds) {
  for (const double level : {90.0, 60.0}) {
    WaveformGenerator generator(15);
    DecompositionSettings settings;
    settings.saturation = level;
    WaveformDecomposer decomposer = decomposerFor(kWidth, settings);
    EchoErrors errors;
    int saturated = 0, others = 0;
    for (int i = 0; i < 3000; ++i) {
      const TrueEcho truth{100.0, generator.uniform(20.0, 44.0), kWidth};
      std::vector<double> counts = generator.gaussians({truth});
      int there = 0;
      for (double& y : counts) {
        there += y >= level ? 1 : 0;
        y = std::min(y, level);
      }
      const Decomposition found = decomposed(decomposer, counts);
      EXPECT_EQ(found.saturated, there);
      if (found.count != 1) {
        ++others;
        continue;
      }
      saturated += found.echo[0].saturated;
      addErrors(found.echo[0], truth, errors);
    }
    EXPECT_LE(others, 6);
    EXPECT_GT(saturated, 6000);
    for (int part = 0; part < 3; ++part) {
      EXPECT_GT(errors.relativeRms()[part], 0.9) << level << ' ' << part;
      EXPECT_LT(errors.relativeRms()[part], 1.1) << level << ' ' << part;
    }
  }
}

/// A receiver that rings: the pulse is followed by a decaying wave of a tenth of its amplitude.
double ringingPulse(double t) {
  return std::exp(-0.5 * t * t / (kWidth * kWidth)) -
         0.10 * std::exp(-0.5 * std::pow((t - 8.0) / 2.5, 2)) +
         0.05 * std::exp(-0.5 * std::pow((t - 15.0) / 2.5, 2));
}

TEST(Ringing, IsPartOfASampledResponse) {
  WaveformGenerator generator(16);
  std::vector<double> pulse;
  for (double t = -12.0; t <= 30.0; t += 0.5)
    pulse.push_back(WaveformGenerator::integrated(ringingPulse, t));
  WaveformDecomposer decomposer(PulseResponse::sampled(pulse, 0.5));
  int single = 0;
  EchoErrors errors;
  for (int i = 0; i < 2000; ++i) {
    const double time = generator.uniform(15.0, 40.0);
    const Decomposition found = decomposed(decomposer, generator.digitised([time](double t) {
      return 200.0 * ringingPulse(t - time);
    }));
    if (found.count != 1) continue;
    ++single;
    const WaveformEcho& echo = found.echo[0];
    errors.add({0.0, echo.time - time, echo.width - decomposer.response().width()},
               {1.0, echo.time_std, echo.width_std});
  }
  EXPECT_GE(single, 1996);
  EXPECT_NEAR(errors.relativeRms()[1], 1.0, 0.1);
  EXPECT_NEAR(errors.relativeRms()[2], 1.0, 0.15);
}

TEST(Ringing, ThatTheResponseLacksIsExcludedByItsSetting) {
  WaveformGenerator generator(17);
  DecompositionSettings settings;
  WaveformDecomposer without = decomposerFor(kWidth, settings);
  settings.ringing = 0.1;
  settings.ringing_reach = 20.0;
  WaveformDecomposer with = decomposerFor(kWidth, settings);
  const auto ringing = [](double t) {
    return std::exp(-0.5 * t * t / (kWidth * kWidth)) +
           0.08 * std::exp(-0.5 * std::pow((t - 10.0) / 2.5, 2));
  };
  int false_without = 0, false_with = 0, real = 0;
  for (int i = 0; i < 500; ++i) {
    const double time = generator.uniform(15.0, 35.0);
    const auto pulse = [&](double t) { return 200.0 * ringing(t - time); };
    const std::vector<double> counts = generator.digitised(pulse);
    false_without += decomposed(without, counts).count > 1 ? 1 : 0;
    false_with += decomposed(with, counts).count > 1 ? 1 : 0;
    const std::vector<double> second = generator.digitised([&](double t) {
      return pulse(t) + WaveformGenerator::powerOf({{60, time + 12, kWidth}}, t);
    });
    real += decomposed(with, second).count == 2 ? 1 : 0;
  }
  EXPECT_GE(false_without, 400);  // the ringing does look like an echo
  EXPECT_EQ(false_with, 0);
  EXPECT_GE(real, 490);  // a real echo in the same place is found
}

TEST(Decomposition, DoesNotDependOnWhatWasDecomposedBefore) {
  WaveformGenerator generator(18);
  const std::vector<double> counts = generator.gaussians({{50, 25, kWidth}, {20, 30, kWidth}});
  generator.samples = 300;
  const std::vector<double> longer = generator.gaussians({{50, 225, kWidth}});
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  const Decomposition first = decomposed(decomposer, counts);
  EXPECT_EQ(decomposed(decomposer, longer).count, 1);
  const Decomposition again = decomposed(decomposer, counts);
  ASSERT_EQ(first.count, 2);
  ASSERT_EQ(again.count, 2);
  EXPECT_EQ(first.echo[1].time, again.echo[1].time);
  EXPECT_EQ(first.echo[1].width_std, again.echo[1].width_std);
}

TEST(Decomposition, OfDegenerateWaveformsHasNoEchoes) {
  WaveformDecomposer decomposer = decomposerFor(kWidth);
  EXPECT_EQ(decomposed(decomposer, {}).count, 0);
  EXPECT_EQ(decomposed(decomposer, {1, 2, 3}).count, 0);
  EXPECT_EQ(decomposed(decomposer, std::vector<double>(64, 20.0)).count, 0);
  EXPECT_EQ(decomposed(decomposer, std::vector<double>(64, 20.0)).baseline, 20.0);
  DecompositionSettings settings;
  settings.saturation = 20.0;
  WaveformDecomposer saturated = decomposerFor(kWidth, settings);
  EXPECT_EQ(decomposed(saturated, std::vector<double>(64, 20.0)).count, 0);
  std::vector<double> without_noise(64, 20.0);
  for (int i = 0; i < 64; ++i)
    without_noise[static_cast<std::size_t>(i)] +=
        WaveformGenerator::powerOf({{100, 30.3, kWidth}}, i);
  const Decomposition exact = decomposed(decomposer, without_noise);
  ASSERT_GE(exact.count, 1);
  EXPECT_NEAR(exact.echo[0].time, 30.3, 1e-3);
}

TEST(Decomposition, RefusesWrongSettings) {
  const auto refuses = [](const std::function<void(DecompositionSettings&)>& change) {
    DecompositionSettings settings;
    change(settings);
    EXPECT_THROW(decomposerFor(kWidth, settings), UsageError);
  };
  refuses([](DecompositionSettings& s) { s.false_echoes = 0.0; });
  refuses([](DecompositionSettings& s) { s.false_echoes = 1.0; });
  refuses([](DecompositionSettings& s) { s.ringing = 1.0; });
  refuses([](DecompositionSettings& s) { s.ringing_reach = -1.0; });
  refuses([](DecompositionSettings& s) { s.width_spread = 0.0; });
  refuses([](DecompositionSettings& s) { s.most_echoes = kMostEchoes + 1; });
  refuses([](DecompositionSettings& s) { s.most_echoes = 0; });
}

}  // namespace
}  // namespace pcl_als
