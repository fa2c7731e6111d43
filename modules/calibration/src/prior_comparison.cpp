// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "prior_comparison.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/distributions.h>
#include <pcl_als/common/parameter_text.h>

namespace pcl_als {
namespace {

// A false alarm costs a flight that determines little what is known of a parameter.
constexpr double kSignificance = 0.01;  // of all parameters together, two-sided
// Of the information of the prior: where the observations add less than this share, their standard
// deviation is ten times that of the prior, and they say nothing of a change.
constexpr double kLeastInformation = 0.01;

/// The matrices of priorDifferences().
struct Comparison {
  BiasPrior prior;       // of the estimated parameters
  SystemMatrix weights;  // C L: of the prior in the estimates
  SystemMatrix open;     // R
  SystemVector score, score_variance;

  Comparison(const BiasPrior& all, const ParameterChoice& choice)
      : prior(all.marginal(choice.estimate)) {
    const AdjustmentSolution& solution = choice.solution;
    const SystemMatrix& information = prior.information;
    weights = solution.model * information;
    open = information - information * weights;
    const SystemMatrix change = weights - SystemMatrix::Identity();
    const SystemMatrix scatter =
        change * prior.covariance() * change.transpose() + solution.of_flight;
    score = information * (solution.biases - prior.mean);
    score_variance = (information * scatter * information).diagonal();
  }

  PriorDifference of(SystemParameter p, const AdjustmentSolution& solution) const {
    const int i = indexOf(p);
    PriorDifference found;
    found.parameter = p;
    found.prior = prior.mean[i];
    found.prior_std = std::sqrt(prior.covariance()(i, i));
    found.change = score[i] / open(i, i);
    found.change_std = std::sqrt(score_variance[i]) / open(i, i);
    // Without the prior of this parameter; enlarged as the covariance by the observations is.
    found.flight = solution.biases[i] + weights(i, i) * found.change;
    const double by_model = solution.model(i, i) - (weights * solution.model)(i, i);
    const double enlarged =
        by_model > 0.0 ? std::max(1.0, solution.of_flight(i, i) / by_model) : 1.0;
    found.flight_std =
        std::sqrt(enlarged * (solution.model(i, i) + weights(i, i) * weights(i, i) / open(i, i)));
    return found;
  }
};

/// What may have changed a parameter between two missions.
const char* causeOf(SystemParameter parameter) {
  switch (parameter) {
    case SystemParameter::lever_arm_x:
    case SystemParameter::lever_arm_y:
    case SystemParameter::lever_arm_z:
      return "the antenna or the sensor was mounted anew";
    case SystemParameter::boresight_pitch:
    case SystemParameter::boresight_roll:
    case SystemParameter::boresight_heading:
      return "the sensor or its IMU was mounted anew";
    case SystemParameter::range_bias:
      return "the ranging was calibrated anew, or heights belong to another datum";
    case SystemParameter::scan_angle_scale:
      return "the scanner was calibrated anew";
  }
  return "";
}

std::string warningOf(const PriorDifference& c, const BiasPrior& prior) {
  const SystemParameterInfo& info = infoOf(c.parameter);
  const auto pair = [&](double value, double std) {
    return inUnit(c.parameter, value) + " +- " + inUnit(c.parameter, std);
  };
  std::string text = std::string(info.name) + ": the prior" +
                     (prior.source.empty() ? "" : " of " + prior.source) + " says " +
                     pair(c.prior, c.prior_std) + ", this flight " + pair(c.flight, c.flight_std) +
                     ", a change of " + pair(c.change, c.change_std) + ": " + causeOf(c.parameter) +
                     ", the mounting values that the points were computed with were updated in "
                     "between, or the prior is that of another system; ";
  return text + (c.released ? "the prior of it is not used"
                            : "the estimate is between the two: leave the prior of it out, or "
                              "state a larger standard deviation");
}

bool isOfSensor(AttitudeSource attitude) {
  return attitude == AttitudeSource::trajectory || attitude == AttitudeSource::points;
}

/// The biases are the same in all models, which differ in what they know of the attitude.
std::string otherModel(const BiasPrior& prior, AttitudeSource attitude) {
  if (!prior.any() || !prior.attitude || isOfSensor(*prior.attitude) == isOfSensor(attitude))
    return {};
  const std::string without = isOfSensor(attitude) ? "the prior" : "this flight";
  return "the prior" + (prior.source.empty() ? "" : " of " + prior.source) +
         " was estimated with the attitude '" + std::string(toString(*prior.attitude)) +
         "', this flight has '" + std::string(toString(attitude)) + "': " + without +
         " takes the sensor as level and aligned with the course, so that crab exchanges a part of "
         "lever_arm_x and lever_arm_y, and of pitch and roll; give both the attitude";
}

}  // namespace

std::vector<PriorDifference> priorDifferences(const BiasPrior& prior,
                                              const ParameterChoice& choice) {
  std::vector<PriorDifference> found;
  if (!choice.solution.solved || !prior.any()) return found;
  const Comparison comparison(prior, choice);
  const std::vector<SystemParameter> known = comparison.prior.known();
  const double critical = normalCritical(0.5 * kSignificance /
                                         std::max<double>(1.0, static_cast<double>(known.size())));
  for (const SystemParameter p : known) {
    const int i = indexOf(p);
    if (!(comparison.open(i, i) > kLeastInformation * comparison.prior.information(i, i))) continue;
    found.push_back(comparison.of(p, choice.solution));
    found.back().significant = found.back().size() > critical;
  }
  std::sort(found.begin(), found.end(),
            [](const PriorDifference& a, const PriorDifference& b) { return a.size() > b.size(); });
  return found;
}

void reportPrior(const BiasPrior& prior, const ParameterChoice& choice,
                 const std::vector<PriorDifference>& released, CalibrationResult& result) {
  result.prior = prior.marginal(choice.estimate);
  result.prior_differences = released;
  for (const PriorDifference& difference : priorDifferences(prior, choice))
    result.prior_differences.push_back(difference);
  for (const PriorDifference& difference : result.prior_differences)
    if (difference.significant) result.warnings.push_back(warningOf(difference, prior));
  const std::string model_differs = otherModel(result.prior, result.attitude);
  if (!model_differs.empty()) result.warnings.emplace_back(model_differs);
  const SystemMatrix& model = choice.solution.model;
  const SystemMatrix of_prior = model * result.prior.information * model;
  for (const SystemParameter p : choice.estimate) {
    const int i = indexOf(p);
    if (model(i, i) > 0.0) result[p].prior_share = of_prior(i, i) / model(i, i);
  }
}

}  // namespace pcl_als
