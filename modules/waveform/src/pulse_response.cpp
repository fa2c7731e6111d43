// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/pulse_response.h>

#include "pulse_table.h"

namespace pcl_als {
namespace {

/// Half-width of a Gaussian echo in standard deviations; the response is 4e-6 there.
constexpr double kGaussianReach = 5.0;
/// Widths of echoes over the width of the response.
constexpr double kNarrowest = 0.5, kWidest = 10.0;
/// No echo is narrower than this, in samples: its samples would not determine it.
constexpr double kLeastSamples = 0.3;

/// Samples of a response in its width.
constexpr int kSamplesOfWidth = 4;

/// The Gaussian by a recurrence over the samples: the ratio of neighbours is itself a geometric
/// sequence, so that three exponentials serve all samples.
void evaluateGaussian(double time, double width, int first, int last, double* value,
                      double* by_time, double* by_width) {
  const double inverse = 1.0 / width;
  double x = (first - time) * inverse;
  double g = std::exp(-0.5 * x * x);
  double ratio = std::exp(-inverse * (x + 0.5 * inverse));
  const double change = std::exp(-inverse * inverse);
  const int count = last - first;
  for (int i = 0; i < count; ++i) {
    value[i] = g;
    g *= ratio;
    ratio *= change;
  }
  for (int i = 0; i < count; ++i) {
    const double distance = x + i * inverse;
    const double slope = value[i] * distance * inverse;
    by_time[i] = slope;
    by_width[i] = slope * distance;
  }
}

}  // namespace

double ResponseSamples::skewness() const {
  double sum = 0.0, mean = 0.0, variance = 0.0, third = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += values[i];
    mean += values[i] * timeOf(i);
  }
  mean /= sum;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = timeOf(i) - mean;
    variance += values[i] * t * t / sum;
    third += values[i] * t * t * t / sum;
  }
  return third / std::pow(variance, 1.5);
}

struct PulseResponse::Table : detail::PulseTable {
  using detail::PulseTable::PulseTable;
};

PulseResponse PulseResponse::gaussian(double width) {
  if (!(width > 0.0) || !std::isfinite(width))
    throw UsageError("the width of a pulse must be a positive number");
  PulseResponse response;
  response.width_ = width;
  response.least_ = std::max(kLeastSamples, kNarrowest * width);
  response.largest_ = std::max(kWidest * width, 2.0 * response.least_);
  return response;
}

PulseResponse PulseResponse::sampled(const std::vector<double>& samples, double spacing) {
  PulseResponse response;
  response.table_ = std::make_shared<const Table>(samples, spacing);
  response.width_ = response.table_->width();
  response.least_ = response.table_->leastWidth();
  response.largest_ = response.table_->largestWidth();
  return response;
}

double PulseResponse::before(double width) const {
  return table_ ? table_->before(width) : kGaussianReach * width;
}

double PulseResponse::after(double width) const {
  return table_ ? table_->after(width) : kGaussianReach * width;
}

double PulseResponse::valueAt(double time) const {
  if (time < -before(width_) || time > after(width_)) return 0.0;
  double value = 0.0, by_time = 0.0, by_width = 0.0;
  evaluate(-time, width_, 0, 1, &value, &by_time, &by_width);
  return value;
}

ResponseSamples PulseResponse::samples() const {
  ResponseSamples samples;
  samples.spacing = width_ / kSamplesOfWidth;
  samples.first = -static_cast<int>(std::ceil(before(width_) / samples.spacing));
  const int last = static_cast<int>(std::ceil(after(width_) / samples.spacing));
  for (int i = samples.first; i <= last; ++i)
    samples.values.push_back(valueAt(samples.spacing * i));
  return samples;
}

PulseResponse PulseResponse::stretched(double ratio) const {
  if (isGaussian()) return gaussian(ratio * width_);
  const ResponseSamples own = samples();
  return sampled(own.values, ratio * own.spacing);
}

void PulseResponse::evaluate(double time, double width, int first, int last, double* value,
                             double* by_time, double* by_width) const {
  if (table_)
    table_->evaluate(time, width, first, last, value, by_time, by_width);
  else
    evaluateGaussian(time, width, first, last, value, by_time, by_width);
}

}  // namespace pcl_als
