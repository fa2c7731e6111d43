// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cstdio>

#include <pcl_als/common/file_extension.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/io/trajectory_accuracy.h>
#include <pcl_als/report/inventory_report.h>
#include <pcl_als/trajectory/heading_check.h>
#include <pcl_als/trajectory/trajectory_screening.h>

namespace pcl_als {
namespace {

/// How the heading agrees with the course, where the sensor moves.
std::string headingText(const TrajectoryFacts& facts) {
  if (facts.attitude_form == AttitudeForm::quaternion) return facts.axes;  // still open
  const HeadingCheck check = headingCheck(facts.local);
  if (check.count() == 0) return {};
  char text[200];
  const HeadingReading best = check.best();
  std::snprintf(text, sizeof text, "heading within %.0f degrees of the course",
                check.deviation(HeadingReading::heading));
  if (check.followsCourse()) return text + (facts.axes.empty() ? "" : "; " + facts.axes);
  std::snprintf(text, sizeof text, "heading %.0f degrees from the course%s%s",
                check.deviation(HeadingReading::heading),
                best == HeadingReading::heading ? "" : "; it would follow it as ",
                best == HeadingReading::heading ? "" : std::string(describe(best)).c_str());
  return text;
}

std::string trajectoryText(const std::string& name, const TrajectoryFacts& facts) {
  char times[200];
  std::snprintf(times, sizeof times, "  time %.3f to %.3f s, %s", facts.times.first,
                facts.times.last, facts.time_kind.c_str());
  char rate[60] = "";
  if (facts.median_step > 0.0)
    std::snprintf(rate, sizeof rate, ", %.4g samples per second", 1.0 / facts.median_step);
  std::string text = name + "\n  trajectory: " + facts.format + ", " + grouped(facts.samples) +
                     " samples" + rate + "\n  " + facts.frame + "\n" + times + "\n  " +
                     (facts.attitude ? "roll, pitch and heading" : "no attitude");
  const std::string heading = facts.attitude ? headingText(facts) : std::string();
  if (!heading.empty()) text += "; " + heading;
  text += '\n';
  if (!facts.columns.empty()) text += "  " + facts.columns + '\n';
  if (!facts.accuracy.empty())
    text +=
        "  standard deviations, root mean square: " + describe(summarize(facts.accuracy)) + '\n';
  const TrajectoryScreening screening = screenTrajectory(facts.local);
  const auto name_of = [&](std::size_t sample) { return facts.places.name(sample); };
  const std::string objection = screening.objection(name_of);
  if (!objection.empty())
    text += "  not usable: " + objection + '\n';
  else if (!screening.outliers.empty())
    text += "  " + screening.describe(name_of) + '\n';
  return text;
}

std::string accuracyText(const std::string& name,
                         const std::vector<TrajectoryAccuracy>& accuracies) {
  char times[120];
  std::snprintf(times, sizeof times, "  time %.3f to %.3f s\n", accuracies.front().time,
                accuracies.back().time);
  const char* const format = lowerExtension(name) == ".poq" ? "RIEGL" : "smrmsg";
  return name + "\n  accuracies of a trajectory (" + format + "), " + grouped(accuracies.size()) +
         " records\n" + times +
         "  standard deviations, root mean square: " + describe(summarize(accuracies)) + '\n';
}

}  // namespace

std::string flightText(const ListedTrajectory& flight) {
  std::string text;
  for (const auto& [path, facts] : flight.trajectories) text += trajectoryText(path, facts);
  if (!flight.accuracy.empty()) text += accuracyText(flight.accuracy_path, flight.accuracy);
  return text;
}

std::string assessmentText(const FlightAssessment& assessment) {
  std::string text;
  for (const std::string& scanner : describe(assessment.scanners)) text += "  " + scanner + '\n';
  for (const std::string& note : assessment.notes) text += "  " + note + '\n';
  for (const Warning& warning : assessment.warnings) text += "! " + warning.text + '\n';
  return text;
}

}  // namespace pcl_als
