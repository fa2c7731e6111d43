// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "flight_json.h"

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/trajectory_accuracy.h>
#include <pcl_als/trajectory/heading_check.h>
#include <pcl_als/trajectory/trajectory_screening.h>

#include "json_number.h"

namespace pcl_als::detail {
namespace {

using Json = nlohmann::ordered_json;

/// Root mean squares; null where a file states none.
Json deviations(const std::vector<TrajectoryAccuracy>& accuracies) {
  if (accuracies.empty()) return nullptr;
  const AccuracySummary summary = summarize(accuracies);
  return {{"position_m", number(summary.position)},
          {"roll_pitch_arcsec", number(summary.roll_pitch / kRadiansPerArcsec)},
          {"heading_arcsec", number(summary.heading / kRadiansPerArcsec)}};
}

/// How the heading agrees with the course; null without attitude or motion.
Json heading(const TrajectoryFacts& facts) {
  if (!facts.attitude) return nullptr;
  if (facts.attitude_form == AttitudeForm::quaternion)  // still open
    return {{"from_course_deg", nullptr},
            {"follows_course", nullptr},
            {"would_follow_as", nullptr},
            {"axes", facts.axes}};
  const HeadingCheck check = headingCheck(facts.local);
  if (check.count() == 0) return nullptr;
  const HeadingReading best = check.best();
  Json json{{"from_course_deg", number(check.deviation(HeadingReading::heading))},
            {"follows_course", check.followsCourse()},
            {"would_follow_as", nullptr}};
  if (!check.followsCourse() && best != HeadingReading::heading)
    json["would_follow_as"] = std::string(describe(best));
  if (!facts.axes.empty()) json["axes"] = facts.axes;
  return json;
}

/// Samples that are excluded where the trajectory is used, and what makes it unusable.
void addOutliers(Json& json, const TrajectoryFacts& facts) {
  const TrajectoryScreening screening = screenTrajectory(facts.local);
  const auto name = [&](std::size_t sample) { return facts.places.name(sample); };
  json["outliers"] = Json::array();
  for (const OutlierRun& run : screening.outliers) {
    Json entry{{facts.places.lines ? "line" : "record", facts.places.numbers[run.samples.front()]},
               {"samples", run.samples.size()},
               {"time", {run.from, run.to}}};
    if (run.distance > 0.0) entry["distance_m"] = number(run.distance);
    if (run.turn > 0.0) entry["turn_deg"] = number(run.turn / kRadiansPerDegree);
    json["outliers"].push_back(std::move(entry));
  }
  const std::string objection = screening.objection(name);
  json["unusable"] = objection.empty() ? Json(nullptr) : Json(objection);
}

Json trajectory(const std::string& path, const TrajectoryFacts& facts) {
  Json json;
  json["path"] = path;
  json["format"] = facts.format;
  json["frame"] = facts.frame;
  json["columns"] = facts.columns;
  json["samples"] = facts.samples;
  json["time"] = {facts.times.first, facts.times.last};
  json["time_kind"] = facts.time_kind;
  json["samples_per_second"] =
      facts.median_step > 0.0 ? Json(1.0 / facts.median_step) : Json(nullptr);
  json["attitude"] = facts.attitude;
  json["heading"] = heading(facts);
  json["standard_deviations"] = deviations(facts.accuracy);
  addOutliers(json, facts);
  return json;
}

}  // namespace

void addFlight(Json& json, const ListedTrajectory& flight) {
  json["trajectories"] = Json::array();
  for (const auto& [path, facts] : flight.trajectories)
    json["trajectories"].push_back(trajectory(path, facts));
  for (const StripScanner& entry : flight.assessment.scanners)
    json["scanners"].push_back({{"strip", entry.strip},
                                {"type", nameOf(entry.scanner.pattern)},
                                {"channels", entry.scanner.channels},
                                {"angle_deg", entry.scanner.angle / kRadiansPerDegree}});
  if (!flight.trajectories.empty()) json["flight_remarks"] = textsOf(flight.assessment.warnings);
  if (flight.accuracy.empty()) return;
  json["accuracies"] = {{"path", flight.accuracy_path},
                        {"records", flight.accuracy.size()},
                        {"time", {flight.accuracy.front().time, flight.accuracy.back().time}},
                        {"standard_deviations", deviations(flight.accuracy)}};
}

}  // namespace pcl_als::detail
