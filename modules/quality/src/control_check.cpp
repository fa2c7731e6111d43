// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <map>

#include <pcl_als/quality/control_check.h>

namespace pcl_als {
namespace {

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

}  // namespace

std::vector<ControlDifference> controlDifferences(const AreaOffsets& area,
                                                  const ControlPoint& point,
                                                  const std::vector<std::string>& strips) {
  std::vector<ControlDifference> found;
  for (std::size_t strip = 0; strip < strips.size(); ++strip) {
    const auto height = area.heightAt(static_cast<int>(strip), point.position);
    if (!height) continue;
    found.push_back({point.id, strips[strip], point.position, height->above, height->slope,
                     height->roughness, height->unfit});
  }
  return found;
}

ControlAssessment assessControl(std::vector<ControlDifference> differences,
                                const std::vector<ControlPoint>& control,
                                const std::vector<std::string>& strips, double default_sigma) {
  ControlAssessment result;
  result.differences = std::move(differences);
  std::map<std::string, std::int64_t> number_of;
  for (const ControlPoint& point : control)
    number_of.emplace(point.id, static_cast<std::int64_t>(number_of.size()));
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
      const double sigma = point.sigma > 0.0 ? point.sigma : default_sigma;
      squares += sigma * sigma;
    }
  }
  for (const std::string& strip : strips) {
    const OffsetSummary summary = summaryOf(result.differences, number_of, &strip);
    if (summary.count > 0) result.strips.push_back({strip, summary});
  }
  result.all = summaryOf(result.differences, number_of, nullptr);
  if (result.points == 0) return result;
  const double survey = std::sqrt(squares / static_cast<double>(result.points));
  result.accuracy = verticalAccuracy(result.all.rms, survey, result.points);
  result.quality_level = absoluteQualityLevel(result.all.rms);
  return result;
}

}  // namespace pcl_als
