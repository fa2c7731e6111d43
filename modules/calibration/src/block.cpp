// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "block.h"

#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/memory.h>
#include <pcl_als/common/parallel.h>

#include "block_flight.h"
#include "control_coverage.h"
#include "group_differences.h"
#include "strip_selection.h"
#include "system_groups.h"

namespace pcl_als {
namespace {

/// Side of the area that contains a target wherever it is searched for, and the ground around it.
double targetAreaSize(const ControlPoint& point, double window) {
  constexpr double kAround = 2.0;  // diameters
  if (point.kind != ControlPoint::Kind::target) return 0.0;
  return 2.0 * window + kAround * point.diameter;
}

SurveyArea areaOf(const ControlPoint& point, const CalibrationSettings& settings) {
  constexpr double kControlAreaSize = 4.0;  // metres: contains the patch at a control point
  const double size = std::max(
      {kControlAreaSize, point.extent, targetAreaSize(point, settings.max_normal_distance)});
  const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * size);
  return {point.position.head<2>() - half, size, settings.selection.margin};
}

std::vector<SurveyedStrip> surveyedStrips(const BlockIndex& index) {
  std::vector<SurveyedStrip> strips;
  for (int strip = 0; strip < static_cast<int>(index.strips().size()); ++strip)
    strips.push_back({{index.map().startTime(strip), index.map().endTime(strip)},
                      index.map().pointCount(strip),
                      index.plausibility().meanHeight(strip)});
  return strips;
}

/// Refuses control that is in another coordinate reference system or unit; returns why none can be
/// used.
std::string checkControl(const BlockStrips& strips, const SurveyMap& map,
                         const BlockRequest& request, Warnings& warnings) {
  const ControlCoverage coverage = coverageOf(request.control, map, strips.flown());
  if (coverage.objection.empty()) return coverage.remark;
  if (!request.settings.force) throw InputError(coverage.objection, Hint::force);
  warnings.push_back(coverage.objection);
  return coverage.remark;
}

/// The strips with their passes and systems; by session, channel and scanner where none are given.
void assignSystems(SurveyBlock& block) {
  const CalibrationSettings& settings = block.settings();
  const std::vector<std::string>& ids = block.strips.ids;
  const std::vector<TimeSpan> flown = block.flownTimes();
  const std::vector<int> passes = passesOf(ids, flown);
  if (settings.systems.empty() && settings.diagnose)
    block.compared = comparedGroups(ids, flown, passes);
  block.systems = block.compared.empty() ? stripSystems(settings.systems, settings.own, ids, passes)
                                         : stripSystems(block.compared, {{}, false}, ids, passes);
  holdSurfaces(settings, block.strips, block.systems);
}

double highest(const std::vector<SurveyedStrip>& strips) {
  double height = 0.0;
  for (const SurveyedStrip& strip : strips) height = std::max(height, strip.height);
  return height;
}

}  // namespace

std::vector<TimeSpan> SurveyBlock::flownTimes() const {
  std::vector<TimeSpan> spans;
  for (std::size_t i = 0; i < strips.size(); ++i)
    spans.push_back(strips.isFlown(static_cast<int>(i)) ? surveyed[i].span : TimeSpan(0.0, 0.0));
  return spans;
}

SurveyBlock chooseAreas(BlockIndex&& given, const BlockRequest& request) {
  BlockIndex index = std::move(given);
  const SurveyMap& map = index.map();
  SurveyBlock block;
  block.request = request;
  block.strips = index.strips();
  block.surveyed = surveyedStrips(index);
  assignSystems(block);
  CalibrationSettings& settings = block.request.settings;
  settings.limits = settings.limits.atHeight(highest(block.surveyed));
  StripSelection selection = selectStrips(block.strips, index, block.request);
  block.strips = std::move(selection.strips);
  block.excluded = std::move(selection.excluded);
  block.warnings = std::move(selection.warnings);
  checkTimes(block.strips, index);
  const HeightError height_error =
      checkTrajectory(block.strips, settings, index.plausibility(), block.warnings);
  block.flight = flightOf(block.strips, index, settings, block.warnings);
  block.flight.height_error = height_error;
  block.scanner = findScanner(block.strips, index, block.flight);
  block.control_remark = checkControl(block.strips, map, block.request, block.warnings);
  checkReferences(block.strips, map, settings);
  block.pairs = choosePairs(block.strips, map, block.request, block.warnings);
  block.areas = map.selectAreas(block.pairs, settings.selection);
  for (const ControlPoint& point : request.control) block.areas.push_back(areaOf(point, settings));
  block.pair_heights.resize(block.pairs.size());
  parallelFor(block.pairs.size(), settings.threads,
              [&](std::size_t i) { block.pair_heights[i] = map.heightOffset(block.pairs[i]); });
  index = BlockIndex(block.flight.trajectory, Eigen::Vector2d::Zero());
  returnFreeMemory();  // the cells of a large survey need as much memory as its pairs do later
  return block;
}

}  // namespace pcl_als
