// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/waveform/pulse_response.h>

namespace pcl_als::detail {
namespace {

constexpr int kPhases = 8;               // values of the table per sample
constexpr double kStep = 1.0 / kPhases;  // samples
constexpr double kNegligible = 1e-12;    // of the terms of a series
constexpr double kLevelRatio = 1.06;     // of neighbouring widths
// Widths over that of the response, which is the third one: the derivative is not smooth there.
constexpr double kLeastRatio = 1.0 / (kLevelRatio * kLevelRatio), kLargestRatio = 8.0;
constexpr double kGaussianReach = 5.0;  // of the convolution, standard deviations
constexpr int kMargin = 3;              // values beyond what the interpolation needs
constexpr std::size_t kFewestSamples = 5;

int floorOf(double value) {
  return static_cast<int>(std::floor(value));
}

void checkSamples(const std::vector<double>& samples, double spacing) {
  if (samples.size() < kFewestSamples) throw UsageError("a pulse needs at least five samples");
  if (!(spacing > 0.0) || !std::isfinite(spacing))
    throw UsageError("the spacing of a pulse's samples must be a positive number");
  if (!std::all_of(samples.begin(), samples.end(), [](double y) { return std::isfinite(y); }))
    throw UsageError("a sample of the pulse is no number");
  const auto largest = std::max_element(samples.begin(), samples.end());
  if (*largest <= 0.0) throw UsageError("the pulse has no positive sample");
  if (largest == samples.begin() || largest == samples.end() - 1)
    throw UsageError("the largest sample of the pulse is its first or last");
}

/// Values at steps of the table; the origin is the index of the time 0.
struct Fine {
  int first = 0;                         ///< step of the first value
  std::vector<double> value, curvature;  ///< and twice the derivative by the variance

  double valueAt(int step) const { return at(value, step); }
  double curvatureAt(int step) const { return at(curvature, step); }
  int last() const { return first + static_cast<int>(value.size()) - 1; }

 private:
  double at(const std::vector<double>& of, int step) const {
    const int k = step - first;
    return k < 0 || k >= static_cast<int>(of.size()) ? 0.0 : of[static_cast<std::size_t>(k)];
  }
};

/// The band-limited function through samples, zero beyond them, as a Fourier series of a period
/// that is long enough for the largest convolution. A Gaussian of variance v multiplies the term of
/// frequency w by exp(-v w²/2). For echoes narrower than the response, v is negative, and the
/// factor is 1 - v w²/2: the exponential would enlarge noise and the steepest parts of the pulse.
class FourierPulse {
 public:
  FourierPulse(const std::vector<double>& samples, double spacing)
      : end_(spacing * static_cast<double>(samples.size() - 1)) {
    const double support = kGaussianReach * kLargestRatio * kLevelRatio * end_;
    const std::size_t period = 2 * samples.size() + static_cast<std::size_t>(support / spacing);
    base_ = 2.0 * kPi / (static_cast<double>(period) * spacing);
    for (std::size_t k = 0; 2 * k < period; ++k) {
      const double turn = 2.0 * kPi * static_cast<double>(k) / static_cast<double>(period);
      std::complex<double> sum = 0.0;
      for (std::size_t i = 0; i < samples.size(); ++i)
        sum += samples[i] * std::polar(1.0, -turn * static_cast<double>(i));
      term_.push_back(sum * ((k == 0 ? 1.0 : 2.0) / static_cast<double>(period)));
    }
  }

