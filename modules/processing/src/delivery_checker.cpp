// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/number_text.h>
#include <pcl_als/common/statistics.h>
#include <pcl_als/processing/delivery_checker.h>
#include <pcl_als/quality/strip_alignment.h>
#include <pcl_als/survey/area_index.h>
#include <pcl_als/survey/offset_from_block.h>
#include <pcl_als/survey/survey_map.h>
#include <pcl_als/trajectory/scan_geometry.h>

#include "delivery_messages.h"

namespace pcl_als {
namespace {

constexpr std::size_t kCourseEvery = 64;     // of the points show the course
constexpr std::size_t kRoughnessAreas = 24;  // that show what smooth is
constexpr double kRoughnessFactor = 2.0;     // of the median on gentle slopes is still smooth
constexpr double kLeastRoughness = 0.02;     // metres
constexpr double kControlArea = 4.0;         // metres: the patch around a point is enough
constexpr double kRepeated = 0.2;            // share of repeated points worth a warning

using detail::Clock;
using detail::millisecondsSince;

/// Scan angles of LAS: positive to the right of flight.
float lookAngle(const ScanGeometry& geometry) {
  return static_cast<float>(-geometry.beta / kRadiansPerDegree);
}

}  // namespace

DeliveryChecker::DeliveryChecker(SurveyReader& survey, const CheckSettings& settings,
                                 std::shared_ptr<const Trajectory> trajectory)
    : survey_(survey),
      settings_(settings),
      trajectory_(std::move(trajectory)),
      map_(survey.corner()),
      courses_(survey.strips().size()),
      used_(survey.strips().size(), true),
      untimed_(survey.strips().size(), false) {
  if (trajectory_) plausibility_.emplace(trajectory_, TrajectoryPlausibility::Attitude::needed);
  for (const std::string& id : survey.strips()) {
    map_.addStrip();
    if (plausibility_) plausibility_->addStrip(id);
  }
}

LidarReturn DeliveryChecker::pointOf(const SurveyReader::Run& run, std::size_t row,
                                     std::size_t& cursor) const {
  LidarReturn point = run.point(row);
  SensorPose pose;
  if (!trajectory_ || untimed_[static_cast<std::size_t>(run.strip)]) return point;
  if (trajectory_->poseAt(point.time, pose, cursor)) {
    point.scan_angle = lookAngle(scanGeometry(pose, point.position));
  } else {
    ++uncovered_;
  }
  return point;
}

std::vector<ExcludedPoints> DeliveryChecker::surveyBlock() {
  std::vector<ExcludedPoints> excluded = survey_.read([&](const SurveyReader::Run& run) {
    const int strip = run.strip;
    thread_local std::vector<LidarReturn> points;
    run.points(points);
    map_.add(strip, points.data(), points.size());
    std::size_t cursor = 0;
    for (std::size_t row = run.from; row < run.to; row += kCourseEvery) {
      const LidarReturn point = pointOf(run, row, cursor);
      if (isCheckable(point)) courses_[static_cast<std::size_t>(strip)].add(point);
    }
    if (plausibility_) plausibility_->addRun(strip, points.data(), points.size());
  });
  shareStrips();
  for (std::size_t strip = 0; strip < used_.size(); ++strip) {
    const int index = static_cast<int>(strip);
    const std::string& id = survey_.strips()[strip];
    if (map_.invalidCount(index) > 0)
      warnings_.push_back("strip " + id + ": " + counted(map_.invalidCount(index), "point") +
                          " with a time or coordinate that is not finite excluded");
    used_[strip] = map_.pointCount(index) >= settings_.minimum_points;
    if (used_[strip]) continue;
    const std::size_t count = map_.pointCount(index);
    excluded_.push_back({id, ExclusionReason::too_few_points, count, count});
    warnings_.push_back("strip " + id + " has only " + counted(count, "point") +
                        " and is excluded");
  }
  checkTrajectory();
  for (const SurveyMap::Overlap& overlap : map_.overlaps(0.0)) {
    if (used_[overlap.strips.first] && used_[overlap.strips.second]) overlaps_.push_back(overlap);
  }
  if (!overlaps_.empty() || !settings_.control.empty()) return excluded;
  const auto used = std::count(used_.begin(), used_.end(), true);
  throw InputError(
      used < 2 ? "fewer than two strips with enough points and no control: nothing to compare"
               : "no two strips overlap and there is no control: nothing to compare");
}

void DeliveryChecker::checkTrajectory() {
  if (!plausibility_) return;
  for (std::size_t i = 0; i < used_.size(); ++i) {
    const int strip = static_cast<int>(i);
    untimed_[i] = plausibility_->timesTooCoarse(strip);
    if (!used_[i] || untimed_[i]) plausibility_->exclude(strip);
    if (!used_[i] || !untimed_[i]) continue;
    warnings_.push_back("strip " + survey_.strips()[i] + ": its GPS times are rounded to " +
                        plausibility_->timeSteps(strip) +
                        ", too coarse for the trajectory: its scan angles are the file's");
  }
  for (const Warning& warning : plausibility_->check(settings_.force)) warnings_.push_back(warning);
}

double DeliveryChecker::coveredArea() const {
  double area = 0.0;
  for (std::size_t strip = 0; strip < used_.size(); ++strip)
    area += map_.coveredArea(static_cast<int>(strip));
  return area;
}

void DeliveryChecker::chooseAreas() {
  std::vector<StripPair> pairs;
  for (const SurveyMap::Overlap& overlap : overlaps_) {
    if (overlap.area >= settings_.minimum_overlap) pairs.push_back(overlap.strips);
  }
  setAreas(map_.selectAreas(pairs, settings_.selection));
}

void DeliveryChecker::setAreas(std::vector<SurveyArea> areas) {
  areas_ = std::move(areas);
  offsets_.clear();
  control_offsets_.clear();
  for (const SurveyArea& area : areas_) offsets_.emplace_back(area, courses_.size());
  for (const ControlPoint& point : settings_.control) {
    const Eigen::Vector2d half = Eigen::Vector2d::Constant(0.5 * kControlArea);
    control_offsets_.emplace_back(
        SurveyArea{point.position.head<2>() - half, kControlArea, settings_.selection.margin},
        courses_.size());
  }
  const std::size_t spread = std::max<std::size_t>(1, areas_.size());
  settings_.limits.candidates = std::clamp<std::size_t>(settings_.candidates / spread, 100, 4000);
}

void DeliveryChecker::load(const PointSink& also) {
  std::vector<AreaOffsets*> targets;
  std::vector<SurveyArea> squares;
  for (std::vector<AreaOffsets>* some : {&offsets_, &control_offsets_}) {
    for (AreaOffsets& offsets : *some) {
      const SurveyArea& area = offsets.area();
      targets.push_back(&offsets);
      squares.push_back({area.minimum, area.size, area.margin});
    }
  }
  const AreaIndex index(squares);
  // A sink receives all points in the first process, which has read its own strips only.
  const bool apart = also && areShared(survey_.processes());
  uncovered_ = 0;
  survey_.read([&](const SurveyReader::Run& run) {
    const int strip = run.strip;
    if (!used_[static_cast<std::size_t>(strip)]) return;
    std::size_t cursor = 0;
    for (std::size_t row = run.from; row < run.to; ++row) {
      const Eigen::Vector3d position = run.position(row);
      if (!position.allFinite()) continue;
      const std::vector<int>& holding = index.candidates(position);
      if (holding.empty() && (!also || apart)) continue;
      const LidarReturn point = pointOf(run, row, cursor);
      for (const int area : holding) targets[static_cast<std::size_t>(area)]->add(strip, point);
      if (also && !apart) also(strip, point);
    }
  });
  shareAreas();
  if (uncovered_ > 0)
    warnings_.push_back("the trajectory does not cover " + std::to_string(uncovered_) +
                        " of the points used: their scan angles are the file's");
  if (apart) readByFirst(also);
}

void DeliveryChecker::readByFirst(const PointSink& sink) {
  using Reading = SurveyReader::Reading;
  const auto pass = [&](const SurveyReader::Run& run) {
    if (!used_[static_cast<std::size_t>(run.strip)]) return;
    std::size_t cursor = 0;
    for (std::size_t row = run.from; row < run.to; ++row)
      if (run.position(row).allFinite()) sink(run.strip, pointOf(run, row, cursor));
  };
  survey_.read(pass, Reading::by(Reading::Share::first));
}

void DeliveryChecker::findRoughness() {
  const std::size_t looked = std::min(areas_.size(), kRoughnessAreas);
  std::vector<std::vector<double>> found(target_shares_.count());
  std::vector<bool> chosen(areas_.size(), false);
  for (std::size_t i = 0; i < looked; ++i) chosen[i * areas_.size() / looked] = true;
  forOwn(0, areas_.size(), [&](std::size_t i) {
    if (!chosen[i]) return;
    AreaOffsets& area = offsets_[i];
    area.build(settings_.limits, survey_.resolution());
    found[i] = area.roughness();
  });
  shareVectors(survey_.processes(), target_shares_, found);
  std::vector<double> all;
  for (const auto& values : found) all.insert(all.end(), values.begin(), values.end());
  if (all.empty()) return;
  settings_.limits.roughness = std::clamp(kRoughnessFactor * medianInPlace(all), kLeastRoughness,
                                          settings_.limits.roughness);
}

void DeliveryChecker::measureAreas() {
  samples_.assign(areas_.size(), std::vector<std::vector<OffsetSample>>(overlaps_.size()));
  milliseconds_.assign(areas_.size(), std::vector<double>(overlaps_.size(), 0.0));
  counts_.assign(areas_.size(), std::vector<std::size_t>(courses_.size(), 0));
  std::vector<std::vector<double>> repeated(areas_.size());
  forOwn(0, areas_.size(), [&](std::size_t i) {
    AreaOffsets& area = offsets_[i];
    const Clock::time_point start = Clock::now();
    area.build(settings_.limits, survey_.resolution());
    area.choosePlaces();
    const double building = millisecondsSince(start);
    for (std::size_t strip = 0; strip < courses_.size(); ++strip) {
      counts_[i][strip] = area.points(static_cast<int>(strip)).size();
      repeated[i].push_back(area.repeatedShare(static_cast<int>(strip)) *
                            static_cast<double>(counts_[i][strip]));
    }
    for (std::size_t k = 0; k < overlaps_.size(); ++k) {
      const auto& [a, b] = overlaps_[k].strips;
      if (area.points(a).empty() || area.points(b).empty()) continue;
      const Clock::time_point begin = Clock::now();
      samples_[i][k] = area.offsets(a, b);
      const double share = static_cast<double>(area.points(a).size() + area.points(b).size()) /
                           static_cast<double>(area.pointCount());
      milliseconds_[i][k] = millisecondsSince(begin) + building * share;
    }
    area.release();
  });
  shareMeasurements(repeated);
  repeated_.assign(courses_.size(), 0.0);
  for (std::size_t strip = 0; strip < courses_.size(); ++strip) {
    double points = 0.0;
    for (std::size_t i = 0; i < areas_.size(); ++i) {
      repeated_[strip] += repeated[i][strip];
      points += static_cast<double>(counts_[i][strip]);
    }
    repeated_[strip] /= std::max(points, 1.0);
  }
}

void DeliveryChecker::measureControl(CheckedBlock& block) {
  const std::size_t count = settings_.control.size();
  if (count == 0) return;
  std::vector<std::vector<ControlDifference>> found(target_shares_.count());
  forOwn(areas_.size(), count, [&](std::size_t at) {
    const std::size_t i = at - areas_.size();
    AreaOffsets& area = control_offsets_[i];
    area.build(settings_.limits, survey_.resolution());
    found[at] = controlDifferences(area, settings_.control[i], survey_.strips());
    area.release();
  });
  detail::shareDifferences(survey_.processes(), target_shares_, found);
  std::vector<ControlDifference> all;
  for (const auto& of_point : found) all.insert(all.end(), of_point.begin(), of_point.end());
  block.control = assessControl(std::move(all), settings_.control, survey_.strips(),
                                settings_.control_sigma, settings_.limits.maximum_distance);
  for (const Warning& warning : warningsOf(*block.control)) warnings_.push_back(warning);
  if (block.control->unseen.size() == count) warnings_.push_back(placeOfControl());
}

/// Where control lies that no strip covers.
std::string DeliveryChecker::placeOfControl() const {
  Eigen::AlignedBox2d block, box;
  for (std::size_t strip = 0; strip < used_.size(); ++strip)
    if (used_[strip]) block.extend(map_.boxOf(static_cast<int>(strip)));
  for (const ControlPoint& point : settings_.control)
    box.extend(Eigen::Vector2d(point.position.head<2>()));
  const OffsetFromBlock place(box, block);
  return "no strip covers any of " + counted(settings_.control.size(), "control point") +
         (place.distance > 0.0 ? ", which lie " + place.text() : std::string());
}

CheckedBlock DeliveryChecker::assess(const std::function<void(double)>& progress) {
  CheckedBlock block;
  findRoughness();
  block.roughness_limit = settings_.limits.roughness;
  measureAreas();
  measureControl(block);
  std::vector<PairOffset> means;
  std::vector<PairMotion> motions;
  for (std::size_t k = 0; k < overlaps_.size(); ++k) {
    CellMeans cells;
    block.pairs.push_back(assessOverlap(k, cells));
    const CheckedPair& pair = block.pairs.back();
    if (pair.assessment.status == PairAssessment::Status::judged)
      means.push_back({pair.a, pair.b, std::move(cells)});
  }
  registerPairs(block.pairs, progress);
  for (const CheckedPair& pair : block.pairs)
    if (pair.alignment) motions.push_back({pair.a, pair.b, *pair.alignment});
  block.triangles = closeTriangles(means);
  block.motions = closeMotions(motions);
  for (std::size_t strip = 0; strip < courses_.size(); ++strip) {
    const std::string& id = survey_.strips()[strip];
    block.strips.push_back({id, map_.pointCount(static_cast<int>(strip)),
                            courses_[strip].direction(), repeated_[strip]});
    if (repeated_[strip] > kRepeated)
      warnings_.push_back("strip " + id + ": " +
                          std::to_string(std::lround(100.0 * repeated_[strip])) +
                          " % of its points lie on others of its own: is a file given twice?");
  }
  block.warnings = warnings_;
  block.excluded = excluded_;
  return block;
}

}  // namespace pcl_als
