// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors

// The errors of a strip between its knots (SharedErrors).
#include <algorithm>
#include <cmath>
#include <map>

#include "shared_errors.h"
#include "smooth_basis.h"

namespace pcl_als {

std::vector<int> SharedErrors::StripKnots::stepsWithin(double reach) const {
  std::vector<int> chosen{0};
  for (const int knot : at) {
    const int from = std::max(chosen.back() + 1, static_cast<int>(std::max(0.0, knot - reach)));
    const int to = static_cast<int>(std::min<double>(steps, knot + reach));
    for (int step = from; step <= to; ++step) chosen.push_back(step);
  }
  if (chosen.back() < steps) chosen.push_back(steps);
  return chosen;
}

std::vector<SharedErrors::Expectation> SharedErrors::expectationsOf(int index) const {
  // Correlation times from the next knot: the expectation is that of the constant component there,
  // to 3e-4 of the error at the knot.
  constexpr double kMemory = 8.0;
  const StripKnots& strip = passOf(index);
  const double unit = strip.spacing / model_.correlation_time;
  const int last = static_cast<int>(strip.at.size()) - 1;
  std::vector<Expectation> expectations;
  for (const int step : strip.stepsWithin(std::ceil(kMemory / unit))) {
    Expectation at;
    at.time = strip.start + step * strip.spacing;
    std::map<int, double> blocks;
    double smooth = 0.0;
    for (const auto& [block, weight] : coefficientsAt(strip, step)) {
      blocks[block] += weight;
      if (block != strip.constant) smooth += weight * weight;
    }
    // The Gauss-Markov component at a knot is the error there less the other components.
    const auto addKnot = [&](int knot, double weight) {
      blocks[strip.first + knot] += weight;
      for (const auto& [block, share] : coefficientsAt(strip, strip.at[knot]))
        blocks[block] -= weight * share;
    };
    // Expectation of a Gauss-Markov process between two known values, or beyond the last one.
    const int knot = strip.before(step);
    const double since = unit * (step - strip.at[knot]);
    if (since > 0.0 && knot < last) {
      // sinh(until) / sinh(since + until) and the reverse, without overflow in long gaps.
      const double until = unit * (strip.at[knot + 1] - step);
      const double all = std::expm1(-2.0 * (since + until));
      const double a = std::exp(-since) * std::expm1(-2.0 * until) / all;
      const double b = std::exp(-until) * std::expm1(-2.0 * since) / all;
      addKnot(knot, a);
      addKnot(knot + 1, b);
      at.gauss_markov_left = 1.0 - a * std::exp(-since) - b * std::exp(-until);
    } else {
      addKnot(knot, std::exp(-std::abs(since)));
      at.gauss_markov_left = -std::expm1(-2.0 * std::abs(since));
    }
    at.smooth_left = std::max(0.0, smoothVariance(step / strip.per_node) - smooth);
    for (const auto& [block, weight] : blocks) {
      if (weight != 0.0) at.blocks.emplace_back(block, weight);
    }
    expectations.push_back(std::move(at));
  }
  return expectations;
}

SharedErrors::Variances SharedErrors::variancesLeft(int index, const Expectation& at,
                                                    const VarianceFactors& levels) const {
  const PriorVariances prior = priorVariances(levels);
  const Variances& factors = passOf(index).variance_factors;
  Variances left{};
  for (std::size_t i = 0; i < left.size(); ++i)
    left[i] = factors[i] *
              (at.gauss_markov_left * prior.gauss_markov[i] + at.smooth_left * prior.smooth[i]);
  return left;
}

std::vector<TrajectoryErrorKnot> SharedErrors::errorsOf(int strip,
                                                        const Eigen::VectorXd& solution) const {
  std::vector<TrajectoryErrorKnot> errors;
  for (const Expectation& at : expectationsOf(strip)) {
    Eigen::Matrix<double, kPerKnot, 1> value = Eigen::Matrix<double, kPerKnot, 1>::Zero();
    for (const auto& [block, weight] : at.blocks)
      value += weight * solution.segment<kPerKnot>(static_cast<Eigen::Index>(block) * kPerKnot);
    TrajectoryErrorKnot& knot = errors.emplace_back();
    knot.time = at.time;
    knot.position = value.head<3>();
    knot.angles = value.tail<3>();
  }
  return errors;
}

}  // namespace pcl_als