  double end() const { return end_; }
  double at(double t) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < term_.size(); ++k)
      sum += (term_[k] * std::polar(1.0, base_ * static_cast<double>(k) * t)).real();
    return sum;
  }
  /// The function at steps of the table from \a origin, convolved.
  Fine tabulate(double origin, int first, int last, double variance) const {
    Fine fine;
    fine.first = first;
    fine.value.assign(static_cast<std::size_t>(last - first + 1), 0.0);
    fine.curvature = fine.value;
    for (std::size_t k = 0; k < term_.size(); ++k) {
      const double frequency = base_ * static_cast<double>(k);
      const double square = frequency * frequency, exponent = -0.5 * variance * square;
      const std::complex<double> start =
          term_[k] * std::polar(1.0, frequency * (origin + first * kStep));
      const double factor = variance < 0.0 ? 1.0 + exponent : std::exp(exponent);
      const double change = -square * (variance < 0.0 ? 1.0 : factor);
      if (std::abs(start) * factor < kNegligible * std::abs(term_[0])) continue;
      const std::complex<double> turn = std::polar(1.0, frequency * kStep);
      std::complex<double> z = start;
      for (std::size_t i = 0; i < fine.value.size(); ++i, z *= turn) {
        fine.value[i] += factor * z.real();
        fine.curvature[i] += change * z.real();
      }
    }
    return fine;
  }

 private:
  double end_, base_;
  std::vector<std::complex<double>> term_;
};

/// Time of the maximum, by golden section beside the largest sample.
double peakOf(const FourierPulse& pulse, double guess, double spacing) {
  double low = guess - spacing, high = guess + spacing;
  constexpr double kGolden = 0.6180339887498949;
  while (high - low > 1e-10 * spacing) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (pulse.at(a) > pulse.at(b))
      high = b;
    else
      low = a;
  }
  return 0.5 * (low + high);
}

/// Time from the peak to the half maximum, in the direction of \a step.
double halfMaximum(const FourierPulse& pulse, double peak, double step) {
  const double half = 0.5 * pulse.at(peak);
  double outside = peak;
  while (outside >= 0.0 && outside <= pulse.end() && pulse.at(outside) > half) outside += step;
  double inside = outside - step;
  while (std::abs(outside - inside) > 1e-10) {
    const double middle = 0.5 * (inside + outside);
    (pulse.at(middle) > half ? inside : outside) = middle;
  }
  return std::abs(outside - peak);
}

/// Weights of four values at -1, 0, 1, 2 for the place f in [0, 1), and their derivatives.
void lagrange(double f, std::array<double, 4>& weight, std::array<double, 4>& slope) {
  weight = {-f * (f - 1.0) * (f - 2.0) / 6.0, (f + 1.0) * (f - 1.0) * (f - 2.0) / 2.0,
            -f * (f + 1.0) * (f - 2.0) / 2.0, f * (f + 1.0) * (f - 1.0) / 6.0};
  slope = {-(3.0 * f * f - 6.0 * f + 2.0) / 6.0, (3.0 * f * f - 4.0 * f - 1.0) / 2.0,
           -(3.0 * f * f - 2.0 * f - 2.0) / 2.0, (3.0 * f * f - 1.0) / 6.0};
}

}  // namespace

PulseTable::PulseTable(const std::vector<double>& samples, double spacing) {
  checkSamples(samples, spacing);
  const FourierPulse pulse(samples, spacing);
  const auto largest = std::max_element(samples.begin(), samples.end()) - samples.begin();
  const double peak = peakOf(pulse, spacing * static_cast<double>(largest), spacing);
  width_ = (halfMaximum(pulse, peak, -kStep) + halfMaximum(pulse, peak, kStep)) / kFwhmOfGaussian;
  for (double ratio = kLeastRatio; ratio < kLargestRatio * kLevelRatio; ratio *= kLevelRatio) {
    const double width = ratio * width_, variance = width * width - width_ * width_;
    const double reach = kGaussianReach * std::sqrt(std::max(0.0, variance));
    const Fine level = pulse.tabulate(peak, floorOf(-(peak + reach) / kStep),
                                      floorOf((pulse.end() - peak + reach) / kStep), variance);
    addLevel(width, level.first, level.value, level.curvature);
  }
}

