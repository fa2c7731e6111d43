// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <set>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/text_values.h>

namespace pcl_als {
namespace {

double numberIn(std::string_view text, std::string_view entry) {
  if (const auto value = finiteNumber(text)) return *value;
  throw UsageError("bias '" + std::string(entry) + "': '" + std::string(text) +
                   "' is not a number");
}

/// The parameter of an entry NAME=…, which is left in \a entry without it.
SystemParameter parameterOf(std::string_view& entry, std::set<SystemParameter>& given) {
  const auto equals = entry.find('=');
  if (equals == std::string_view::npos)
    throw UsageError("bias '" + std::string(entry) + "': expected NAME=VALUE");
  const std::string_view name = trimmed(entry.substr(0, equals));
  const auto parameter = systemParameterNamed(name);
  if (!parameter) {
    std::string known;
    for (const SystemParameterInfo& info : systemParameters())
      known += (known.empty() ? "" : ", ") + std::string(info.name);
    throw UsageError("bias '" + std::string(name) + "': no such parameter; there are " + known);
  }
  if (!given.insert(*parameter).second)
    throw UsageError("bias '" + std::string(name) + "' is given twice");
  entry = trimmed(entry.substr(equals + 1));
  return *parameter;
}

/// Takes the first entry, up to a comma, from a list.
std::string_view nextEntry(std::string_view& list) {
  const auto comma = list.find(',');
  const std::string_view entry = trimmed(list.substr(0, comma));
  list = comma == std::string_view::npos ? std::string_view() : list.substr(comma + 1);
  return entry;
}

}  // namespace

BiasPrior biasPrior(std::string_view text) {
  BiasPrior prior;
  std::set<SystemParameter> given;
  while (!text.empty()) {
    const std::string_view entry = nextEntry(text);
    if (entry.empty()) continue;
    std::string_view values = entry;
    const SystemParameter p = parameterOf(values, given);
    const auto colon = values.find(':');
    if (colon == std::string_view::npos)
      throw UsageError("prior '" + std::string(entry) + "': expected NAME=VALUE:STD");
    const double unit = infoOf(p).internal_per_unit;
    const double mean = numberIn(trimmed(values.substr(0, colon)), entry) * unit;
    const double std = numberIn(trimmed(values.substr(colon + 1)), entry) * unit;
    if (!(std > 0.0))
      throw UsageError("prior '" + std::string(entry) +
                       "': the standard deviation must be positive");
    const std::string refused = refusedBias(p, mean);
    if (!refused.empty()) throw UsageError("prior '" + std::string(entry) + "': " + refused);
    prior.add(p, mean, std);
  }
  return prior;
}

void setBiases(std::string_view text, SystemVector& bias) {
  std::set<SystemParameter> given;
  for (bool first = true; !text.empty(); first = false) {
    std::string_view entry = nextEntry(text);
    if (entry.empty()) continue;
    if (first && entry == "none") {
      bias.setZero();
      continue;
    }
    const std::string_view whole = entry;
    const SystemParameter p = parameterOf(entry, given);
    bias[indexOf(p)] = numberIn(entry, whole) * infoOf(p).internal_per_unit;
  }
}

SystemVector biasesIn(std::string_view text) {
  if (splitList(text).empty()) throw UsageError("the list of biases names no parameter");
  SystemVector biases = SystemVector::Zero();
  setBiases(text, biases);
  for (const SystemParameterInfo& info : systemParameters()) {
    const std::string refused = refusedBias(info.parameter, biases[indexOf(info.parameter)]);
    if (!refused.empty()) throw UsageError(std::string(info.name) + ": " + refused);
  }
  return biases;
}

SystemParameter requireSystemParameter(const std::string& name) {
  if (const auto parameter = systemParameterNamed(name)) return *parameter;
  std::string names;
  for (const SystemParameterInfo& info : systemParameters()) names.append(" ").append(info.name);
  throw UsageError("'" + name + "' is none of" + names);
}

std::vector<SystemParameter> systemParametersIn(const std::string& list) {
  std::vector<SystemParameter> parameters;
  for (const std::string& name : splitList(list)) {
    const SystemParameter parameter = requireSystemParameter(name);
    if (std::find(parameters.begin(), parameters.end(), parameter) == parameters.end())
      parameters.push_back(parameter);
  }
  if (parameters.empty()) throw UsageError("names no parameter");
  return parameters;
}

}  // namespace pcl_als
