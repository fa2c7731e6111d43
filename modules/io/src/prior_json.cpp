// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "prior_json.h"

#include <nlohmann/json.hpp>

#include "json_node.h"
#include "json_number.h"

namespace pcl_als::detail {
namespace {

using Json = nlohmann::ordered_json;
using Node = JsonNode;

double unitOf(SystemParameter parameter) {
  return infoOf(parameter).internal_per_unit;
}

Json namesOf(const std::vector<SystemParameter>& parameters) {
  Json names = Json::array();
  for (const SystemParameter p : parameters) names.push_back(infoOf(p).name);
  return names;
}

Json priorOf(const BiasPrior& prior) {
  const std::vector<SystemParameter> known = prior.known();
  const SystemMatrix covariance = prior.covariance();
  Json mean = Json::array(), matrix = Json::array();
  for (const SystemParameter row : known) {
    mean.push_back(number(prior.mean[indexOf(row)] / unitOf(row)));
    Json values = Json::array();
    for (const SystemParameter column : known)
      values.push_back(
          number(covariance(indexOf(row), indexOf(column)) / (unitOf(row) * unitOf(column))));
    matrix.push_back(std::move(values));
  }
  Json entry;
  if (!prior.source.empty()) entry["source"] = prior.source;
  if (prior.attitude) entry["attitude"] = toString(*prior.attitude);
  entry["of_other_missions"] = prior.of_other_missions;
  entry["order"] = namesOf(known);
  entry["mean"] = std::move(mean);
  entry["covariance"] = std::move(matrix);
  return entry;
}

Json differencesOf(const CalibrationResult& result) {
  Json list = Json::array();
  for (const PriorDifference& found : result.prior_differences) {
    const double unit = unitOf(found.parameter);
    list.push_back(Json{{"parameter", infoOf(found.parameter).name},
                        {"prior", number(found.prior / unit)},
                        {"prior_std", number(found.prior_std / unit)},
                        {"flight", number(found.flight / unit)},
                        {"flight_std", number(found.flight_std / unit)},
                        {"change", number(found.change / unit)},
                        {"change_std", number(found.change_std / unit)},
                        {"significant", found.significant},
                        {"released", found.released}});
  }
  return list;
}

Json heldOf(const CalibrationResult& result) {
  const HeldParameters& held = result.held_parameters;
  Json std = Json::array(), effect = Json::array();
  for (std::size_t i = 0; i < held.std.size(); ++i)
    std.push_back(number(held.std[i] / unitOf(held.parameters[i])));
  for (std::size_t row = 0; row < result.correlation_order.size(); ++row) {
    Json values = Json::array();
    for (std::size_t column = 0; column < held.parameters.size(); ++column)
      values.push_back(
          number(held.effect(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) *
                 unitOf(held.parameters[column]) / unitOf(result.correlation_order[row])));
    effect.push_back(std::move(values));
  }
  return Json{{"parameters", namesOf(held.parameters)},
              {"std", std::move(std)},
              {"effect", std::move(effect)}};
}

/// The numbers of a list that has one for each of some parameters, in units that are the factors.
Eigen::VectorXd valuesOf(const Node& list, const std::vector<double>& units) {
  const std::vector<Node> items = list.items();
  if (items.size() != units.size()) list.refuse("must have one number for each parameter");
  Eigen::VectorXd values(static_cast<Eigen::Index>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i)
    values[static_cast<Eigen::Index>(i)] = items[i].numberOrNan() * units[i];
  return values;
}

std::vector<double> unitsOf(const std::vector<SystemParameter>& parameters) {
  std::vector<double> units;
  for (const SystemParameter p : parameters) units.push_back(unitOf(p));
  return units;
}

BiasPrior priorIn(const Node& node, const AttitudeSource* known) {
  const std::vector<SystemParameter> order = parametersNamed(node["order"]);
  const std::vector<double> units = unitsOf(order);
  const Eigen::VectorXd values = valuesOf(node["mean"], units);
  SystemVector mean = SystemVector::Zero();
  Eigen::MatrixXd covariance(order.size(), order.size());
  const std::vector<Node> rows = node["covariance"].items();
  if (rows.size() != order.size())
    node["covariance"].refuse("must have one row for each parameter");
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    mean[indexOf(order[i])] = values[row];
    covariance.row(row) = units[i] * valuesOf(rows[i], units).transpose();
  }
  BiasPrior prior;
  try {
    prior = biasPrior(order, mean, covariance);
  } catch (const InputError& error) {
    node["covariance"].refuse(error.what());
  }
  if (node.has("source")) prior.source = node["source"].text();
  if (known != nullptr) prior.attitude = *known;
  prior.of_other_missions = node["of_other_missions"].truth();
  return prior;
}

/// The source of attitude that a prior names; null where it names none.
const AttitudeSource* attitudeIn(const Node& node) {
  static constexpr AttitudeSource kSources[] = {AttitudeSource::none, AttitudeSource::points,
                                                AttitudeSource::trajectory,
                                                AttitudeSource::nominal};
  if (!node.has("attitude")) return nullptr;
  const std::string text = node["attitude"].text();
  for (const AttitudeSource& source : kSources)
    if (text == toString(source)) return &source;
  node["attitude"].refuse("must be none, points, trajectory or nominal");
}

void readDifferences(const Node& list, CalibrationResult& result) {
  for (const Node& node : list.items()) {
    const auto parameter = systemParameterNamed(node["parameter"].text());
    if (!parameter) node["parameter"].refuse("names no system parameter");
    const double unit = unitOf(*parameter);
    PriorDifference found;
    found.parameter = *parameter;
    found.prior = node["prior"].numberOrNan() * unit;
    found.prior_std = node["prior_std"].numberOrNan() * unit;
    found.flight = node["flight"].numberOrNan() * unit;
    found.flight_std = node["flight_std"].numberOrNan() * unit;
    found.change = node["change"].numberOrNan() * unit;
    found.change_std = node["change_std"].numberOrNan() * unit;
    found.significant = node["significant"].truth();
    found.released = node["released"].truth();
    result.prior_differences.push_back(found);
  }
}

void readHeld(const Node& node, CalibrationResult& result) {
  HeldParameters& held = result.held_parameters;
  held.parameters = parametersNamed(node["parameters"]);
  const std::vector<double> units = unitsOf(held.parameters);
  const Eigen::VectorXd std = valuesOf(node["std"], units);
  held.std.assign(std.begin(), std.end());
  const std::vector<Node> rows = node["effect"].items();
  if (rows.size() != result.correlation_order.size())
    node["effect"].refuse("must have one row for each name of 'correlation.order'");
  held.effect.resize(static_cast<Eigen::Index>(rows.size()), std.size());
  for (std::size_t row = 0; row < rows.size(); ++row) {
    std::vector<double> ratios;
    for (const double unit : units) ratios.push_back(unitOf(result.correlation_order[row]) / unit);
    held.effect.row(static_cast<Eigen::Index>(row)) = valuesOf(rows[row], ratios).transpose();
  }
}

}  // namespace

