// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/waveform/pulse_response.h>

namespace pcl_als {
namespace {

using Function = std::function<double(double)>;

/// A pulse that rises faster than it falls, with its maximum of 1 at t = 0.
double skewedPulse(double t) {
  const double x = t / 6.0 + 1.0;
  return x <= 0.0 ? 0.0 : std::pow(x * std::exp(1.0 - x), 9.0);
}

std::vector<double> sampledPulse(const Function& pulse, double from, double to, double spacing) {
  std::vector<double> samples;
  for (double t = from; t <= to; t += spacing) samples.push_back(37.0 * pulse(t));
  return samples;
}

PulseResponse skewedResponse() {
  return PulseResponse::sampled(sampledPulse(skewedPulse, -6.0, 22.0, 0.5), 0.5);
}

struct Values {
  int first = 0;
  std::vector<double> value, by_time, by_width;
};

Values valuesOf(const PulseResponse& response, double time, double width, int first, int last) {
  const auto count = static_cast<std::size_t>(last - first);
  Values v{first, std::vector<double>(count), std::vector<double>(count),
           std::vector<double>(count)};
  response.evaluate(time, width, first, last, v.value.data(), v.by_time.data(), v.by_width.data());
  return v;
}

/// Samples at which the response is defined for both times and widths near these.
std::pair<int, int> rangeOf(const PulseResponse& response, double time, double width) {
  return {static_cast<int>(std::ceil(time - response.before(width))) + 2,
          static_cast<int>(std::floor(time + response.after(width))) - 2};
}

void expectDerivatives(const PulseResponse& response, double time, double width) {
  const auto [first, last] = rangeOf(response, time, width);
  const double h = 1e-5;
  const Values at = valuesOf(response, time, width, first, last);
  const Values later = valuesOf(response, time + h, width, first, last);
  const Values earlier = valuesOf(response, time - h, width, first, last);
  const Values wider = valuesOf(response, time, width + h, first, last);
  const Values narrower = valuesOf(response, time, width - h, first, last);
  for (std::size_t i = 0; i < at.value.size(); ++i) {
    EXPECT_NEAR(at.by_time[i], (later.value[i] - earlier.value[i]) / (2.0 * h), 1e-4)
        << time << ' ' << width << ' ' << i;
    EXPECT_NEAR(at.by_width[i], (wider.value[i] - narrower.value[i]) / (2.0 * h), 1e-6)
        << time << ' ' << width << ' ' << i;
  }
}

TEST(PulseResponse, HasTheDerivativesOfCentralDifferences) {
  const PulseResponse gaussian = PulseResponse::gaussian(2.0), skewed = skewedResponse();
  for (const double width : {1.95, 2.3, 3.7, 9.0})
    for (const double time : {30.02, 30.31, 30.77}) {
      expectDerivatives(gaussian, time, width);
      expectDerivatives(skewed, time, std::max(width, 0.95 * skewed.width()));
    }
}

TEST(PulseResponse, OfSamplesOfAGaussianIsThatGaussian) {
  const double w = 2.0;
  const Function pulse = [w](double t) { return std::exp(-0.5 * t * t / (w * w)); };
  const PulseResponse gaussian = PulseResponse::gaussian(w);
  const PulseResponse sampled = PulseResponse::sampled(sampledPulse(pulse, -20.1, 20.0, 0.5), 0.5);
  EXPECT_TRUE(gaussian.isGaussian());
  EXPECT_FALSE(sampled.isGaussian());
  EXPECT_NEAR(sampled.width(), w, 1e-6);
  for (const double width : {2.0, 2.4, 4.9, 9.0})
    for (const double time : {30.0, 30.4, 30.93}) {
      const auto [first, last] = rangeOf(gaussian, time, width);
      const Values a = valuesOf(sampled, time, width, first, last);
      const Values b = valuesOf(gaussian, time, width, first, last);
      for (std::size_t i = 0; i < a.value.size(); ++i) {
        ASSERT_NEAR(a.value[i], b.value[i], 2e-6) << width << ' ' << time;
        ASSERT_NEAR(a.by_time[i], b.by_time[i], 1e-4) << width << ' ' << time;
        ASSERT_NEAR(a.by_width[i], b.by_width[i], 1e-3) << width << ' ' << time;
      }
    }
}

// The convolution by sums over small steps, independent of the table.
TEST(PulseResponse, OfAnExtendedTargetIsTheConvolution) {
  const PulseResponse response = skewedResponse();
  for (const double spread : {0.7, 1.5, 4.0}) {
    const Function convolved = [spread](double t) {
      double sum = 0.0;
      for (double s = -6.0 * spread; s <= 6.0 * spread; s += spread / 50.0)
        sum += skewedPulse(t - s) * std::exp(-0.5 * s * s / (spread * spread));
      return sum;
    };
    double largest = 0.0;
    for (double t = -3.0; t < 3.0; t += 0.01) largest = std::max(largest, convolved(t));
    const double width = std::hypot(response.width(), spread), time = 40.37;
    const auto [first, last] = rangeOf(response, time, width);
    const Values v = valuesOf(response, time, width, first, last);
    for (int i = first; i < last; ++i)
      ASSERT_NEAR(v.value[static_cast<std::size_t>(i - first)], convolved(i - time) / largest, 3e-5)
          << spread << ' ' << i;
  }
}

TEST(PulseResponse, HasTheWidthOfItsHalfMaximum) {
  double low = -6.0, high = 20.0;
  while (skewedPulse(low) < 0.5) low += 1e-4;
  while (skewedPulse(high) < 0.5) high -= 1e-4;
  EXPECT_NEAR(skewedResponse().width(), (high - low) / kFwhmOfGaussian, 1e-3);
}

TEST(PulseResponse, RefusesPulsesThatAreNone) {
  EXPECT_THROW(PulseResponse::gaussian(0.0), UsageError);
  EXPECT_THROW(PulseResponse::gaussian(NAN), UsageError);
  EXPECT_THROW(PulseResponse::sampled({0, 1, 2, 1}, 1.0), UsageError);
  EXPECT_THROW(PulseResponse::sampled({0, 1, 2, 1, 0}, 0.0), UsageError);
  EXPECT_THROW(PulseResponse::sampled({0, 1, NAN, 1, 0}, 1.0), UsageError);
  EXPECT_THROW(PulseResponse::sampled({0, -1, -2, -1, 0}, 1.0), UsageError);
  EXPECT_THROW(PulseResponse::sampled({4, 3, 2, 1, 0}, 1.0), UsageError);
}

}  // namespace
}  // namespace pcl_als
