// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "echo_fit.h"

#include <algorithm>
#include <cmath>

#include "small_cholesky.h"

namespace pcl_als::detail {
namespace {

constexpr int kMostIterations = 40;
constexpr double kFirstDamping = 1e-4, kLeastDamping = 1e-7, kMostDamping = 1e7;
/// The adjustment ends if a step would lower the sum of squares by less than this share of the
/// variance of a sample: 0.03 standard deviations of a parameter.
constexpr double kConverged = 1e-3;
/// Largest change of a width in one step, as factor, and of a time, in widths.
constexpr double kLargestChange = 1.6, kLargestShift = 1.5;

double dot(const double* a, const double* b, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

double total(const double* a, int count) {
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += a[i];
  return sum;
}

}  // namespace

void EchoFit::setSamples(const double* counts, const signed char* bound, int samples) {
  counts_ = counts;
  bound_ = bound;
  samples_ = samples;
  const auto size = static_cast<std::size_t>(samples);
  if (size <= stride_) return;
  stride_ = size;
  residual_.resize(size);
  columns_.resize(size * 3 * kMostEchoes);
}

/// Responses and residuals; the columns are scaled to derivatives of the model.
void EchoFit::evaluateEchoes(const EchoModel& model) {
  for (int i = 0; i < samples_; ++i)
    residual_[static_cast<std::size_t>(i)] = counts_[i] - model.baseline;
  int next = 1;
  for (int j = 0; j < model.count; ++j) {
    const EchoParameters& e = model.echo[static_cast<std::size_t>(j)];
    const double from = std::ceil(e.time - response_.before(e.width));
    const double to = std::floor(e.time + response_.after(e.width)) + 1.0;
    const int low = static_cast<int>(std::clamp(from, 0.0, static_cast<double>(samples_)));
    const int high =
        static_cast<int>(std::clamp(to, static_cast<double>(low), static_cast<double>(samples_)));
    low_[static_cast<std::size_t>(j)] = low;
    high_[static_cast<std::size_t>(j)] = high;
    first_[static_cast<std::size_t>(j)] = next;
    next += e.free_width ? 3 : 2;
    double* value = columns_.data() + static_cast<std::size_t>(3 * j) * stride_;
    double* by_time = value + stride_;
    double* by_width = by_time + stride_;
    response_.evaluate(e.time, e.width, low, high, value, by_time, by_width);
    double* residual = residual_.data() + low;
    for (int i = 0; i < high - low; ++i) {
      residual[i] -= e.amplitude * value[i];
      by_time[i] *= e.amplitude;
      by_width[i] *= e.amplitude;
    }
  }
  size_ = next;
}

/// Takes out the samples that are bounds which the model keeps.
void EchoFit::applyBounds() {
  used_ = samples_;
  if (bound_ == nullptr) return;
  for (int i = 0; i < samples_; ++i) {
    double& residual = residual_[static_cast<std::size_t>(i)];
    if (bound_[i] == 0 || residual * bound_[i] > 0.0) continue;
    residual = 0.0;
    --used_;
  }
}

/// Products of the columns of two echoes over the samples that both have, without unused samples.
void EchoFit::addBlock(const EchoModel& model, int a, int b) {
  const int low = std::max(rangeFirst(a), rangeFirst(b));
  const int count = std::min(rangeLast(a), rangeLast(b)) - low;
  const int na = model.echo[static_cast<std::size_t>(a)].free_width ? 3 : 2;
  const int nb = model.echo[static_cast<std::size_t>(b)].free_width ? 3 : 2;
  for (int p = 0; p < na; ++p)
    for (int q = a == b ? p : 0; q < nb; ++q) {
      const double value = count <= 0 ? 0.0
                                      : dot(column(a, p) + (low - rangeFirst(a)),
                                            column(b, q) + (low - rangeFirst(b)), count);
      normal_[static_cast<std::size_t>(index(a, p) * size_ + index(b, q))] = value;
      normal_[static_cast<std::size_t>(index(b, q) * size_ + index(a, p))] = value;
    }
}

void EchoFit::accumulate(const EchoModel& model) {
  if (bound_ != nullptr)
    for (int j = 0; j < model.count; ++j)
      for (int i = rangeFirst(j); i < rangeLast(j); ++i)
        if (bound_[i] != 0 && residual_[static_cast<std::size_t>(i)] == 0.0)
          for (int part = 0; part < 3; ++part)
            columns_[static_cast<std::size_t>(3 * j + part) * stride_ +
                     static_cast<std::size_t>(i - rangeFirst(j))] = 0.0;
  normal_[0] = used_;
  gradient_[0] = total(residual_.data(), samples_);
  for (int a = 0; a < model.count; ++a) {
    const int count = rangeLast(a) - rangeFirst(a);
    const int parts = model.echo[static_cast<std::size_t>(a)].free_width ? 3 : 2;
    for (int p = 0; p < parts; ++p) {
      const int at = index(a, p);
      const double sum = total(column(a, p), count);
      normal_[static_cast<std::size_t>(at)] = sum;
      normal_[static_cast<std::size_t>(at * size_)] = sum;
      gradient_[static_cast<std::size_t>(at)] =
          dot(column(a, p), residual_.data() + rangeFirst(a), count);
    }
    for (int b = a; b < model.count; ++b) addBlock(model, a, b);
  }
}

double EchoFit::evaluate(const EchoModel& model, double noise) {
  evaluateEchoes(model);
  applyBounds();
  accumulate(model);
  if (noise > 0.0) addPriors(model, noise);
  return dot(residual_.data(), residual_.data(), samples_);
}

double EchoFit::priorSum(const EchoModel& model, double noise) const {
  double sum = 0.0;
  for (int j = 0; j < model.count; ++j) {
    const EchoParameters& e = model.echo[static_cast<std::size_t>(j)];
    if (!e.free_width || e.width_prior <= 0.0) continue;
    const double r = noise * (e.width - response_.width()) / e.width_prior;
    sum += r * r;
  }
  return sum;
}

void EchoFit::addPriors(const EchoModel& model, double noise) {
  for (int j = 0; j < model.count; ++j) {
    const EchoParameters& e = model.echo[static_cast<std::size_t>(j)];
    if (!e.free_width || e.width_prior <= 0.0) continue;
    const int at = index(j, 2);
    const double weight = noise * noise / (e.width_prior * e.width_prior);
    normal_[static_cast<std::size_t>(at * size_ + at)] += weight;
    gradient_[static_cast<std::size_t>(at)] -= weight * (e.width - response_.width());
  }
}

/// \return false if the damped normal equations are singular
bool EchoFit::step(const EchoModel& from, double damping, EchoModel& to) {
  const auto n = static_cast<std::size_t>(size_);
  std::array<double, kMostParameters> change{};  // of which only size_ are used
  std::copy_n(normal_.data(), n * n, factor_.data());
  for (std::size_t a = 0; a < n; ++a) factor_[a * n + a] *= 1.0 + damping;
  if (!factorise(factor_.data(), size_)) return false;
  std::copy_n(gradient_.data(), n, change.data());
  solve(factor_.data(), size_, change.data());
  predicted_ = 0.0;
  for (std::size_t a = 0; a < n; ++a) predicted_ += change[a] * gradient_[a];
  to = from;
  to.baseline += change[0];
  for (int j = 0; j < from.count; ++j) {
    EchoParameters& e = to.echo[static_cast<std::size_t>(j)];
    const auto at = static_cast<std::size_t>(index(j, 0));
    e.amplitude = std::max(e.amplitude + change[at], 0.0);
    const double shift = kLargestShift * e.width;
    e.time = std::clamp(e.time + std::clamp(change[at + 1], -shift, shift), -1.0,
                        static_cast<double>(samples_));
    if (!e.free_width) continue;
    const double width =
        std::clamp(e.width + change[at + 2], e.width / kLargestChange, e.width * kLargestChange);
    e.width = std::clamp(width, response_.leastWidth(), response_.largestWidth());
  }
  return true;
}

FitResult EchoFit::fit(EchoModel& model, double noise) {
  FitResult result;
  EchoModel next;
  double sum = evaluate(model, noise) + priorSum(model, noise);
  double damping = kFirstDamping;
  bool current = true;  // the normal equations are those of the model
  while (result.iterations < kMostIterations && damping < kMostDamping) {
    if (!current) {
      evaluate(model, noise);
      current = true;
    }
    if (!step(model, damping, next)) {
      damping = std::max(10.0 * damping, 1e-3);
      continue;
    }
    const double variance = sum / std::max(1, used_ - size_);
    if (predicted_ <= kConverged * variance) {
      result.converged = true;
      break;
    }
    ++result.iterations;
    const double sum_next = evaluate(next, noise) + priorSum(next, noise);
    if (sum_next <= sum) {
      model = next;
      sum = sum_next;
      damping = std::max(0.1 * damping, kLeastDamping);
    } else {
      damping = std::max(10.0 * damping, 1e-3);
      current = false;
    }
  }
  if (!current) evaluate(model, noise);
  result.sum = dot(residual_.data(), residual_.data(), samples_);
  result.used = used_;
  return result;
}

bool EchoFit::invert() {
  const auto n = static_cast<std::size_t>(size_);
  std::copy_n(normal_.data(), n * n, factor_.data());
  if (!factorise(factor_.data(), size_)) return false;
  invertFactorised(factor_.data(), size_, inverse_.data());
  return true;
}

double EchoFit::projectedSquare(int echo, const double* values) const {
  const int count = rangeLast(echo) - rangeFirst(echo);
  std::array<double, 4> v{total(values, count), dot(column(echo, 0), values, count),
                          dot(column(echo, 1), values, count), dot(column(echo, 2), values, count)};
  const int parts = size_ > index(echo, 0) + 2 ? 4 : 3;
  double square = dot(values, values, count);
  for (int p = 0; p < parts; ++p)
    for (int q = 0; q < parts; ++q) {
      const int a = p == 0 ? 0 : index(echo, p - 1), b = q == 0 ? 0 : index(echo, q - 1);
      square -= v[static_cast<std::size_t>(p)] * cofactor(a, b) * v[static_cast<std::size_t>(q)];
    }
  return square;
}

}  // namespace pcl_als::detail
