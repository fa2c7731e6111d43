// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <vector>

#include <pcl_als/processing/picture/section_places.h>
#include <pcl_als/processing/picture/survey_profile.h>

namespace pcl_als {
namespace {

constexpr double kLargestShift = 5.0;  // metres that a correction moves points by in plan, at most

std::vector<SectionSearch::Place> findPlaces(const SurveyReader& survey) {
  const std::size_t strips = survey.strips().size();
  const std::vector<bool> all(strips, true);
  SectionSearch search(survey.corner(), survey.farCorner(),
                       sectionCell(stripDensities(survey.files(), survey.arrangement()), all),
                       strips);
  const auto add = [&](const SurveyReader::Run& run) {
    for (std::size_t row = run.from; row < run.to; ++row)
      if (run.chunk.number_of_returns[row] <= 1)
        search.add(run.position(row), static_cast<std::size_t>(run.strip));
  };
  survey.read(add, SurveyReader::Reading::by(SurveyReader::Reading::Share::all));
  return search.find(1);
}

/// Points in order of time, as they are and corrected.
struct StripPart {
  std::vector<Eigen::Vector3d> before, after;
};

Eigen::Vector3d corrected(const Eigen::Vector3d& at, double time, const BiasEvaluator& correction) {
  Eigen::Vector3d effect = Eigen::Vector3d::Zero();
  CoverageCount coverage;
  correction.effect({&time, &at.x(), &at.y(), &at.z()}, 1, {&effect.x(), &effect.y(), &effect.z()},
                    coverage);
  return at - effect;
}

}  // namespace

std::optional<SurveyProfile> findProfile(const SurveyReader& survey,
                                         const BiasEvaluator& correction) {
  const std::vector<SectionSearch::Place> places = findPlaces(survey);
  if (places.empty()) return std::nullopt;
  const SectionLine& line = places[0].line;
  // By strip: they are read at the same time.
  std::vector<StripPart> parts(survey.strips().size());
  const auto add = [&](const SurveyReader::Run& run) {
    StripPart& part = parts[static_cast<std::size_t>(run.strip)];
    for (std::size_t row = run.from; row < run.to; ++row) {
      const Eigen::Vector3d position = run.position(row);
      if (!line.contains(position.head<2>(), kLargestShift)) continue;
      part.before.push_back(position);
      part.after.push_back(corrected(position, run.time(run.chunk.gps_time[row]), correction));
    }
  };
  survey.read(add, SurveyReader::Reading::by(SurveyReader::Reading::Share::all));
  SurveyProfile profile{places[0], SectionPoints(line), SectionPoints(line)};
  for (std::size_t strip = 0; strip < parts.size(); ++strip) {
    for (const Eigen::Vector3d& point : parts[strip].before)
      profile.before.add(point, static_cast<int>(strip));
    for (const Eigen::Vector3d& point : parts[strip].after)
      profile.after.add(point, static_cast<int>(strip));
  }
  return profile;
}

}  // namespace pcl_als
