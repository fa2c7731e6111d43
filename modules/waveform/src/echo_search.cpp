// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "echo_search.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace pcl_als::detail {
namespace {

/// Values of the matched filter below this share of the maximum are excluded.
constexpr double kKernelShare = 0.1;
/// Share of a penalty at which a full adjustment is tried.
constexpr double kScreening = 0.6;
/// A width differs from that of the response if by this many standard deviations.
constexpr double kWiderBy = 2.0;
/// Least variance of whole numbers: 1/12 of rounding and 1/12 of noise that a baseline may hide.
constexpr double kRoundedVariance = 1.0 / 6.0;
/// Score of a split, squared, above which it is tried.
constexpr double kSplitScore = 4.5;
/// Echoes overlap if closer than this many widths.
constexpr double kOverlap = 4.0;
/// Echoes closer than this many widths of the response may be one wide echo.
constexpr double kMergeReach = 3.5;
constexpr double kEchoPenalty = 4.0, kSplitPenalty = 2.9;
constexpr double kReferenceSamples = 64.0, kLeastSamples = 16.0;

bool areWhole(const double* counts, int samples) {
  constexpr double kLargest = 1e15;
  for (int i = 0; i < samples; ++i) {
    if (!(std::abs(counts[i]) < kLargest)) return false;
    if (static_cast<double>(static_cast<std::int64_t>(counts[i])) != counts[i]) return false;
  }
  return true;
}

}  // namespace

Penalties penaltiesFor(double false_echoes, int samples) {
  // -2 ln p for an echo anywhere, whose places grow with the samples, and -ln p for the single
  // degree of freedom by which two echoes differ from a wide one; both calibrated by simulation.
  const double places = std::max(kLeastSamples, static_cast<double>(samples)) / kReferenceSamples;
  Penalties p;
  p.echo = kEchoPenalty - 2.0 * std::log(false_echoes) + 2.0 * std::log(places);
  p.width = p.echo - (kSplitPenalty - std::log(false_echoes));
  return p;
}

EchoSearch::EchoSearch(const PulseResponse& response, const DecompositionSettings& settings)
    : response_(response), settings_(settings), fit_(response) {
  const double width = response.width();
  const int before = static_cast<int>(response.before(width));
  const int count = before + static_cast<int>(response.after(width)) + 1;
  std::vector<double> value(static_cast<std::size_t>(count)), unused(value);
  response.evaluate(0.0, width, -before, count - before, value.data(), unused.data(),
                    unused.data());
  int first = 0, last = count - 1;
  while (std::abs(value[static_cast<std::size_t>(first)]) < kKernelShare) ++first;
  while (std::abs(value[static_cast<std::size_t>(last)]) < kKernelShare) --last;
  kernel_.assign(value.begin() + first, value.begin() + last + 1);
  kernel_first_ = first - before;
  for (const double k : kernel_) kernel_square_ += k * k;
}

/// filtered_[i]: sum of kernel times residual for an echo at sample i; zero where the kernel leaves
/// the waveform.
void EchoSearch::matchedFilter(const double* residual, int samples) {
  const int taps = static_cast<int>(kernel_.size());
  filtered_.resize(static_cast<std::size_t>(samples));
  std::fill(filtered_.begin(), filtered_.end(), 0.0);
  const int low = std::max(0, -kernel_first_);
  const int high = samples - std::max(0, kernel_first_ + taps - 1);
  double* out = filtered_.data();
  for (int k = 0; k < taps; ++k) {
    const double weight = kernel_[static_cast<std::size_t>(k)];
    const double* in = residual + kernel_first_ + k;
    for (int i = low; i < high; ++i) out[i] += weight * in[i];
  }
  // At the ends with the part of the kernel that lies within.
  for (int i = 0; i < samples; i = i + 1 == low ? std::max(low, high) : i + 1) {
    if (i >= low && i < high) continue;
    double sum = 0.0, square = 0.0;
    for (int k = 0; k < taps; ++k) {
      const int at = i + kernel_first_ + k;
      if (at < 0 || at >= samples) continue;
      sum += kernel_[static_cast<std::size_t>(k)] * residual[at];
      square += kernel_[static_cast<std::size_t>(k)] * kernel_[static_cast<std::size_t>(k)];
    }
    out[i] = square > 0.0 ? sum * std::sqrt(kernel_square_ / square) : 0.0;
  }
}

