// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include <pcl_als/common/listed_names.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/quality/area_offsets.h>
#include <pcl_als/quality/control_check.h>

namespace pcl_als {
namespace {

constexpr double kMostBlunders = 0.1;  // share of control points that may be blunders
constexpr double kHeightSystem = 5.0;  // metres: more than heights of antennas
constexpr std::size_t kNamed = 5;      // points or strips in a sentence

/// Offsets of one strip (or of all) that are used; each point is a cluster.
OffsetSummary summaryOf(const std::vector<ControlDifference>& differences,
                        const std::map<std::string, std::int64_t>& number_of,
                        const std::string* strip) {
  std::vector<double> values;
  std::vector<std::int64_t> clusters;
  for (const ControlDifference& d : differences) {
    if (!d.unfit.empty() || (strip != nullptr && d.strip != *strip)) continue;
    values.push_back(d.above);
    clusters.push_back(number_of.at(d.point));
  }
  return summarize(std::move(values), clusters);
}

double surveySigma(const ControlPoint& point, double default_sigma) {
  return point.sigma > 0.0 ? point.sigma : default_sigma;
}

/// Finds common offsets; differences far from zero and from these are not used.
void judgeDistances(const std::vector<std::string>& strips, double survey_sigma,
                    ControlAssessment& result) {
  result.contradiction = contradictingControl(result.differences, strips, survey_sigma);
  // The few points of a single strip may be of the wrong group.
  const std::vector<std::string> single =
      result.contradiction ? std::vector<std::string>{} : strips;
  result.offsets = commonOffsets(result.differences, single, survey_sigma);
  for (ControlDifference& d : result.differences) {
    if (!d.unfit.empty() || std::abs(d.above) <= result.distance_limit) continue;
    if (result.far.empty() || result.far.back() != d.point) result.far.push_back(d.point);
    const bool agrees =
        std::any_of(result.offsets.begin(), result.offsets.end(), [&](const CommonOffset& common) {
          return (common.strip.empty() || common.strip == d.strip) &&
                 std::abs(d.above - common.offset) <= result.distance_limit;
        });
    if (!agrees) d.unfit = "too far off: another surface, or a blunder";
  }
}

/// \param covered points that strips cover
void assessAccuracy(double survey_squares, std::size_t covered, ControlAssessment& result) {
  const std::size_t far = result.far.size();
  const auto blunders = static_cast<std::size_t>(kMostBlunders * static_cast<double>(covered));
  if (far > std::max<std::size_t>(1, blunders) || 2 * far > covered)
    result.no_class = std::to_string(far) + " of " + counted(covered, "control point") +
                      (far == 1 ? " lies" : " lie") + " more than " +
                      shortText(result.distance_limit) + " m above or below the strips";
  if (result.points == 0) return;
  const double survey = std::sqrt(survey_squares / static_cast<double>(result.points));
  result.accuracy = verticalAccuracy(result.all.rms, survey, result.points);
  if (result.no_class.empty()) result.quality_level = absoluteQualityLevel(result.all.rms);
}

/// Which strips have which offsets, and what makes offsets of that size.
std::string offsetText(const std::vector<CommonOffset>& offsets) {
  std::string text;
  double largest = 0.0;
  for (std::size_t i = 0; i < std::min(kNamed, offsets.size()); ++i) {
    text += (i == 0 ? "" : "; ") + offsets[i].describe();
    largest = std::max(largest, std::abs(offsets[i].offset));
  }
  if (offsets.size() > kNamed) text += "; and " + counted(offsets.size() - kNamed, "more strip");
  if (largest > kHeightSystem)
    return text + ": check the vertical datum (ellipsoid or geoid) and the unit of the heights";
  return text +
         ": check the antenna height and the coordinates of the base station, the geoid or " +
         "vertical datum and the unit of the heights" +
         (offsets.front().strip.empty() ? ", and the range bias" : " of these strips");
}

/// The points whose differences are not used because of their size, with the largest of each.
std::string farText(const ControlAssessment& control) {
  std::map<std::string, double> largest;
  for (const ControlDifference& d : control.differences) {
    if (d.unfit.empty() || std::abs(d.above) <= control.distance_limit) continue;
    if (std::find(control.far.begin(), control.far.end(), d.point) == control.far.end()) continue;
    double& above = largest[d.point];
    if (std::abs(d.above) > std::abs(above)) above = d.above;
  }
  std::vector<std::string> names;
  for (const auto& [point, above] : largest) {
    char size[32];
    std::snprintf(size, sizeof size, " (%+.2f m)", above);
    names.push_back(point + size);
  }
  return listedNames(names, kNamed);
}

std::string shiftText(const HorizontalShift& shift) {
  char text[160];
  std::snprintf(text, sizeof text, "%.2f ± %.2f m %s and %.2f ± %.2f m %s",
                std::abs(shift.shift.x()), shift.std.x(), shift.shift.x() < 0.0 ? "west" : "east",
                std::abs(shift.shift.y()), shift.std.y(),
                shift.shift.y() < 0.0 ? "south" : "north");
  return text;
}

}  // namespace

std::vector<ControlDifference> controlDifferences(const AreaOffsets& area,
                                                  const ControlPoint& point,
                                                  const std::vector<std::string>& strips) {
  std::vector<ControlDifference> found;
  for (std::size_t strip = 0; strip < strips.size(); ++strip) {
    const auto height = area.heightAt(static_cast<int>(strip), point.position);
    if (!height) continue;
    found.push_back({point.id, strips[strip], point.position, height->above, height->slope,
                     height->roughness, height->unfit, height->normal, height->slope_std});
  }
  return found;
}

ControlAssessment assessControl(std::vector<ControlDifference> differences,
                                const std::vector<ControlPoint>& control,
                                const std::vector<std::string>& strips, double default_sigma,
                                double distance_limit) {
  ControlAssessment result;
  result.differences = std::move(differences);
  result.distance_limit = distance_limit;
  std::map<std::string, std::int64_t> number_of;
  double largest_sigma = 0.0;
  for (const ControlPoint& point : control) {
    number_of.emplace(point.id, static_cast<std::int64_t>(number_of.size()));
    largest_sigma = std::max(largest_sigma, surveySigma(point, default_sigma));
  }
  judgeDistances(strips, largest_sigma, result);
  std::map<std::string, bool> counts;  // whether a covered point is used
  for (const ControlDifference& d : result.differences)
    counts[d.point] = counts[d.point] || d.unfit.empty();
  double squares = 0.0;
  for (const ControlPoint& point : control) {
    const auto seen = counts.find(point.id);
    if (seen == counts.end()) {
      result.unseen.push_back(point.id);
    } else if (seen->second) {
      ++result.points;
      result.survey_known = result.survey_known || point.sigma > 0.0;
      const double sigma = surveySigma(point, default_sigma);
      squares += sigma * sigma;
    }
  }
  for (const std::string& strip : strips) {
    const OffsetSummary summary = summaryOf(result.differences, number_of, &strip);
    if (summary.count > 0) result.strips.push_back({strip, summary});
  }
  result.all = summaryOf(result.differences, number_of, nullptr);
  result.shift = shiftOntoControl(result.differences);
  assessAccuracy(squares, counts.size(), result);
  return result;
}

Warnings warningsOf(const ControlAssessment& control) {
  Warnings warnings;
  if (!control.offsets.empty()) warnings.emplace_back(offsetText(control.offsets));
  if (control.contradiction)
    warnings.emplace_back(
        "the control points contradict each other: " + control.contradiction->describe() +
        ": check how the heights of these points were measured");
  const std::string far = farText(control);
  if (!far.empty())
    warnings.emplace_back(
        "the strips lie more than " + shortText(control.distance_limit) +
            " m above (+) or below (-) control points, which are not used there: " + far +
            ": blunders, or points on other surfaces",
        Hint::max_distance);
  if (isSignificantInPlan(control.shift))
    warnings.emplace_back(
        "control on slopes shows a shift in plan: a movement of the strips by " +
        shiftText(control.shift) +
        " brings them onto control: check the datum and the coordinates of the base station");
  return warnings;
}

}  // namespace pcl_als
