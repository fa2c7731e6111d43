// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <utility>

#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/waveform/pulse_estimate.h>
#include <pcl_als/waveform/waveform_decomposer.h>

#include "pulse_average.h"

namespace pcl_als {
namespace {

using detail::AlignedEcho;
using detail::AveragedPulse;

/// Share of the widths in the shortest interval.
constexpr double kShare = 0.3;
/// Standard deviation of a width over the width, above which an echo is too weak.
constexpr double kLargestRelativeStd = 0.05;
constexpr int kRoundsOfWidth = 3, kRoundsOfShape = 8;
/// Change of the shape between two rounds that ends the estimate, of its maximum.
constexpr double kLeastChange = 5e-4;
/// Distances of the knots of the shape that are tried, in its width. The finest resolves a pulse
/// whose slope changes at its maximum, the coarsest leaves least noise.
constexpr double kKnotSpacings[] = {0.25, 0.35, 0.5, 0.7};
/// A shape replaces the Gaussian if it is better by this chi-square in the mean of the echoes and
/// by as many standard deviations.
constexpr double kLeastGain = 1.0, kSignificantGain = 4.0;

/// Full width at half maximum of the largest value above the least fifth of a waveform, in samples.
double fullWidth(const std::vector<double>& counts) {
  std::vector<double> sorted = counts;
  const auto base = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 5);
  std::nth_element(sorted.begin(), base, sorted.end());
  const auto top = std::max_element(counts.begin(), counts.end());
  const double half = 0.5 * (*top + *base);
  auto low = top, high = top;
  while (low != counts.begin() && *low > half) --low;
  while (high != counts.end() && *high > half) ++high;
  return static_cast<double>(high - low) - 1.0;
}

struct Interval {
  double low = 0.0, high = 0.0;
  double middle() const { return 0.5 * (low + high); }
};

/// The shortest interval that holds a share of the values, which are not empty: its middle is the
/// mode of a distribution that is skewed.
Interval shortestInterval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  const auto within = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::ceil(kShare * static_cast<double>(n))), 1, n);
  std::size_t best = 0;
  for (std::size_t i = 0; i + within <= n; ++i)
    if (values[i + within - 1] - values[i] < values[best + within - 1] - values[best]) best = i;
  return {values[best], values[best + within - 1]};
}

using Waveforms = std::vector<std::vector<double>>;

double halfMaximumWidth(const Waveforms& waveforms) {
  std::vector<double> widths;
  for (const std::vector<double>& counts : waveforms) widths.push_back(fullWidth(counts));
  return std::max(1.0, shortestInterval(widths).middle()) / kFwhmOfGaussian;
}

/// Width of a Gaussian from the single echoes that it finds.
std::optional<double> widthOfGaussian(const Waveforms& waveforms) {
  double width = halfMaximumWidth(waveforms);
  for (int round = 0; round < kRoundsOfWidth; ++round) {
    WaveformDecomposer decomposer(PulseResponse::gaussian(width));
    Decomposition found;
    std::vector<double> widths;
    for (const std::vector<double>& counts : waveforms) {
      decomposer.decompose(counts.data(), counts.size(), found);
      const WaveformEcho& echo = found.echo[0];
      if (found.count == 1 && echo.width_std < kLargestRelativeStd * echo.width)
        widths.push_back(echo.width);
    }
    if (widths.size() < PulseEstimate::kLeastSingleEchoes) return std::nullopt;
    width = shortestInterval(widths).middle();
  }
  return width;
}