/// Whether an echo of this time and amplitude may be the ringing of a stronger one before it.
bool EchoSearch::isRinging(const EchoModel& model, double time, double amplitude) const {
  if (settings_.ringing <= 0.0) return false;
  for (int j = 0; j < model.count; ++j) {
    const EchoParameters& e = model.echo[static_cast<std::size_t>(j)];
    const double behind = time - e.time;
    if (behind > 0.0 && behind <= settings_.ringing_reach &&
        amplitude < settings_.ringing * e.amplitude)
      return true;
  }
  return false;
}

EchoSearch::Candidate EchoSearch::largestResidual(double variance) const {
  Candidate best;
  const double least = std::sqrt(kScreening * penalties_.echo * variance * kernel_square_);
  double largest = least;
  for (int i = 0; i < samples_; ++i) {
    const double value = filtered_[static_cast<std::size_t>(i)];
    if (value <= largest) continue;
    Candidate candidate{i, value / kernel_square_, value * value / (kernel_square_ * variance)};
    if (isRinging(model_, i, candidate.amplitude)) continue;
    largest = value;
    best = candidate;
  }
  return best;
}

FitResult EchoSearch::adjust(EchoModel& model, double noise) {
  const FitResult result = fit_.fit(model, noise);
  iterations_ += result.iterations;
  return result;
}

double EchoSearch::criterion(const EchoModel& model, const FitResult& result) const {
  // Twice the negative logarithm of the likelihood, but for a constant, with the variance that is
  // most likely among those that are not below the least one.
  const double mean = std::max(result.sum, 1e-300) / result.used;
  const double misfit = mean < least_variance_
                            ? std::log(least_variance_) + mean / least_variance_ - 1.0
                            : std::log(mean);
  return result.used * misfit + penalties_.echo * model.count +
         penalties_.width * model.freeWidths();
}

double EchoSearch::variance() const {
  return std::max(least_variance_, result_.sum / std::max(1, result_.used - fit_.size()));
}

/// Takes a model that is better than the present one.
bool EchoSearch::accept(const EchoModel& model, const FitResult& result) {
  const double value = criterion(model, result);
  if (!(value < criterion_)) return false;
  model_ = model;
  result_ = result;
  criterion_ = value;
  return true;
}

/// Brings the adjustment back to the chosen model.
void EchoSearch::restore() {
  result_.sum = fit_.evaluate(model_);
}

/// Width to start from: that of the response, or wider if the waveform is so around its maximum.
double EchoSearch::startWidth(const Candidate& candidate, const double* counts, int samples) const {
  const double half = model_.baseline + 0.5 * (counts[candidate.sample] - model_.baseline);
  int low = candidate.sample, high = candidate.sample;
  while (low > 0 && counts[low] > half) --low;
  while (high < samples - 1 && counts[high] > half) ++high;
  const double width = (high - low - 1) / kFwhmOfGaussian;
  return std::clamp(width, response_.width(), 0.5 * response_.largestWidth());
}

/// Finds whether there is any echo. The first model is the baseline alone.
bool EchoSearch::firstEcho(const double* counts, int samples) {
  double mean = 0.0;
  for (int i = 0; i < samples; ++i) mean += counts[i];
  mean /= samples;
  double low = 0.0;
  int below = 0;
  for (int i = 0; i < samples; ++i)
    if (counts[i] <= mean) {
      low += counts[i];
      ++below;
    }
  model_.count = 0;
  model_.baseline = mean;
  result_ = adjust(model_);
  if (result_.sum <= 0.0) return false;
  criterion_ = criterion(model_, result_);
  matchedFilter(fit_.residuals(), samples);
  const Candidate candidate = largestResidual(0.25 * variance());
  if (candidate.sample < 0) return false;
  EchoModel one;
  one.count = 1;
  one.baseline = model_.baseline = low / std::max(1, below);
  EchoParameters& e = one.echo[0];
  e.time = candidate.sample;
  e.width = startWidth(candidate, counts, samples);
  e.amplitude = std::max(counts[candidate.sample] - one.baseline, candidate.amplitude);
  const EchoModel start = one;
  const FitResult wide = adjust(one);
  if (one.echo[0].amplitude > 0.0 && accept(one, wide)) return true;
  // Perhaps with the width of the response.
  one = start;
  one.echo[0].width = response_.width();
  one.echo[0].free_width = false;
  const FitResult narrow = adjust(one);
  if (one.echo[0].amplitude > 0.0 && accept(one, narrow)) return true;
  model_.baseline = mean;
  restore();
  return false;
}

