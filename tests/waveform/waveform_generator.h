// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Dense>

namespace pcl_als::test {

/// An echo as the generator makes it: the pulse, stretched by nothing, spread by a target.
struct TrueEcho {
  double amplitude = 0.0;  ///< of the pulse before the receiver integrates it
  double time = 0.0;       ///< samples
  double width = 0.0;      ///< of a Gaussian pulse, samples
};

/** \brief Waveforms that a digitizer would record.
 *
 * The received power is integrated numerically over each sample, noise is added, and the result is
 * rounded to steps. Nothing of the estimator is used.
 */
class WaveformGenerator {
 public:
  explicit WaveformGenerator(unsigned seed) : random_(seed) {}

  double baseline = 20.3, noise = 1.0, step = 0.2;
  int samples = 64;

  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random_);
  }
  /// Mean of a function over the sample around t.
  static double integrated(const std::function<double(double)>& power, double t) {
    constexpr int kSteps = 20;
    double sum = 0.0;
    for (int k = 0; k < kSteps; ++k) sum += power(t + (k + 0.5) / kSteps - 0.5);
    return sum / kSteps;
  }
  std::vector<double> expected(const std::function<double(double)>& power) const {
    std::vector<double> values;
    for (int i = 0; i < samples; ++i) values.push_back(baseline + integrated(power, i));
    return values;
  }
  std::vector<double> digitised(const std::function<double(double)>& power) {
    std::vector<double> values = expected(power);
    std::normal_distribution<double> normal;
    for (double& v : values) {
      v += noise * normal(random_);
      if (step > 0.0) v = step * std::round(v / step);
    }
    return values;
  }
  std::vector<double> gaussians(const std::vector<TrueEcho>& echoes) {
    return digitised([&](double t) { return powerOf(echoes, t); });
  }
  static double powerOf(const std::vector<TrueEcho>& echoes, double t) {
    double sum = 0.0;
    for (const TrueEcho& e : echoes)
      sum += e.amplitude * std::exp(-0.5 * std::pow((t - e.time) / e.width, 2));
    return sum;
  }
  /// Width of a Gaussian echo after integration over the sample, whose variance is 1/12.
  static double digitisedWidth(double width) { return std::sqrt(width * width + 1.0 / 12.0); }
  /// Amplitude after integration, which keeps the energy.
  static double digitisedAmplitude(const TrueEcho& e) {
    return e.amplitude * e.width / digitisedWidth(e.width);
  }

  /// Cramér-Rao bound of amplitude, time and width of a single echo on an unknown baseline, from
  /// numerical derivatives of the expected samples.
  Eigen::Vector3d bound(const TrueEcho& echo) const {
    const double noise_square = noise * noise + step * step / 12.0, h = 1e-4;
    Eigen::MatrixXd jacobian(samples, 4);
    jacobian.col(3).setOnes();
    for (int part = 0; part < 3; ++part) {
      TrueEcho more = echo, less = echo;
      double& up = part == 0 ? more.amplitude : part == 1 ? more.time : more.width;
      double& down = part == 0 ? less.amplitude : part == 1 ? less.time : less.width;
      up += h;
      down -= h;
      const auto a = expected([&](double t) { return powerOf({more}, t); });
      const auto b = expected([&](double t) { return powerOf({less}, t); });
      for (int i = 0; i < samples; ++i)
        jacobian(i, part) =
            (a[static_cast<std::size_t>(i)] - b[static_cast<std::size_t>(i)]) / (2.0 * h);
    }
    const Eigen::Matrix4d covariance = noise_square * (jacobian.transpose() * jacobian).inverse();
    return covariance.diagonal().head<3>().cwiseSqrt();
  }

 private:
  std::mt19937_64 random_;
};

/// Errors and errors over standard deviations of amplitude, time and width.
struct EchoErrors {
  Eigen::Vector3d square = Eigen::Vector3d::Zero(), relative_square = Eigen::Vector3d::Zero();
  int count = 0;

  void add(const Eigen::Vector3d& error, const Eigen::Vector3d& std) {
    square += error.cwiseAbs2();
    relative_square += error.cwiseQuotient(std).cwiseAbs2();
    ++count;
  }
  Eigen::Vector3d rms() const { return (square / count).cwiseSqrt(); }
  Eigen::Vector3d relativeRms() const { return (relative_square / count).cwiseSqrt(); }
};

}  // namespace pcl_als::test
