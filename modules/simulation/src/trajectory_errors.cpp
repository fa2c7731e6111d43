// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "trajectory_errors.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <pcl_als/common/errors.h>

namespace pcl_als::simulation {
namespace {

constexpr std::array<std::pair<ErrorProcess, std::string_view>, 6> kNames = {
    {{ErrorProcess::gauss_markov, "gauss_markov"},
     {ErrorProcess::band_limited, "band_limited"},
     {ErrorProcess::random_walk, "random_walk"},
     {ErrorProcess::drift, "drift"},
     {ErrorProcess::white, "white"},
     {ErrorProcess::jumps, "jumps"}}};

/// Exponentially correlated, stationary from the first value.
class GaussMarkov : public TrajectoryError {
 public:
  GaussMarkov(double sigma, const ErrorTiming& timing, Random& random)
      : keep_(std::exp(-timing.step / timing.correlation_time)),
        drive_(sigma * std::sqrt(1.0 - keep_ * keep_)),
        value_(sigma * random.normal()) {}
  double next(Random& random) override {
    const double value = value_;
    value_ = keep_ * value_ + drive_ * random.normal();
    return value;
  }

 private:
  double keep_, drive_, value_;
};

class BandLimited : public TrajectoryError {
 public:
  BandLimited(double sigma, const ErrorTiming& timing, Random& random) : step_(timing.step) {
    constexpr double kShortest = 0.6, kLongest = 5.0;  // correlation times
    const double size = sigma / std::sqrt(static_cast<double>(waves_.size()));
    for (Wave& wave : waves_) {
      const double period =
          timing.correlation_time * kShortest * std::pow(kLongest / kShortest, random.uniform());
      wave = {2.0 * kPi / period, size * random.normal(), size * random.normal()};
    }
  }
  double next(Random&) override {
    const double t = step_ * static_cast<double>(samples_++);
    double sum = 0.0;
    for (const Wave& wave : waves_)
      sum += wave.cosine * std::cos(wave.rate * t) + wave.sine * std::sin(wave.rate * t);
    return sum;
  }

 private:
  struct Wave {
    double rate, cosine, sine;
  };
  std::array<Wave, 8> waves_{};
  double step_;
  long samples_ = 0;
};

class RandomWalk : public TrajectoryError {
 public:
  RandomWalk(double sigma, const ErrorTiming& timing, Random& random)
      : drive_(sigma * std::sqrt(timing.step / timing.duration)),
        value_(std::sqrt(0.5) * sigma * random.normal()) {}
  double next(Random& random) override {
    const double value = value_;
    value_ += drive_ * random.normal();
    return value;
  }

 private:
  double drive_, value_;
};

class Drift : public TrajectoryError {
 public:
  Drift(double sigma, const ErrorTiming& timing, Random& random) {
    // The mean square of a line from -1 to 1 is a third.
    const double constant = std::sqrt(0.5) * sigma * random.normal();
    const double end = std::sqrt(1.5) * sigma * random.normal();
    value_ = constant - end;
    change_ = 2.0 * end * timing.step / timing.duration;
  }
  double next(Random&) override {
    const double value = value_;
    value_ += change_;
    return value;
  }

 private:
  double value_, change_;
};

class White : public TrajectoryError {
 public:
  explicit White(double sigma) : sigma_(sigma) {}
  double next(Random& random) override { return sigma_ * random.normal(); }

 private:
  double sigma_;
};

class Jumps : public TrajectoryError {
 public:
  Jumps(double sigma, const ErrorTiming& timing, Random& random)
      : sigma_(sigma),
        change_(1.0 - std::exp(-timing.step / timing.correlation_time)),
        value_(sigma * random.normal()) {}
  double next(Random& random) override {
    const double value = value_;
    if (random.chance(change_)) value_ = sigma_ * random.normal();
    return value;
  }

 private:
  double sigma_, change_, value_;
};

}  // namespace

std::string_view nameOf(ErrorProcess process) {
  for (const auto& [known, name] : kNames) {
    if (known == process) return name;
  }
  return {};
}

ErrorProcess errorProcessNamed(std::string_view name) {
  std::string names;
  for (const auto& [process, known] : kNames) {
    if (known == name) return process;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw UsageError("error process '" + std::string(name) + "': there are " + names);
}

std::unique_ptr<TrajectoryError> makeTrajectoryError(ErrorProcess process, double sigma,
                                                     const ErrorTiming& timing, Random& random) {
  switch (process) {
    case ErrorProcess::band_limited:
      return std::make_unique<BandLimited>(sigma, timing, random);
    case ErrorProcess::random_walk:
      return std::make_unique<RandomWalk>(sigma, timing, random);
    case ErrorProcess::drift:
      return std::make_unique<Drift>(sigma, timing, random);
    case ErrorProcess::white:
      return std::make_unique<White>(sigma);
    case ErrorProcess::jumps:
      return std::make_unique<Jumps>(sigma, timing, random);
    case ErrorProcess::gauss_markov:
      break;
  }
  return std::make_unique<GaussMarkov>(sigma, timing, random);
}

}  // namespace pcl_als::simulation
