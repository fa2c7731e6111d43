// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "report_parts.h"

#include <pcl_als/common/number_text.h>
#include <pcl_als/survey/survey_reader.h>

namespace pcl_als {

SurveyObserver ObservedBlock::observer() {
  const auto begin = [this](const SurveyReader& survey) {
    strips = survey.strips();
    coverage = std::make_unique<StripCoverage>(survey.corner(), survey.farCorner(), strips.size());
  };
  const auto add = [this](int strip, const LidarReturn* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      coverage->add(points[i].position, static_cast<std::size_t>(strip));
  };
  return {begin, add};
}

std::string centimetres(double metres) {
  return numberText(100.0 * metres, 1) + " cm";
}

void addVerdict(const Verdict& verdict, HtmlReport& report) {
  report.setVerdict(verdict.grade, verdict.headline);
  for (const std::string& sentence : verdict.sentences) report.addVerdict(sentence);
}

void addMap(const std::vector<ControlPoint>& control, const StripCoverage& coverage,
            const std::vector<std::string>& strips, const std::vector<SurveyArea>& areas,
            HtmlReport& report, const std::vector<LargeCorrection>& corrections) {
  BlockMap map;
  map.setTitle(areas.empty() ? "Strips and overlaps"
                             : "Strips, overlaps and the areas that were used");
  std::vector<BlockMap::Area> boxes;
  boxes.reserve(areas.size());
  for (const SurveyArea& area : areas) {
    boxes.push_back({area.minimum, area.minimum + Eigen::Vector2d::Constant(area.size)});
  }
  map.setAreas(std::move(boxes));
  std::string caption = "Outlines of the strips and number of strips at each place";
  if (!areas.empty()) caption += ", areas that were used";
  if (!control.empty()) {
    std::vector<Eigen::Vector2d> places;
    places.reserve(control.size());
    for (const ControlPoint& point : control) places.emplace_back(point.position.head<2>());
    map.setControl(std::move(places));
    caption += ", control";
  }
  if (!corrections.empty()) {
    std::vector<BlockMap::Mark> marks;
    for (const LargeCorrection& correction : corrections)
      marks.push_back({correction.begin, correction.end, std::to_string(marks.size() + 1)});
    map.setMarks(std::move(marks), "largest trajectory errors");
    caption += ", largest errors of the trajectory with the numbers of their table";
  }
  report.addSection("Map");
  const PictureSize size{1400, BlockMap::heightFor(coverage, 1400)};
  report.addPicture(map.draw(coverage, strips, size), caption + ".");
}

void addWarnings(const Warnings& warnings, HtmlReport& report) {
  if (warnings.empty()) return;
  report.addSection("Warnings");
  report.addList(textsOf(warnings));
}

void addOrigin(const ReportOrigin& origin, const std::vector<std::string>& inputs,
               HtmlReport& report) {
  for (const std::string& input : inputs) report.addInput(input);
  for (const std::string& input : origin.inputs) report.addInput(input);
  for (const auto& [name, value] : origin.settings) report.addSetting(name, value);
}

}  // namespace pcl_als