void PulseTable::addLevel(double width, int first_step, const std::vector<double>& values,
                          const std::vector<double>& curvatures) {
  const Fine given{first_step, values, curvatures};
  const auto top = std::max_element(values.begin() + 1, values.end() - 1);
  const int peak = first_step + static_cast<int>(top - values.begin());
  // The maximum lies between the steps, at the vertex of the parabola through three values.
  const double a = given.valueAt(peak - 1), b = given.valueAt(peak), c = given.valueAt(peak + 1);
  const double offset = 0.5 * (a - c) / (a - 2.0 * b + c);
  const double largest = b - 0.25 * (a - c) * offset;
  // By the logarithm of the width u: u d/du = u² d²/dt².
  const double factor = width * width;
  const double largest_change = factor * given.curvatureAt(peak);
  Level level;
  level.first = kPhases * (floorOf(static_cast<double>(first_step) / kPhases) - 1);
  level.columns = (given.last() - level.first) / kPhases + 2 + kMargin;
  for (int phase = 0; phase < kPhases; ++phase)
    for (int column = 0; column < level.columns; ++column) {
      const int step = level.first + column * kPhases + phase;
      const double value = given.valueAt(step) / largest;
      level.value.push_back(value);
      level.by_log_width.push_back((factor * given.curvatureAt(step) - value * largest_change) /
                                   largest);
    }
  levels_.push_back(std::move(level));
}

double PulseTable::leastWidth() const {
  return kLeastRatio * width_;
}
double PulseTable::largestWidth() const {
  return kLargestRatio * width_;
}

PulseTable::Place PulseTable::placeOf(double width) const {
  const double place = std::log(width / (kLeastRatio * width_)) / std::log(kLevelRatio);
  const double last = static_cast<double>(levels_.size() - 2);
  const double level = std::clamp(std::floor(place), 0.0, last);
  return {static_cast<std::size_t>(level), place - level};
}

double PulseTable::before(double width) const {
  const Level& level = levels_[placeOf(width).level];
  return -(level.first + kPhases) * kStep;
}

double PulseTable::after(double width) const {
  const Level& level = levels_[placeOf(width).level];
  return (level.first + (level.columns - kMargin) * kPhases) * kStep;
}

void PulseTable::evaluate(double time, double width, int first, int last, double* value,
                          double* by_time, double* by_width) const {
  const int count = last - first;
  std::fill(value, value + count, 0.0);
  std::fill(by_time, by_time + count, 0.0);
  std::fill(by_width, by_width + count, 0.0);
  const Place place = placeOf(width);
  const double s = place.fraction, h = std::log(kLevelRatio);
  const double t = 1.0 - s;
  // Hermite weights of value and derivative at both levels, and their derivatives by log width.
  const double weight[2][2] = {{(1.0 + 2.0 * s) * t * t, h * s * t * t},
                               {s * s * (3.0 - 2.0 * s), -h * s * s * t}};
  const double change[2][2] = {{-6.0 * s * t / h, (1.0 - 3.0 * s) * t},
                               {6.0 * s * t / h, s * (3.0 * s - 2.0)}};
  const double steps = (first - time) * kPhases;
  const int base = floorOf(steps);
  std::array<double, 4> in_time{}, slope{};
  lagrange(steps - base, in_time, slope);
  for (std::size_t k = 0; k < 2; ++k) {
    const Level& level = levels_[place.level + k];
    for (int tap = 0; tap < 4; ++tap) {
      const int index = base + tap - 1 - level.first;
      const int column = floorOf(static_cast<double>(index) / kPhases);
      const std::size_t at =
          static_cast<std::size_t>((index - column * kPhases) * level.columns + column);
      const double* v = &level.value[at];
      const double* d = &level.by_log_width[at];
      const double wt = in_time[static_cast<std::size_t>(tap)];
      const double ws = -kPhases * slope[static_cast<std::size_t>(tap)];
      const double vv = wt * weight[k][0], vd = wt * weight[k][1];
      const double tv = ws * weight[k][0], td = ws * weight[k][1];
      const double wv = wt * change[k][0] / width, wd = wt * change[k][1] / width;
      for (int i = 0; i < count; ++i) {
        value[i] += vv * v[i] + vd * d[i];
        by_time[i] += tv * v[i] + td * d[i];
        by_width[i] += wv * v[i] + wd * d[i];
      }
    }
  }
}

}  // namespace pcl_als::detail
