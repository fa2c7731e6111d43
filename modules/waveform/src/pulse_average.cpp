// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "pulse_average.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include <pcl_als/common/statistics.h>

namespace pcl_als::detail {
namespace {

constexpr int kDegree = 5;
constexpr int kSplines = kDegree + 1;  // that are not zero in an interval
/// Distance of the values of the result, widths of the response.
constexpr double kValueSpacing = 0.25;
/// The response is estimated from this long before its maximum to this long behind it, widths.
constexpr double kBefore = 6.0, kBehind = 30.0;
constexpr int kRounds = 4;          // of the weights
constexpr double kHuber = 2.0;      // standard deviations of a sample
constexpr double kSignificant = 4;  // standard deviations of a value of the response
/// Added to the diagonal, relative to its largest element: knots without samples become 0.
constexpr double kRidge = 1e-7;
constexpr int kMargin = 2;  // values

using SplineValues = Eigen::Matrix<double, kSplines, 1>;

/// Values of the B-splines that are not zero at the place f in [0, 1) of an interval between knots,
/// by the recurrence of Cox and de Boor.
SplineValues splines(double f) {
  SplineValues value = SplineValues::Zero();
  value[kDegree] = 1.0;
  for (int degree = 1; degree <= kDegree; ++degree)
    for (int j = kDegree - degree; j <= kDegree; ++j) {
      const double from = f + kDegree - j;  // distance from the first knot of the spline
      const double next = j < kDegree ? value[j + 1] : 0.0;
      value[j] = (from * value[j] + (degree + 1.0 - from) * next) / degree;
    }
  return value;
}

class SplineFit {
 public:
  SplineFit(const std::vector<AlignedEcho>& echoes, double width, double knot_spacing)
      : echoes_(echoes),
        step_(kValueSpacing / knot_spacing),
        spacing_(knot_spacing * width),
        first_(-static_cast<int>(kBefore / knot_spacing)),
        count_(static_cast<int>((kBefore + kBehind) / knot_spacing) + 1),
        coefficient_(Eigen::VectorXd::Zero(count_)) {}

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count_, count_);
      Eigen::VectorXd right = Eigen::VectorXd::Zero(count_);
      if (round > 0) findResiduals();
      for (std::size_t k = 0; k < echoes_.size(); ++k) add(k, normal, right);
      normal.diagonal().array() += kRidge * normal.diagonal().maxCoeff();
      solver_.compute(normal);
      coefficient_ = solver_.solve(right);
    }
    findResiduals();
  }

  AveragedPulse pulse() const {
    const Eigen::MatrixXd cofactor = solver_.solve(Eigen::MatrixXd::Identity(count_, count_));
    AveragedPulse pulse;
    pulse.spacing = spacing_ * step_;
    std::ptrdiff_t from = -1, to = -1;  // significant values
    for (int k = 0; k * step_ < count_; ++k) {
      int at = 0;
      SplineValues spline;
      pulse.values.push_back(0.0);
      if (!splinesAt(k * step_, at, spline)) continue;
      pulse.values.back() = spline.dot(coefficient_.segment<kSplines>(at));
      const double variance = spline.dot(cofactor.block<kSplines, kSplines>(at, at) * spline);
      if (std::abs(pulse.values.back()) < kSignificant * noise_ * std::sqrt(variance)) continue;
      if (from < 0) from = k;
      to = k;
    }
    if (from < 0) return {};
    pulse.values.erase(pulse.values.begin() + to + 1, pulse.values.end());
    pulse.values.erase(pulse.values.begin(), pulse.values.begin() + from);
    pulse.values.insert(pulse.values.begin(), kMargin, 0.0);
    pulse.values.insert(pulse.values.end(), kMargin, 0.0);
    return pulse;
  }

 private:
  /// Place of a sample among the knots.
  double placeOf(const AlignedEcho& echo, std::size_t sample) const {
    return (static_cast<double>(sample) - echo.time) / spacing_ - first_;
  }
  /// First of the splines that are not zero at a place, and their values; false: all are zero.
  bool splinesAt(double place, int& at, SplineValues& value) const {
    const double interval = std::floor(place);
    at = static_cast<int>(interval) - kDegree / 2;
    if (at < 0 || at + kSplines > count_) return false;
    value = splines(place - interval);
    return true;
  }

  double responseAt(const AlignedEcho& echo, std::size_t sample) const {
    int at = 0;
    SplineValues value;
    if (!splinesAt(placeOf(echo, sample), at, value)) return 0.0;
    return echo.amplitude * value.dot(coefficient_.segment<kSplines>(at));
  }

  /// Residuals of a waveform, with the median as its baseline.
  std::vector<double> residualsOf(const AlignedEcho& echo) const {
    std::vector<double> result;
    for (std::size_t i = 0; i < echo.counts->size(); ++i)
      result.push_back((*echo.counts)[i] - responseAt(echo, i));
    std::vector<double> sorted = result;
    const double baseline = medianInPlace(sorted);
    for (double& value : result) value -= baseline;
    return result;
  }

  /// Residuals of all waveforms, and their standard deviation.
  void findResiduals() {
    residuals_.clear();
    std::vector<double> all;
    for (const AlignedEcho& echo : echoes_) {
      residuals_.push_back(residualsOf(echo));
      all.insert(all.end(), residuals_.back().begin(), residuals_.back().end());
    }
    noise_ = robustSigmaAboutZero(std::move(all));
  }

  /// Adds a waveform to the lower triangle of the normal equations, without its baseline.
  void add(std::size_t waveform, Eigen::MatrixXd& normal, Eigen::VectorXd& right) const {
    const AlignedEcho& echo = echoes_[waveform];
    const double limit = kHuber * noise_;
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(count_);
    double weights = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < echo.counts->size(); ++i) {
      const double y = (*echo.counts)[i];
      const double size = residuals_.empty() ? 0.0 : std::abs(residuals_[waveform][i]);
      const double weight = limit > 0.0 && size > limit ? limit / size : 1.0;
      weights += weight;
      sum += weight * y;
      int at = 0;
      SplineValues value;
      if (!splinesAt(placeOf(echo, i), at, value)) continue;
      const SplineValues row = echo.amplitude * value;
      normal.block<kSplines, kSplines>(at, at) += weight * row * row.transpose();
      right.segment<kSplines>(at) += weight * y * row;
      mean.segment<kSplines>(at) += weight * row;
    }
    normal.selfadjointView<Eigen::Lower>().rankUpdate(mean, -1.0 / weights);
    right -= sum / weights * mean;
  }

  const std::vector<AlignedEcho>& echoes_;
  double step_;                                 ///< of the values of the result, knots
  double spacing_;                              ///< of the knots, samples
  int first_, count_;                           ///< knots, from the time 0
  std::vector<std::vector<double>> residuals_;  ///< by waveform; none before the first solution
  double noise_ = 0.0;                          ///< their robust standard deviation
  Eigen::VectorXd coefficient_;
  Eigen::LLT<Eigen::MatrixXd> solver_;
};

}  // namespace

AveragedPulse averagePulse(const std::vector<AlignedEcho>& echoes, double width,
                           double knot_spacing) {
  SplineFit fit(echoes, width, knot_spacing);
  fit.run();
  return fit.pulse();
}

}  // namespace pcl_als::detail