/// Strong single echoes of the commonest width, as a response finds them.
/// \param most_echoes that are looked for: 1 while the response is a first guess, with which a
/// single echo of another shape would be taken for several ones
std::vector<AlignedEcho> singleEchoes(const Waveforms& waveforms, const PulseResponse& response,
                                      int most_echoes) {
  DecompositionSettings settings;
  settings.most_echoes = most_echoes;
  settings.clipping = 0.0;
  WaveformDecomposer decomposer(response, settings);
  Decomposition found;
  std::vector<AlignedEcho> echoes;
  std::vector<double> widths;
  for (const std::vector<double>& counts : waveforms) {
    decomposer.decompose(counts.data(), counts.size(), found);
    const WaveformEcho& echo = found.echo[0];
    if (found.count != 1 || found.clipped > 0) continue;
    if (!(echo.width_std < kLargestRelativeStd * echo.width)) continue;
    echoes.push_back({&counts, echo.amplitude, echo.time});
    widths.push_back(echo.width);
  }
  if (echoes.empty()) return echoes;
  const Interval common = shortestInterval(widths);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < echoes.size(); ++i)
    if (widths[i] >= common.low && widths[i] <= common.high) echoes[kept++] = echoes[i];
  echoes.resize(kept);
  return echoes;
}

/// The averaged echoes as a response; none if they are no pulse.
std::optional<PulseResponse> responseOf(const std::vector<AlignedEcho>& echoes, double width,
                                        double knot_spacing) {
  const AveragedPulse mean = averagePulse(echoes, width, knot_spacing);
  const auto top = std::max_element(mean.values.begin(), mean.values.end());
  if (top == mean.values.end() || !(*top > 0.0)) return std::nullopt;
  return PulseResponse::sampled(mean.values, mean.spacing);
}

/// Largest difference of two responses, as share of their maximum.
double difference(const PulseResponse& a, const PulseResponse& b) {
  const ResponseSamples of_a = a.samples();
  double largest = 0.0;
  for (std::size_t i = 0; i < of_a.values.size(); ++i)
    largest = std::max(largest, std::abs(of_a.values[i] - b.valueAt(of_a.timeOf(i))));
  return largest;
}

/// Finds single echoes and averages them in turns, from a Gaussian. None for too few echoes.
std::vector<AlignedEcho> alignedEchoes(const Waveforms& waveforms, PulseResponse& response) {
  std::vector<AlignedEcho> echoes;
  for (int round = 0; round < kRoundsOfShape; ++round) {
    echoes = singleEchoes(waveforms, response, round == 0 ? 1 : kMostEchoes);
    if (echoes.size() < PulseEstimate::kLeastEchoesOfShape) break;
    const auto next = responseOf(echoes, response.width(), kKnotSpacings[0]);
    if (!next) return {};
    const double change = difference(*next, response);
    response = *next;
    if (change < kLeastChange) break;
  }
  return echoes;
}

/// Sum of the squared residuals of a waveform with one echo at most.
double residualSquares(const std::vector<double>& counts, WaveformDecomposer& decomposer) {
  Decomposition found;
  decomposer.decompose(counts.data(), counts.size(), found);
  const PulseResponse& response = decomposer.response();
  std::vector<double> model(counts.size(), 0.0), by_time(counts.size()), by_width(counts.size());
  if (found.count > 0) {
    const WaveformEcho& echo = found.echo[0];
    const double from = echo.time - response.before(echo.width),
                 to = echo.time + response.after(echo.width);
    const int first = std::max(0, static_cast<int>(std::ceil(from)));
    const int last = std::min(static_cast<int>(counts.size()), static_cast<int>(to) + 1);
    if (first < last)
      response.evaluate(echo.time, echo.width, first, last, &model[static_cast<std::size_t>(first)],
                        by_time.data(), by_width.data());
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double amplitude = found.count > 0 ? found.echo[0].amplitude : 0.0;
    const double residual = counts[i] - found.baseline - amplitude * model[i];
    sum += residual * residual;
  }
  return sum;
}

