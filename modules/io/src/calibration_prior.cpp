// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/errors.h>

#include "calibration_json.h"

namespace pcl_als::detail {
namespace {

using namespace field;
using Result = CalibrationResult;

double factorOf(SystemParameter parameter) {
  return infoOf(parameter).internal_per_unit;
}

Eigen::VectorXd factorsOf(const std::vector<SystemParameter>& parameters) {
  Eigen::VectorXd factors(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    factors[static_cast<Eigen::Index>(i)] = factorOf(parameters[i]);
  return factors;
}

/// A field with the names of parameters.
template <typename S>
Field<S> namesField(const char* name, std::vector<SystemParameter> S::*member, const char* what) {
  return Field<S>(name, member, parameterNames(), what,
                  reads([member](S& object, const FieldNode& node) {
                    object.*member = parametersNamed(node);
                  }));
}

/// A prior as it is in the file: the known parameters only, in the units of the file.
struct PriorInFile {
  std::string source;
  std::optional<AttitudeSource> attitude;
  bool of_other_missions = false;
  std::vector<SystemParameter> order;
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

PriorInFile priorOf(const Result& result) {
  const BiasPrior& prior = result.prior;
  PriorInFile stored{prior.source, prior.attitude, prior.of_other_missions, prior.known(), {}, {}};
  const auto size = static_cast<Eigen::Index>(stored.order.size());
  const SystemMatrix covariance = prior.covariance();
  stored.mean.resize(size);
  stored.covariance.resize(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    const SystemParameter row = stored.order[static_cast<std::size_t>(i)];
    stored.mean[i] = prior.mean[indexOf(row)] / factorOf(row);
    for (Eigen::Index k = 0; k < size; ++k) {
      const SystemParameter column = stored.order[static_cast<std::size_t>(k)];
      stored.covariance(i, k) =
          covariance(indexOf(row), indexOf(column)) / (factorOf(row) * factorOf(column));
    }
  }
  return stored;
}

BiasPrior priorFrom(const PriorInFile& stored, const FieldNode& node) {
  const Eigen::VectorXd factors = factorsOf(stored.order);
  if (stored.mean.size() != factors.size())
    node["mean"].refuse("must have one number for each parameter");
  if (stored.covariance.rows() != factors.size() || stored.covariance.cols() != factors.size())
    node["covariance"].refuse("must have one row for each parameter");
  SystemVector mean = SystemVector::Zero();
  for (Eigen::Index i = 0; i < factors.size(); ++i)
    mean[indexOf(stored.order[static_cast<std::size_t>(i)])] = stored.mean[i] * factors[i];
  BiasPrior prior;
  try {
    prior = biasPrior(stored.order, mean,
                      factors.asDiagonal() * stored.covariance * factors.asDiagonal());
  } catch (const InputError& error) {
    node["covariance"].refuse(error.what());
  }
  prior.source = stored.source;
  prior.attitude = stored.attitude;
  prior.of_other_missions = stored.of_other_missions;
  return prior;
}

const Fields<PriorInFile>& priorInFileFields() {
  using P = PriorInFile;
  using F = Field<P>;
  static const Fields<P> fields(
      "prior_values", "What was known before.",
      {F("source", &P::source, "File that it is from; stated by the user without it", unlessEmpty),
       F("attitude", &P::attitude, attitudeNames(), "Source of the attitude there", unlessEmpty),
       F("of_other_missions", &P::of_other_missions,
         "Whether it is from other missions, between which parameters may have changed"),
       namesField("order", &P::order, "The known parameters"),
       F("mean", &P::mean, "Their values, each in the unit of its parameter"),
       F("covariance", &P::covariance, "Their covariances, with changes between missions")});
  return fields;
}

Field<PriorDifference> differenceField(const char* name, double PriorDifference::*member,
                                       const char* what) {
  using D = PriorDifference;
  return Field<D>(
      name, [member](const D& found) { return found.*member / factorOf(found.parameter); }, what,
      reads([member](D& found, const FieldNode& node) {
        found.*member = node.numberOrNan() * factorOf(found.parameter);
      }));
}

const Fields<PriorDifference>& differenceFields() {
  using D = PriorDifference;
  static const Fields<D> fields(
      "prior_difference",
      "What the prior and this flight say of a parameter, in the unit of the parameter.",
      {Field<D>("parameter", &D::parameter, parameterNames(), "Name of the parameter"),
       differenceField("prior", &D::prior, "Value of the prior"),
       differenceField("prior_std", &D::prior_std, "Its standard deviation"),
       differenceField("flight", &D::flight, "Value by this flight alone"),
       differenceField("flight_std", &D::flight_std, "Its standard deviation"),
       differenceField("change", &D::change, "This flight minus prior, given the others"),
       differenceField("change_std", &D::change_std, "Its standard deviation"),
       Field<D>("significant", &D::significant, "Whether they contradict each other"),
       Field<D>("released", &D::released, "true: the prior of it was not used, therefore")});
  return fields;
}

/// Parameters that were neither estimated nor known, as in the file.
struct HeldInFile {
  std::vector<SystemParameter> parameters;
  Eigen::VectorXd std;
  Eigen::MatrixXd effect;
};

std::optional<HeldInFile> heldOf(const Result& result) {
  const HeldParameters& held = result.held_parameters;
  if (held.parameters.empty()) return std::nullopt;
  const Eigen::VectorXd units = factorsOf(held.parameters),
                        rows = factorsOf(result.correlation_order);
  HeldInFile stored{held.parameters, units, Eigen::MatrixXd(rows.size(), units.size())};
  for (Eigen::Index column = 0; column < units.size(); ++column) {
    stored.std[column] = held.std[static_cast<std::size_t>(column)] / units[column];
    for (Eigen::Index row = 0; row < rows.size(); ++row)
      stored.effect(row, column) = held.effect(row, column) * units[column] / rows[row];
  }
  return stored;
}

const Fields<HeldInFile>& heldFields() {
  using H = HeldInFile;
  static const Fields<H> fields(
      "held_parameters",
      "Parameters that were neither estimated nor known; the standard deviations of the others "
      "include their possible size.",
      {namesField("parameters", &H::parameters, "Their names"),
       Field<H>("std", &H::std, "Their standard deviations, each in the unit of its parameter"),
       Field<H>("effect", &H::effect,
                "Derivatives of the estimates (rows, in the order of `correlation`) with respect "
                "to their values (columns), in the units of the parameters")});
  return fields;
}

void readHeld(Result& result, const FieldNode& node) {
  // In files of version 1 the key has the surfaces that were held fixed.
  if (!node.has("parameters")) return;
  HeldInFile stored;
  heldFields().read(stored, node);
  const Eigen::VectorXd units = factorsOf(stored.parameters),
                        rows = factorsOf(result.correlation_order);
  if (stored.std.size() != units.size())
    node["std"].refuse("must have one number for each parameter");
  if (stored.effect.rows() != rows.size() ||
      (rows.size() > 0 && stored.effect.cols() != units.size()))
    node["effect"].refuse("must have one row for each name of 'correlation.order'");
  HeldParameters& held = result.held_parameters;
  held.parameters = stored.parameters;
  const Eigen::VectorXd std = stored.std.cwiseProduct(units);
  held.std.assign(std.begin(), std.end());
  held.effect.resize(rows.size(), units.size());
  for (Eigen::Index row = 0; row < rows.size(); ++row)
    held.effect.row(row) =
        (stored.effect.row(row).transpose().array() * (rows[row] / units.array())).transpose();
}

}  // namespace

std::vector<SystemParameter> parametersNamed(const FieldNode& names) {
  std::vector<SystemParameter> parameters;
  for (const FieldNode& name : names.items()) {
    const auto parameter = systemParameterNamed(name.text());
    if (!parameter) name.refuse("names no system parameter: '" + name.text() + "'");
    parameters.push_back(*parameter);
  }
  return parameters;
}

Field<CalibrationResult> priorField() {
  using F = Field<Result>;
  static const Fields<Result> fields(
      "prior", "What was known of the parameters before, and whether this flight agrees.",
      {F::all(priorOf, priorInFileFields()),
       F("differences", &Result::prior_differences, differenceFields(),
         "Between the prior and this flight, of the parameters of which both say something",
         mayBeMissing),
       F("rms_with_prior_m", &Result::rms_with_prior,
         "RMS distance of all pairs with the values of the prior", mayBeMissing)});
  return F("prior", kSameObject, fields, "What was known of the parameters before",
           onlyIf([](const Result& result) {
             return result.prior.any() || !result.prior_differences.empty();
           }),
           reads([](Result& result, const FieldNode& node) {
             fields.read(result, node);
             PriorInFile stored;
             priorInFileFields().read(stored, node);
             result.prior = priorFrom(stored, node);
           }));
}

Field<CalibrationResult> heldField() {
  return Field<Result>("held", heldOf, heldFields(),
                       "Parameters that were neither estimated nor known", reads(readHeld),
                       unlessEmpty);
}

}  // namespace pcl_als::detail
