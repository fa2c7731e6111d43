// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/waveform_decomposer.h>

#include "echo_search.h"

namespace pcl_als {
namespace {

constexpr std::size_t kFewestSamples = 6;
/// Second-order terms of the variances of amplitude, time and width of a Gaussian echo: the
/// variance of the adjustment is multiplied by 1 + term / energy, with the energy of the echo over
/// the variance of a sample.
constexpr double kSecondOrder[] = {3.0, 11.0, 24.0};

void check(const DecompositionSettings& s) {
  if (!(s.false_echoes > 0.0 && s.false_echoes < 1.0))
    throw UsageError("the number of false echoes in a waveform must lie between 0 and 1");
  if (!(s.ringing >= 0.0 && s.ringing < 1.0) || !(s.ringing_reach >= 0.0))
    throw UsageError("the ringing must lie between 0 and 1, and its reach must not be negative");
  if (!(s.width_spread > 0.0)) throw UsageError("the spread of widths must be positive");
  if (s.most_echoes < 1 || s.most_echoes > kMostEchoes)
    throw UsageError("the number of echoes must lie between 1 and " + std::to_string(kMostEchoes));
}

}  // namespace

struct WaveformDecomposer::State {
  PulseResponse response;
  DecompositionSettings settings;
  detail::EchoSearch search;
  std::vector<signed char> bound;

  State(PulseResponse given, const DecompositionSettings& wanted)
      : response(std::move(given)), settings(wanted), search(response, settings) {}

  /// Marks and counts saturated and clipped samples.
  void markBounds(const double* counts, std::size_t samples, Decomposition& result) {
    result.saturated = result.clipped = 0;
    bound.resize(samples);
    for (std::size_t i = 0; i < samples; ++i) {
      const int high = counts[i] >= settings.saturation ? 1 : 0;
      const int low = counts[i] <= settings.clipping ? 1 : 0;
      bound[i] = static_cast<signed char>(high - low);
      result.saturated += high;
      result.clipped += low;
    }
  }

  int saturatedNear(const WaveformEcho& echo) const {
    const double reach = 0.5 * kFwhmOfGaussian * echo.width;
    const double last = static_cast<double>(bound.size()) - 1.0;
    const int from = static_cast<int>(std::clamp(std::ceil(echo.time - reach), 0.0, last));
    const int to = static_cast<int>(std::clamp(std::floor(echo.time + reach), -1.0, last));
    int n = 0;
    for (int i = from; i <= to; ++i) n += bound[static_cast<std::size_t>(i)] > 0 ? 1 : 0;
    return n;
  }

  /// Standard deviation of Student's distribution: the noise is estimated from few samples.
  double studentFactor() {
    const int redundancy = search.used() - search.fit().size();
    return redundancy > 2 ? std::sqrt(redundancy / (redundancy - 2.0)) : std::sqrt(3.0);
  }

  void take(const detail::EchoModel& model, Decomposition& result) {
    detail::EchoFit& fit = search.fit();
    const bool regular = fit.invert();
    const double noise = search.noise(), student = studentFactor();
    const auto deviation = [&](int at) {
      return regular ? student * noise * std::sqrt(fit.cofactor(at, at))
                     : std::numeric_limits<double>::quiet_NaN();
    };
    /// Of a part of an echo, with the second-order term.
    const auto echoDeviation = [&](int echo, int part) {
      const int amplitude = fit.index(echo, 0);
      const double a = model.echo[static_cast<std::size_t>(echo)].amplitude;
      const double energy = a * a * fit.normal(amplitude, amplitude);
      return deviation(fit.index(echo, part)) *
             std::sqrt(1.0 + kSecondOrder[part] * noise * noise / energy);
    };
    result.count = model.count;
    result.baseline = model.baseline;
    result.baseline_std = deviation(0);
    for (int j = 0; j < model.count; ++j) {
      const detail::EchoParameters& e = model.echo[static_cast<std::size_t>(j)];
      WaveformEcho& echo = result.echo[static_cast<std::size_t>(j)];
      echo.amplitude = e.amplitude;
      echo.time = e.time;
      echo.width = e.width;
      echo.amplitude_std = echoDeviation(j, 0);
      echo.time_std = echoDeviation(j, 1);
      echo.width_std = echoDeviation(j, 2);
      echo.saturated = result.saturated > 0 ? saturatedNear(echo) : 0;
    }
    std::sort(result.echo.begin(), result.echo.begin() + result.count,
              [](const WaveformEcho& a, const WaveformEcho& b) { return a.time < b.time; });
  }
};

WaveformDecomposer::WaveformDecomposer(PulseResponse response,
                                       const DecompositionSettings& settings) {
  check(settings);
  state_ = std::make_unique<State>(std::move(response), settings);
}
WaveformDecomposer::~WaveformDecomposer() = default;
WaveformDecomposer::WaveformDecomposer(WaveformDecomposer&&) noexcept = default;

const PulseResponse& WaveformDecomposer::response() const {
  return state_->response;
}

void WaveformDecomposer::decompose(const double* counts, std::size_t samples,
                                   Decomposition& result) {
  State& s = *state_;
  result.count = result.iterations = 0;
  s.markBounds(counts, samples, result);
  if (samples < kFewestSamples) {
    result.baseline = result.baseline_std = result.noise = 0.0;
    return;
  }
  const signed char* bound = result.saturated + result.clipped > 0 ? s.bound.data() : nullptr;
  const detail::EchoModel& model = s.search.search(counts, bound, static_cast<int>(samples));
  s.take(model, result);
  result.noise = s.search.noise();
  result.iterations = s.search.iterations();
}

}  // namespace pcl_als
