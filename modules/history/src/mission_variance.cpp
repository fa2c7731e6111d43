// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "mission_variance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>
#include <boost/math/tools/minima.hpp>

namespace pcl_als::detail {
namespace {

/// Root of the mean information of a mission on a parameter, inverse: a typical standard deviation.
double typicalStd(const std::vector<CalibrationMission>& missions, int parameter) {
  double sum = 0.0;
  std::size_t count = 0;
  for (const CalibrationMission& mission : missions) {
    if (!mission.determines(static_cast<SystemParameter>(parameter))) continue;
    sum += mission.information(parameter, parameter);
    ++count;
  }
  return count == 0 ? 0.0 : 1.0 / std::sqrt(sum / static_cast<double>(count));
}

std::size_t countOf(const std::vector<CalibrationMission>& missions, int parameter) {
  return static_cast<std::size_t>(
      std::count_if(missions.begin(), missions.end(), [&](const CalibrationMission& mission) {
        return mission.determines(static_cast<SystemParameter>(parameter));
      }));
}

}  // namespace

double logLikelihood(const std::vector<CalibrationMission>& missions,
                     const SystemVector& change_std, const std::vector<HistoryTerm>& terms,
                     bool restricted) {
  double sum = 0.0;
  const auto s = change_std.asDiagonal();
  for (const CalibrationMission& mission : missions) {
    const SystemMatrix inner = SystemMatrix::Identity() + SystemMatrix(s * mission.information * s);
    const Eigen::LLT<SystemMatrix> factor(inner);
    const SystemVector vector = s * mission.information_vector;
    sum += 2.0 * SystemMatrix(factor.matrixL()).diagonal().array().log().sum();
    sum -= vector.dot(factor.solve(vector));
  }
  const MissionInformation data = informationOf(missions, change_std);
  const HistoryModel model(data, terms);
  sum -= model.explained();
  if (restricted) sum += model.logDeterminant();
  return -0.5 * sum;
}

MostLikelyChange mostLikelyChange(const std::vector<CalibrationMission>& missions, int parameter,
                                  SystemVector change_std, const std::vector<HistoryTerm>& terms,
                                  bool restricted) {
  const auto likelihood = [&](double std) {
    change_std[parameter] = std;
    return logLikelihood(missions, change_std, terms, restricted);
  };
  MostLikelyChange best{0.0, likelihood(0.0)};
  const double typical = typicalStd(missions, parameter);
  if (!(typical > 0.0)) return best;
  // The likelihood may have a maximum at zero and another one: octaves first, then Brent's method.
  constexpr int kLowest = -4, kHighest = 10, kBits = 12;
  int octave = kLowest;
  for (int i = kLowest; i <= kHighest; ++i) {
    const double value = likelihood(std::exp2(i) * typical);
    if (!(value > best.log_likelihood)) continue;
    best = {std::exp2(i) * typical, value};
    octave = i;
  }
  if (best.std == 0.0) return best;
  std::uintmax_t steps = 30;
  const auto [exponent, negative] = boost::math::tools::brent_find_minima(
      [&](double x) { return -likelihood(std::exp2(x) * typical); }, octave - 1.0, octave + 1.0,
      kBits, steps);
  if (-negative > best.log_likelihood) best = {std::exp2(exponent) * typical, -negative};
  return best;
}

SystemVector changeStdByReml(const std::vector<CalibrationMission>& missions,
                             const std::vector<HistoryTerm>& terms, const SystemVector& known) {
  constexpr int kSweeps = 4;
  constexpr double kConverged = 0.01;  // relative change of a standard deviation
  SystemVector std = known.array().isNaN().select(SystemVector::Zero(), known);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double largest = 0.0;
    for (int p = 0; p < kSystemParameterCount; ++p) {
      if (!std::isnan(known[p]) || countOf(missions, p) < CalibrationHistory::kFewestForChange)
        continue;
      const double before = std[p];
      std[p] = mostLikelyChange(missions, p, std, terms, true).std;
      largest = std::max(largest, std::abs(std[p] - before) / std::max({std[p], before, 1e-300}));
    }
    if (largest < kConverged) break;
  }
  return std;
}

}  // namespace pcl_als::detail