/// Adds the gains of a response over a Gaussian for echoes that it was not estimated from.
void addGains(const std::vector<AlignedEcho>& echoes, const PulseResponse& response,
              RunningStatistics& gains) {
  DecompositionSettings settings;
  settings.most_echoes = 1;
  WaveformDecomposer shape(response, settings);
  WaveformDecomposer gaussian(PulseResponse::gaussian(response.width()), settings);
  for (const AlignedEcho& echo : echoes) {
    const double by_shape = residualSquares(*echo.counts, shape),
                 by_gaussian = residualSquares(*echo.counts, gaussian);
    if (by_shape > 0.0 && by_gaussian > 0.0)
      gains.add(static_cast<double>(echo.counts->size()) * std::log(by_gaussian / by_shape));
  }
}

/// Compares the shape of each half of the echoes with a Gaussian in the other half.
RunningStatistics gainsOf(const std::vector<AlignedEcho>& echoes, double width,
                          double knot_spacing) {
  std::vector<AlignedEcho> half[2];
  for (std::size_t i = 0; i < echoes.size(); ++i) half[i % 2].push_back(echoes[i]);
  RunningStatistics gains;
  for (int k = 0; k < 2; ++k)
    if (const auto response = responseOf(half[k], width, knot_spacing))
      addGains(half[1 - k], *response, gains);
  return gains;
}

/// The mean shape with the distance of knots that fits best; none for too few echoes.
std::optional<EstimatedPulse> shapeOf(const Waveforms& waveforms, std::size_t& found) {
  PulseResponse response = PulseResponse::gaussian(halfMaximumWidth(waveforms));
  const std::vector<AlignedEcho> echoes = alignedEchoes(waveforms, response);
  found = echoes.size();
  if (found < PulseEstimate::kLeastEchoesOfShape) return std::nullopt;
  std::optional<EstimatedPulse> best;
  for (const double knot_spacing : kKnotSpacings) {
    const RunningStatistics gains = gainsOf(echoes, response.width(), knot_spacing);
    if (gains.count() < 2 || (best && gains.mean() <= best->gain)) continue;
    const auto shape = responseOf(echoes, response.width(), knot_spacing);
    if (!shape) continue;
    best = {*shape, found, gains.mean(),
            gains.standardDeviation() / std::sqrt(static_cast<double>(gains.count()))};
  }
  return best;
}

}  // namespace

void PulseEstimate::add(const std::vector<double>& counts, double saturation) {
  const bool saturated =
      std::any_of(counts.begin(), counts.end(), [saturation](double y) { return y >= saturation; });
  if (!saturated && counts.size() > 5) waveforms_.push_back(counts);
}

std::optional<EstimatedPulse> PulseEstimate::estimate() const {
  if (waveforms_.size() < kLeastSingleEchoes) return std::nullopt;
  std::size_t echoes = 0;
  const std::optional<EstimatedPulse> shape = shapeOf(waveforms_, echoes);
  if (shape && shape->gain > std::max(kLeastGain, kSignificantGain * shape->gain_std)) return shape;
  const std::optional<double> width = widthOfGaussian(waveforms_);
  if (!width) return std::nullopt;
  const PulseResponse gaussian = PulseResponse::gaussian(*width);
  if (!shape) return EstimatedPulse{gaussian, echoes};
  return EstimatedPulse{gaussian, echoes, shape->gain, shape->gain_std};
}

std::string describe(const EstimatedPulse& pulse) {
  if (!pulse.response.isGaussian())
    return "skewness " + numberText(pulse.response.samples().skewness(), 2) +
           ", from the samples of " + grouped(pulse.echoes) +
           " single echoes, which a Gaussian does not fit";
  if (pulse.gain_std == 0.0)
    return "a Gaussian: too few strong single echoes of this width (" + grouped(pulse.echoes) +
           ", " + std::to_string(PulseEstimate::kLeastEchoesOfShape) +
           " are needed) to estimate its shape";
  return "a Gaussian, which fits the samples of " + grouped(pulse.echoes) +
         " single echoes as well as their mean shape";
}

}  // namespace pcl_als