std::vector<SystemParameter> parametersNamed(const JsonNode& names) {
  std::vector<SystemParameter> parameters;
  for (const JsonNode& name : names.items()) {
    const auto parameter = systemParameterNamed(name.text());
    if (!parameter) name.refuse("names no system parameter: '" + name.text() + "'");
    parameters.push_back(*parameter);
  }
  return parameters;
}

void writePrior(const CalibrationResult& result, nlohmann::ordered_json& part) {
  if (result.prior.any() || !result.prior_differences.empty()) {
    part["prior"] = priorOf(result.prior);
    part["prior"]["differences"] = differencesOf(result);
    part["prior"]["rms_with_prior_m"] = number(result.rms_with_prior);
  }
  if (!result.held_parameters.parameters.empty()) part["held"] = heldOf(result);
}

void readPrior(const JsonNode& part, CalibrationResult& result) {
  if (part.has("prior")) {
    const Node prior = part["prior"];
    result.prior = priorIn(prior, attitudeIn(prior));
    if (prior.has("differences")) readDifferences(prior["differences"], result);
    if (prior.has("rms_with_prior_m"))
      result.rms_with_prior = prior["rms_with_prior_m"].numberOrNan();
  }
  // In files of version 1 the key has the surfaces that were held fixed.
  if (part.has("held") && part["held"].has("parameters")) readHeld(part["held"], result);
}

}  // namespace pcl_als::detail
