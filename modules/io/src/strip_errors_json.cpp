// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_errors_json.h"

#include <array>
#include <cmath>
#include <string>

#include <pcl_als/common/system_parameters.h>

#include "json_number.h"

namespace pcl_als::detail {
namespace {

using Json = nlohmann::ordered_json;
using Node = JsonNode;

// No trajectory of a survey is wrong by more, and a lever arm or boresight is not either.
constexpr double kLargestShift = 100.0;   // metres
constexpr double kLargestTurn = 20000.0;  // arc-seconds

/// Errors of a knot with the names of their values, in the order of the file.
struct KnotValue {
  const char* name;
  const char* unit;
  double internal_per_unit, limit;
};
constexpr std::array<KnotValue, 6> kKnotValues{
    {{"east", "m", 1.0, kLargestShift},
     {"north", "m", 1.0, kLargestShift},
     {"up", "m", 1.0, kLargestShift},
     {"pitch", "arcsec", kRadiansPerArcsec, kLargestTurn},
     {"roll", "arcsec", kRadiansPerArcsec, kLargestTurn},
     {"heading", "arcsec", kRadiansPerArcsec, kLargestTurn}}};

std::string keyOf(const KnotValue& value, const char* middle) {
  return std::string(value.name) + middle + "_" + value.unit;
}

double& valueOf(Eigen::Vector3d& position, Eigen::Vector3d& angles, std::size_t i) {
  return i < 3 ? position[static_cast<Eigen::Index>(i)] : angles[static_cast<Eigen::Index>(i) - 3];
}

Json knotOf(TrajectoryErrorKnot knot) {
  Json json{{"time", number(knot.time)}};
  for (std::size_t i = 0; i < kKnotValues.size(); ++i) {
    const KnotValue& value = kKnotValues[i];
    json[keyOf(value, "")] =
        number(valueOf(knot.position, knot.angles, i) / value.internal_per_unit);
  }
  for (std::size_t i = 0; i < kKnotValues.size() && knot.hasStd(); ++i) {
    const KnotValue& value = kKnotValues[i];
    json[keyOf(value, "_std")] =
        number(valueOf(knot.position_std, knot.angles_std, i) / value.internal_per_unit);
  }
  return json;
}

/// The lower triangle of the correlations with each other, row by row; those with the parameters,
/// error by error.
Json correlationOf(const StripErrorCorrelation& correlation) {
  Json errors = Json::array(), parameters = Json::array();
  for (Eigen::Index row = 1; row < 6; ++row) {
    for (Eigen::Index column = 0; column < row; ++column)
      errors.push_back(number(correlation.errors(row, column)));
  }
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = 0; column < correlation.parameters.cols(); ++column)
      parameters.push_back(number(correlation.parameters(row, column)));
  }
  return Json{{"time", correlation.time},
              {"errors", std::move(errors)},
              {"parameters", std::move(parameters)}};
}

Json levelsOf(const ErrorLevels& levels) {
  const auto arcsec = [](double radians) { return number(radians / kRadiansPerArcsec); };
  return Json{{"range_m", number(levels.range)},
              {"angle_arcsec", arcsec(levels.angle)},
              {"footprint_arcsec", arcsec(levels.footprint)},
              {"position_m", number(levels.position)},
              {"trajectory_position_m", number(levels.trajectory_position)},
              {"trajectory_roll_pitch_arcsec", arcsec(levels.trajectory_roll_pitch)},
              {"trajectory_heading_arcsec", arcsec(levels.trajectory_heading)}};
}

double standardDeviation(const Node& node, double limit, const char* unit) {
  const double value = node.within(limit, unit);
  if (value < 0.0) node.refuse("is a standard deviation and must not be negative");
  return value;
}

TrajectoryErrorKnot readKnot(const Node& node) {
  TrajectoryErrorKnot knot;
  knot.time = node["time"].number();
  const bool with_std = node.has(keyOf(kKnotValues[0], "_std").c_str());
  for (std::size_t i = 0; i < kKnotValues.size(); ++i) {
    const KnotValue& value = kKnotValues[i];
    valueOf(knot.position, knot.angles, i) =
        value.internal_per_unit * node[keyOf(value, "")].within(value.limit, value.unit);
    if (with_std)
      valueOf(knot.position_std, knot.angles_std, i) =
          value.internal_per_unit *
          standardDeviation(node[keyOf(value, "_std")], value.limit, value.unit);
  }
  return knot;
}