/// Adds an echo of the width of the response where the residuals are largest.
bool EchoSearch::addEcho() {
  if (model_.count >= settings_.most_echoes) return false;
  matchedFilter(fit_.residuals(), samples_);
  const Candidate candidate = largestResidual(variance());
  if (candidate.sample < 0) return false;
  EchoModel more = model_;
  EchoParameters& e = more.echo[static_cast<std::size_t>(more.count++)];
  e = EchoParameters();
  e.amplitude = candidate.amplitude;
  e.time = candidate.sample;
  e.width = response_.width();
  e.free_width = false;
  const FitResult result = adjust(more);
  if (accept(more, result)) return true;
  restore();
  return false;
}

/// Score test of third and fourth derivative of an echo: two echoes instead of a wide one leave
/// such residuals.
bool EchoSearch::splitIsIndicated(int echo, double variance) {
  const int count = fit_.rangeLast(echo) - fit_.rangeFirst(echo);
  if (count < 5) return false;
  direction_.resize(static_cast<std::size_t>(samples_));
  double score = 0.0;
  for (int part = 1; part <= 2; ++part) {
    const double* column = fit_.column(echo, part);
    direction_[0] = direction_[static_cast<std::size_t>(count - 1)] = 0.0;
    for (int i = 1; i + 1 < count; ++i)
      direction_[static_cast<std::size_t>(i)] = column[i + 1] - 2.0 * column[i] + column[i - 1];
    const double square = fit_.projectedSquare(echo, direction_.data());
    if (!(square > 0.0)) continue;
    const double* residual = fit_.residuals() + fit_.rangeFirst(echo);
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += direction_[static_cast<std::size_t>(i)] * residual[i];
    if (part == 1) skewness_ = sum / square;
    if (part == 1 || sum < 0.0) score += sum * sum / (square * variance);
  }
  return score > kSplitScore;
}

/// Two echoes of the width of the response with the moments of a wide one.
bool EchoSearch::splitModel(int echo, EchoModel& split) {
  const EchoParameters wide = model_.echo[static_cast<std::size_t>(echo)];
  const double w = response_.width();
  const double excess = wide.width * wide.width - w * w;
  if (excess <= 0.0) return false;
  // The residuals are skewness_ times the change of the slope over one sample, twice: the third
  // derivative by time, whose factor is a sixth of the third moment.
  const double third = 6.0 * skewness_;
  const double s = std::clamp(-third / excess, -3.0 * w, 3.0 * w);
  const double distance = std::sqrt(s * s + 4.0 * excess);
  const double second = 0.5 * (1.0 - s / distance);  // share of the later echo
  split = model_;
  EchoParameters& a = split.echo[static_cast<std::size_t>(echo)];
  EchoParameters& b = split.echo[static_cast<std::size_t>(split.count++)];
  const double energy = wide.amplitude * wide.width / w;
  a.free_width = false;
  a.width_prior = 0.0;
  a.width = w;
  b = a;
  a.amplitude = energy * (1.0 - second);
  a.time = wide.time - distance * second;
  b.amplitude = energy * second;
  b.time = wide.time + distance * (1.0 - second);
  return true;
}

bool EchoSearch::splitEcho() {
  if (model_.count >= settings_.most_echoes || !fit_.invert()) return false;
  const double noise_square = variance();
  for (int j = 0; j < model_.count; ++j) {
    const EchoParameters& e = model_.echo[static_cast<std::size_t>(j)];
    if (!e.free_width) continue;
    const int at = fit_.index(j, 2);
    const double std = std::sqrt(noise_square * fit_.cofactor(at, at));
    if (e.width - response_.width() < kWiderBy * std || !splitIsIndicated(j, noise_square))
      continue;
    EchoModel split;
    if (!splitModel(j, split)) continue;
    const FitResult result = adjust(split);
    const EchoParameters& one = split.echo[static_cast<std::size_t>(j)];
    const EchoParameters& other = split.echo[static_cast<std::size_t>(split.count - 1)];
    const bool ringing =
        isRinging(split, one.time, one.amplitude) || isRinging(split, other.time, other.amplitude);
    if (!ringing && accept(split, result)) return true;
    restore();
    if (!fit_.invert()) return false;
  }
  return false;
}

