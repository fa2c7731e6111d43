// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "large_corrections_json.h"

#include <algorithm>
#include <string>

#include "json_number.h"

namespace pcl_als::detail {
namespace {

using Json = nlohmann::ordered_json;

Json placeOf(const Eigen::Vector2d& place) {
  return Json{number(place.x()), number(place.y())};
}

Json causesOf(const LargeCorrection& correction) {
  Json causes = Json::array();
  for (const CorrectionCause& cause : correction.causes)
    causes.push_back(Json{{"name", cause.name}, {"evidence", cause.evidence}});
  return causes;
}

Json correctionOf(const LargeCorrection& correction) {
  const TrajectoryAxis& axis = correction.axisInfo();
  const auto in_unit = [&](double value) { return number(value / axis.internal_per_unit); };
  return Json{{"strip", correction.strip},
              {"from", number(correction.from)},
              {"to", number(correction.to)},
              {"time", number(correction.time)},
              {"axis", axis.name},
              {"value", in_unit(correction.value)},
              {"std", in_unit(correction.std)},
              {"ordinary_std", in_unit(correction.ordinary)},
              {"unit", axis.unit},
              {"on_ground_m", number(correction.on_ground)},
              {"begin", placeOf(correction.begin)},
              {"end", placeOf(correction.end)},
              {"causes", causesOf(correction)}};
}

std::size_t readAxis(const JsonNode& node) {
  const std::string name = node["axis"].text();
  const auto* const axis =
      std::find_if(kTrajectoryAxes.begin(), kTrajectoryAxes.end(),
                   [&](const TrajectoryAxis& candidate) { return candidate.name == name; });
  if (axis == kTrajectoryAxes.end())
    node["axis"].refuse("must be east, north, up, pitch, roll or heading");
  if (node["unit"].text() != axis->unit)
    node["unit"].refuse("must be '" + std::string(axis->unit) + "'");
  return static_cast<std::size_t>(axis - kTrajectoryAxes.begin());
}

Eigen::Vector2d readPlace(const JsonNode& node) {
  const auto items = node.items();
  if (items.size() != 2) node.refuse("must have two numbers, east and north");
  return {items[0].number(), items[1].number()};
}

LargeCorrection readCorrection(const JsonNode& node) {
  LargeCorrection correction;
  correction.strip = node["strip"].text();
  correction.axis = readAxis(node);
  const double unit = correction.axisInfo().internal_per_unit;
  correction.from = node["from"].number();
  correction.to = node["to"].number();
  if (!(correction.from <= correction.to)) node["to"].refuse("must not be earlier than 'from'");
  correction.time = node["time"].number();
  correction.value = unit * node["value"].number();
  correction.std = unit * node["std"].number();
  correction.ordinary = unit * node["ordinary_std"].number();
  correction.on_ground = node["on_ground_m"].number();
  correction.begin = readPlace(node["begin"]);
  correction.end = readPlace(node["end"]);
  for (const JsonNode& cause : node["causes"].items())
    correction.causes.push_back({cause["name"].text(), cause["evidence"].text()});
  return correction;
}

}  // namespace

Json largeCorrectionsOf(const CalibrationResult& result) {
  Json corrections = Json::array();
  for (const LargeCorrection& correction : result.large_corrections)
    corrections.push_back(correctionOf(correction));
  return corrections;
}

void readLargeCorrections(const JsonNode& part, CalibrationResult& result) {
  if (!part.has("large_corrections")) return;
  for (const JsonNode& node : part["large_corrections"].items())
    result.large_corrections.push_back(readCorrection(node));
}

}  // namespace pcl_als::detail