std::vector<double> correlationsOf(const Node& node, std::size_t count) {
  std::vector<double> values;
  for (const Node& item : node.items()) values.push_back(item.within(1.0, "(correlation)"));
  if (values.size() != count)
    node.refuse("must have " + std::to_string(count) + " values, has " +
                std::to_string(values.size()));
  return values;
}

StripErrorCorrelation readCorrelation(const Node& node, std::size_t parameters) {
  StripErrorCorrelation correlation;
  correlation.time = node["time"].number();
  correlation.errors.setIdentity();
  const std::vector<double> errors = correlationsOf(node["errors"], 15),
                            others = correlationsOf(node["parameters"], 6 * parameters);
  std::size_t at = 0;
  for (Eigen::Index row = 1; row < 6; ++row) {
    for (Eigen::Index column = 0; column < row; ++column)
      correlation.errors(row, column) = correlation.errors(column, row) = errors[at++];
  }
  correlation.parameters.resize(6, static_cast<Eigen::Index>(parameters));
  at = 0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = 0; column < correlation.parameters.cols(); ++column)
      correlation.parameters(row, column) = others[at++];
  }
  return correlation;
}

void readStrip(const Node& node, CalibrationResult& result) {
  StripErrors strip;
  strip.id = node["strip"].text();
  for (const Node& at : node["knots"].items()) strip.knots.push_back(readKnot(at));
  if (node.has("correlations")) {
    for (const Node& at : node["correlations"].items()) {
      strip.correlations.push_back(readCorrelation(at, result.correlation_order.size()));
      const auto& all = strip.correlations;
      if (all.size() > 1 && !(all[all.size() - 2].time < all.back().time))
        at["time"].refuse("must be later than the one before");
    }
  }
  result.strip_errors.push_back(std::move(strip));
}

ErrorLevels readLevels(const Node& node) {
  const auto metres = [&](const char* key) {
    return standardDeviation(node[key], kLargestShift, "m");
  };
  const auto arcsec = [&](const char* key) {
    return kRadiansPerArcsec * standardDeviation(node[key], kLargestTurn, "arcsec");
  };
  ErrorLevels levels;
  levels.range = metres("range_m");
  levels.angle = arcsec("angle_arcsec");
  levels.footprint = arcsec("footprint_arcsec");
  levels.position = metres("position_m");
  levels.trajectory_position = metres("trajectory_position_m");
  levels.trajectory_roll_pitch = arcsec("trajectory_roll_pitch_arcsec");
  levels.trajectory_heading = arcsec("trajectory_heading_arcsec");
  return levels;
}

}  // namespace

Json stripErrorsOf(const CalibrationResult& result) {
  Json strips = Json::array();
  for (const StripErrors& strip : result.strip_errors) {
    Json knots = Json::array(), correlations = Json::array();
    for (const TrajectoryErrorKnot& knot : strip.knots) knots.push_back(knotOf(knot));
    for (const auto& correlation : strip.correlations)
      correlations.push_back(correlationOf(correlation));
    Json json{{"strip", strip.id}, {"knots", std::move(knots)}};
    if (!correlations.empty()) json["correlations"] = std::move(correlations);
    strips.push_back(std::move(json));
  }
  return strips;
}

void readStripErrors(const Node& part, CalibrationResult& result) {
  if (!part.has("strip_corrections")) return;
  for (const Node& node : part["strip_corrections"].items()) readStrip(node, result);
}

void writeErrorLevels(const CalibrationResult& result, Json& part) {
  if (result.error_levels) part["error_levels"] = levelsOf(*result.error_levels);
}

void readErrorLevels(const Node& part, CalibrationResult& result) {
  if (part.has("error_levels")) result.error_levels = readLevels(part["error_levels"]);
}

}  // namespace pcl_als::detail
