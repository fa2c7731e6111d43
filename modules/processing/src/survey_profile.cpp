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
  survey.readAlone([&](int strip, const LidarReturn* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (points[i].isSingle()) search.add(points[i].position, static_cast<std::size_t>(strip));
    }
  });
  return search.find(1);
}

/// Points in order of time, as they are and corrected.
struct StripPart {
  std::vector<Eigen::Vector3d> before, after;
};

Eigen::Vector3d corrected(const LidarReturn& point, const BiasEvaluator& correction) {
  const Eigen::Vector3d& at = point.position;
  Eigen::Vector3d effect = Eigen::Vector3d::Zero();
  CoverageCount coverage;
  correction.effect({&point.time, &at.x(), &at.y(), &at.z()}, 1,
                    {&effect.x(), &effect.y(), &effect.z()}, coverage);
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
  survey.readAlone([&](int strip, const LidarReturn* points, std::size_t count) {
    StripPart& part = parts[static_cast<std::size_t>(strip)];
    for (std::size_t i = 0; i < count; ++i) {
      if (!line.contains(points[i].position.head<2>(), kLargestShift)) continue;
      part.before.push_back(points[i].position);
      part.after.push_back(corrected(points[i], correction));
    }
  });
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
