// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "angle_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>

#include <pcl_als/common/statistics.h>

#include "error_diagnosis.h"
#include "group_differences.h"

namespace pcl_als {
namespace {

constexpr int kClasses = 24;  // of the scan angle, over the swath
const int kRoll = indexOf(SystemParameter::boresight_roll);
const int kScale = indexOf(SystemParameter::scan_angle_scale);
// arcsec: standard deviations of the prior of a curve
constexpr std::array<double, 6> kSizes{3.0, 6.0, 12.0, 25.0, 50.0, 100.0};
constexpr double kExpected = 30.0;  // arcsec: that of a curve which is present

/// The strips' parts are those in classes of the scan angle.
FieldDivision classesOfAngle() {
  FieldDivision division;
  for (int k = 0; k < kClasses; ++k) division.values.push_back(k);
  return division;
}

/// The class of the scan angle of one side of a pair: the effect of the scale is the angle times
/// that of a roll.
std::size_t classOf(const PairRow& row, double largest_angle) {
  const double angle = row[kRoll] != 0.0 ? row[kScale] / row[kRoll] : 0.0;
  const double place = 0.5 * kClasses * (1.0 + angle / largest_angle);
  return static_cast<std::size_t>(std::clamp(place, 0.0, kClasses - 1.0));
}

/// At most so many pairs, with the parts of the strips.
WeightedObservations divided(const WeightedObservations& all, const FieldDivision& division,
                             double largest_angle) {
  constexpr std::size_t kSampledPairs = 200'000;
  std::size_t count = 0;
  for (const AreaObservations& area : all.observations) count += area.size();
  const std::size_t every = 1 + count / kSampledPairs;
  WeightedObservations parts;
  parts.observations.resize(all.observations.size());
  parts.weights.resize(all.observations.size());
  for (std::size_t area = 0; area < all.observations.size(); ++area) {
    for (std::size_t i = 0; i < all.observations[area].size(); i += every) {
      PairObservation o = all.observations[area][i];
      if (o.a != PairObservation::kControl)
        o.a = division.partOf(o.a, classOf(o.row_a, largest_angle));
      o.b = division.partOf(o.b, classOf(o.row_b, largest_angle));
      parts.observations[area].push_back(o);
      parts.weights[area].push_back(all.weights[area][i]);
    }
  }
  return parts;
}

/// The adjustment with a roll of each class, a random effect of a given size.
class CurveAdjustment {
 public:
  CurveAdjustment(const AdjustedBlock& block, const WeightedObservations& parts,
                  const FieldDivision& division, const std::vector<ErrorSource>& considered)
      : spans_(division.repeated(block.spans)),
        observed_(observedTimes(parts.observations, spans_.size())),
        errors_(spans_, withKnotsFor(block.model, observed_), observed_,
                division.systems(block.spans.size())),
        adjustment_(errors_, block.threads),
        estimate_(block.estimate) {
    errors_.considerSources(considered);
    adjustment_.setErrors(errors_);
    adjustment_.setVarianceFactors(block.levels);
    adjustment_.accumulate(parts.observations, parts.weights);
    // Its effect is a linear curve.
    if (std::find(estimate_.begin(), estimate_.end(), SystemParameter::scan_angle_scale) !=
        estimate_.end())
      return;
    estimate_.push_back(SystemParameter::scan_angle_scale);
    if (!std::isfinite(deviance(0.0))) estimate_.pop_back();
  }

  double deviance(double arcsec) {
    setSize(arcsec);
    return adjustment_
        .restrictedLikelihood(adjustment_.levels(), estimate_,
                              -std::numeric_limits<double>::infinity())
        .deviance;
  }

  void estimateComponents(double arcsec) {
    setSize(arcsec);
    estimateLevels(adjustment_, estimate_, adjustment_.levels());
  }

  /// Rolls of the classes after the first one relative to it, with their variances by the model and
  /// by the scatter of the areas; empty where they are not determined.
  struct Rolls {
    std::vector<double> values, variances, scatter;
  };
  Rolls rolls(double arcsec) {
    setSize(arcsec);
    adjustment_.setVarianceFactors(adjustment_.levels());
    Rolls rolls;
    const AdjustmentSolution solution = adjustment_.solve(estimate_, SystemVector::Zero());
    if (!solution.solved) return rolls;
    std::vector<int> classes(kClasses - 1);
    std::iota(classes.begin(), classes.end(), 1);
    for (const auto& posterior : adjustment_.systemPosteriors(classes, estimate_, solution)) {
      rolls.values.push_back(posterior.mean[kRoll]);
      rolls.variances.push_back(posterior.covariance(kRoll, kRoll));
      rolls.scatter.push_back(posterior.scatter[kRoll]);
    }
    return rolls;
  }

 private:
  void setSize(double arcsec) {
    for (int k = 1; k < kClasses; ++k) errors_.setOwn(k, kRoll, arcsec * kRadiansPerArcsec);
    adjustment_.setErrors(errors_);
  }