/// Frees the widths of echoes for which that improves the criterion, and fixes those whose width
/// does not differ from that of the response enough.
void EchoSearch::freeWidths() {
  const double noise_square = variance();
  if (!fit_.invert()) return;
  EchoModel changed = model_;
  bool any = false;
  for (int j = 0; j < model_.count; ++j) {
    EchoParameters& e = changed.echo[static_cast<std::size_t>(j)];
    if (e.free_width) continue;
    const int count = fit_.rangeLast(j) - fit_.rangeFirst(j);
    const double* column = fit_.column(j, 2);
    const double square = fit_.projectedSquare(j, column);
    double sum = 0.0;
    for (int i = 0; i < count; ++i) sum += column[i] * fit_.residuals()[fit_.rangeFirst(j) + i];
    if (!(square > 0.0) || sum * sum < kScreening * penalties_.width * square * noise_square)
      continue;
    e.free_width = any = true;
  }
  if (!any) return;
  const FitResult result = adjust(changed);
  if (!accept(changed, result)) restore();
}

/// Replaces two neighbouring echoes by a wide one with their moments, if that improves the
/// criterion.
bool EchoSearch::mergeEchoes() {
  for (int j = 0; j < model_.count; ++j)
    for (int k = j + 1; k < model_.count; ++k) {
      const EchoParameters& a = model_.echo[static_cast<std::size_t>(j)];
      const EchoParameters& b = model_.echo[static_cast<std::size_t>(k)];
      if (std::abs(a.time - b.time) > kMergeReach * response_.width()) continue;
      const double p = a.amplitude * a.width, q = b.amplitude * b.width, energy = p + q;
      if (!(energy > 0.0)) continue;
      const double distance = b.time - a.time;
      EchoModel merged = model_;
      EchoParameters& e = merged.echo[static_cast<std::size_t>(j)];
      e.time = (p * a.time + q * b.time) / energy;
      e.width = std::sqrt((p * a.width * a.width + q * b.width * b.width) / energy +
                          p * q * distance * distance / (energy * energy));
      e.width = std::min(e.width, response_.largestWidth());
      e.amplitude = energy / e.width;
      e.free_width = true;
      merged.echo[static_cast<std::size_t>(k)] =
          model_.echo[static_cast<std::size_t>(--merged.count)];
      const FitResult result = adjust(merged);
      if (accept(merged, result)) return true;
      restore();
    }
  return false;
}

/// Whether another echo is so close that both widths and distances depend on each other.
bool EchoSearch::overlaps(int echo) const {
  const EchoParameters& e = model_.echo[static_cast<std::size_t>(echo)];
  for (int k = 0; k < model_.count; ++k) {
    const EchoParameters& other = model_.echo[static_cast<std::size_t>(k)];
    const double reach = kOverlap * std::max(e.width, other.width);
    if (k != echo && std::abs(other.time - e.time) < reach) return true;
  }
  return false;
}

/// The widths of all echoes are adjusted, with a prior for those that overlap others.
void EchoSearch::adjustFinally() {
  if (model_.count == 0 || (model_.count == 1 && model_.echo[0].free_width)) return;
  const double noise = std::sqrt(variance());
  EchoModel last = model_;
  for (int j = 0; j < last.count; ++j) {
    EchoParameters& e = last.echo[static_cast<std::size_t>(j)];
    e.free_width = true;
    e.width_prior = overlaps(j) ? settings_.width_spread * response_.width() : 0.0;
  }
  adjust(last, noise);
  model_ = last;
  result_.sum = fit_.evaluate(model_, noise);
}

const EchoModel& EchoSearch::search(const double* counts, const signed char* bound, int samples) {
  samples_ = samples;
  iterations_ = 0;
  if (penalties_of_ != samples) penalties_ = penaltiesFor(settings_.false_echoes, samples);
  penalties_of_ = samples;
  least_variance_ = areWhole(counts, samples) ? kRoundedVariance : 0.0;
  fit_.setSamples(counts, bound, samples);
  if (!firstEcho(counts, samples)) {
    noise_ = std::sqrt(variance());
    return model_;
  }
  while (splitEcho() || addEcho()) freeWidths();
  while (model_.count > 2 && mergeEchoes()) {
  }
  adjustFinally();
  noise_ = std::sqrt(variance());
  return model_;
}

}  // namespace pcl_als::detail