  std::vector<TimeSpan> spans_;
  std::vector<std::vector<TimeSpan>> observed_;
  SharedErrors errors_;
  Adjustment adjustment_;
  std::vector<SystemParameter> estimate_;
};

double overdispersionOf(const CurveAdjustment::Rolls& rolls) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < rolls.values.size(); ++i)
    if (rolls.variances[i] > 0.0) ratios.push_back(rolls.scatter[i] / rolls.variances[i]);
  return ratios.empty() ? 1.0 : std::max(1.0, medianInPlace(ratios));
}

/// The curve about its mean, which is a boresight roll.
std::vector<AngleError> curveOf(const CurveAdjustment::Rolls& rolls, double largest_angle) {
  std::vector<AngleError> errors{{0.0, 0.0, 0.0}};  // the reference
  double mean = 0.0;
  for (std::size_t i = 0; i < rolls.values.size(); ++i) {
    errors.push_back(
        {0.0, rolls.values[i], std::sqrt(std::max(rolls.variances[i], rolls.scatter[i]))});
    mean += rolls.values[i] / kClasses;
  }
  for (int k = 0; k < kClasses; ++k) {
    AngleError& error = errors[static_cast<std::size_t>(k)];
    error.angle = largest_angle * ((2 * k + 1.0) / kClasses - 1.0);
    error.error -= mean;
  }
  return errors;
}

}  // namespace

AngleCurve angleCurve(const AdjustedBlock& block, const WeightedObservations& observations,
                      const std::vector<ErrorSource>& considered, double largest_angle,
                      const ScanGeometry& edge) {
  AngleCurve curve;
  ErrorFinding& finding = curve.finding;
  finding.source = AngleCurve::kSource;
  finding.title = "error of the scan angle that is another function of it";
  finding.unit = "arcsec";
  finding.hint =
      "have the angle encoder calibrated by the manufacturer; scan_angle_curve of the result has "
      "the errors by scan angle";
  const FieldDivision division = classesOfAngle();
  std::vector<ErrorSource> sources = considered;
  for (const ErrorSource shape : {ErrorSource::encoder_quadratic, ErrorSource::encoder_cubic})
    if (std::find(sources.begin(), sources.end(), shape) == sources.end()) sources.push_back(shape);
  CurveAdjustment adjustment(block, divided(observations, division, largest_angle), division,
                             sources);
  double absent = adjustment.deviance(0.0);
  if (!std::isfinite(absent)) return curve;
  std::array<double, kSizes.size()> deviances{};
  const auto evaluate = [&] {
    std::transform(kSizes.begin(), kSizes.end(), deviances.begin(),
                   [&](double size) { return adjustment.deviance(size); });
  };
  evaluate();
  const auto least = std::min_element(deviances.begin(), deviances.end());
  const double best =
      *least < HUGE_VAL ? kSizes[static_cast<std::size_t>(least - deviances.begin())] : kExpected;
  constexpr double kWorthwhile = 10.0;  // of the deviance
  if (*least < absent - kWorthwhile) {
    adjustment.estimateComponents(best);
    evaluate();
  }
  const CurveAdjustment::Rolls rolls = adjustment.rolls(best);
  if (rolls.values.empty()) return curve;
  const double overdispersion = overdispersionOf(rolls);
  // Of the components of the alternative: those of the hypothesis of no curve fit it better.
  double factor = 0.0;
  for (const double deviance : deviances)
    factor += std::exp(std::min(500.0, 0.5 * (absent - deviance) / overdispersion)) /
              static_cast<double>(kSizes.size());
  finding.probability =
      (1.0 - kDifferenceAbsent) * factor / (kDifferenceAbsent + (1.0 - kDifferenceAbsent) * factor);
  curve.errors = curveOf(rolls, largest_angle);
  double squares = 0.0, variance = 0.0, largest = 0.0;
  for (const AngleError& error : curve.errors) {
    squares += error.error * error.error / kClasses;
    variance += error.std * error.std / (kClasses - 1.0);
    largest = std::max(largest, std::abs(error.error));
  }
  finding.value = std::sqrt(squares) / kRadiansPerArcsec;
  finding.std = std::sqrt(variance) / kRadiansPerArcsec;
  finding.effect = designBlock(edge).col(kRoll).norm() * largest;
  finding.determined = SharedErrorModel::isDetermined(finding.value, finding.std, kExpected);
  finding.evidence = evidenceOf(finding);
  return curve;
}

void judgeAngleCurve(AngleCurve curve, double relevant, CalibrationResult& result) {
  const ErrorFinding& f = curve.finding;
  if (f.determined && f.probability > kSupported) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "%s: the scan angle has an error of %.3g +- %.2g arcsec (RMS) that depends on the "
        "scan angle in another way than by its scale",
        f.source.c_str(), f.value, f.std);
    result.warnings.emplace_back(std::string(text) + "; " + f.hint);
    if (f.effect > relevant)
      result.verdict.downgrade(CalibrationStatus::parameters_affected,
                               std::string(text) +
                                   ", by which parameters and corrections of the "
                                   "trajectory are wrong");
    result.scan_angle_curve = std::move(curve.errors);
  }
  result.diagnosis.push_back(std::move(curve.finding));
}

}  // namespace pcl_als
