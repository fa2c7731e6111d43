// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/report/quality_report.h>

#include "excluded_json.h"
#include "json_number.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

Json summaryJson(const OffsetSummary& s) {
  const bool any = s.count > 0;
  return {{"places", s.count},
          {"mean_m", number(s.mean, any)},
          {"mean_std_m", number(s.std_of_mean)},
          {"mean_std_formal_m", number(s.std_of_mean_formal)},
          {"median_m", number(s.median, any)},
          {"sd_m", number(s.std, any)},
          {"nmad_m", number(s.nmad, any)},
          {"rms_m", number(s.rms, any)},
          {"percentile_95_m", number(s.percentile_95, any)},
          {"largest_m", number(s.largest, any)}};
}

Json levelJson(const std::optional<int>& level) {
  return level ? Json("QL" + std::to_string(*level)) : Json(nullptr);
}

Json trendJson(const Trend& trend) {
  return {{"slope", number(trend.slope, trend.determined)},
          {"std", number(trend.std, trend.determined)}};
}

Json rollJson(const OverlapTrends::Roll& roll) {
  return {{"arcsec", number(roll.value / kRadiansPerArcsec, roll.determined)},
          {"std_arcsec", number(roll.std / kRadiansPerArcsec, roll.determined)}};
}

Json binsJson(const std::vector<ProfileBin>& bins) {
  Json list = Json::array();
  for (const ProfileBin& bin : bins) {
    if (bin.count == 0) continue;
    list.push_back({{"from", bin.from},
                    {"to", bin.to},
                    {"places", bin.count},
                    {"mean_m", bin.mean},
                    {"sd_m", bin.std}});
  }
  return list;
}

Json trendsJson(const OverlapTrends& t) {
  Json json = {{"flown", toString(t.relation)},
               {"course_a", {t.course.x(), t.course.y()}},
               {"centre_m", {t.centre.x(), t.centre.y()}},
               {"across_m_per_m", trendJson(t.across)},
               {"along_m_per_m", trendJson(t.along)},
               {"time_m_per_s", trendJson(t.time)},
               {"scan_angle_m_per_deg", trendJson(t.scan_angle)},
               {"roll", rollJson(t.roll)}};
  json["roll"]["of"] = t.relation == FlightRelation::opposite   ? "both"
                       : t.relation == FlightRelation::parallel ? "a - b"
                       : t.relation == FlightRelation::crossing ? "a"
                                                                : "unknown";
  if (t.relation == FlightRelation::crossing) json["roll_b"] = rollJson(t.roll_b);
  json["profiles"] = {{"distance_m", binsJson(t.by_distance)},
                      {"time_s", binsJson(t.by_time)},
                      {"scan_angle_deg", binsJson(t.by_scan_angle)}};
  return json;
}

Json horizontalJson(const HorizontalShift& h) {
  Json shift = Json::object(), std = Json::object(), formal = Json::object();
  const char* const names[] = {"east_m", "north_m", "up_m"};
  for (int i = 0; i < 3; ++i) {
    shift[names[i]] = number(h.shift[i], h.determined);
    std[names[i]] = number(h.std[i], h.determined);
    formal[names[i]] = number(h.std_formal[i], h.determined);
  }
  Json json = {{"determined", h.determined},
               {"places", h.count},
               {"shift", shift},
               {"std", std},
               {"std_formal", formal}};
  if (!h.determined) json["reason"] = h.reason;
  return json;
}

Json classesJson(const std::vector<SlopeAspectClass>& classes) {
  Json list = Json::array();
  for (const SlopeAspectClass& c : classes) {
    if (c.count == 0) continue;
    list.push_back({{"slope_from_deg", c.slope_from},
                    {"slope_to_deg", c.slope_to},
                    {"aspect", aspectName(c.aspect)},
                    {"places", c.count},
                    {"mean_m", c.mean},
                    {"rms_m", c.rms}});
  }
  return list;
}

Json alignmentJson(const PatchAlignmentResult& r) {
  Json json = {{"status", toString(r.status)}};
  if (!r.message.empty()) json["message"] = r.message;
  if (!r.hasConverged()) return json;
  for (int i = 0; i < PatchAlignmentResult::kParameters; ++i) {
    const bool angle = i >= 3;
    const double unit = angle ? kRadiansPerDegree : 1.0;
    const double value = angle ? r.motion.rotation[i - 3] : r.motion.shift[i];
    const auto& parameter = r.parameters[static_cast<std::size_t>(i)];
    Json entry = {{"value", number(value / unit, parameter.determined)},
                  {"std", number(r.standardDeviation(i) / unit, parameter.determined)},
                  {"unit", angle ? "deg" : "m"}};
    if (!parameter.determined) entry["reason"] = parameter.reason;
    json[PatchAlignmentResult::name(i)] = entry;
  }
  const Eigen::Vector3d& c = r.motion.centroid;
  json["centroid_m"] = {c.x(), c.y(), c.z()};
  json["sigma0_m"] = r.sigma0;
  json["pairs"] = r.pairs;
  json["redundancy"] = r.redundancy;
  json["iterations"] = r.coarse_iterations + r.iterations;
  json["normal_before_m"] = {{"mean", r.normal_before.mean}, {"rms", r.normal_before.rms}};
  json["normal_after_m"] = {{"mean", r.normal_after.mean}, {"rms", r.normal_after.rms}};
  return json;
}

Json pairJson(const CheckedPair& pair) {
  const PairAssessment& p = pair.assessment;
  Json json = {{"a", pair.a}, {"b", pair.b}, {"status", toString(p.status)}};
  if (!p.reason.empty()) json["reason"] = p.reason;
  if (p.status == PairAssessment::Status::too_far) json["apart_m"] = p.apart;
  json["overlap_m2"] = pair.overlap_area;
  if (pair.alignment) json["icpatch"] = alignmentJson(*pair.alignment);
  json["vertical"] = summaryJson(p.vertical);
  json["vertical_cells"] = summaryJson(p.vertical_cells);
  json["quality_level"] = levelJson(p.quality_level);
  json["normal"] = summaryJson(p.normal);
  json["horizontal"] = horizontalJson(p.horizontal);
  json["slope_aspect"] = classesJson(p.classes);
  json["trends"] = trendsJson(p.trends);
  json["work"] = {{"areas", pair.areas},
                  {"points_a", pair.points_a},
                  {"points_b", pair.points_b},
                  {"memory_mb", pair.memory_mb}};
  return json;
}

/// The ASPRS figures of control; none without a point.
void addAccuracy(const ControlAssessment& control, Json& json) {
  if (!control.accuracy) return;
  const VerticalAccuracy& v = *control.accuracy;
  const bool classed = control.no_class.empty();
  json["asprs"] = {{"standard", kPositionalStandard},
                   {"rmse_v_m", v.rmse_v},
                   {"fit_m", v.fit},
                   {"survey_m", v.survey},
                   {"survey_known", control.survey_known},
                   {"class_cm", number(v.class_cm, classed)},
                   {"enough_points", v.enough_points}};
  if (!classed) json["asprs"]["no_class_because"] = control.no_class;
  json["asprs_older"] = {{"standard", kOlderPositionalStandard}, {"nva_95_m", v.nva_95}};
  json["quality_level"] = levelJson(control.quality_level);
}

Json controlJson(const ControlAssessment& control) {
  Json json = {{"points", control.points},
               {"unseen", control.unseen},
               {"far", control.far},
               {"offsets", Json::array()},
               {"shift_onto_control", horizontalJson(control.shift)},
               {"all", summaryJson(control.all)},
               {"strips", Json::array()},
               {"differences", Json::array()}};
  json["shift_onto_control"]["significant"] = isSignificantInPlan(control.shift);
  for (const CommonOffset& common : control.offsets)
    json["offsets"].push_back({{"strip", common.strip.empty() ? Json(nullptr) : Json(common.strip)},
                               {"offset_m", common.offset},
                               {"std_m", common.std},
                               {"points", common.points},
                               {"covered", common.covered}});
  for (const auto& strip : control.strips) {
    Json entry = summaryJson(strip.offsets);
    entry["strip"] = strip.strip;
    json["strips"].push_back(entry);
  }
  for (const ControlDifference& d : control.differences) {
    Json entry = {{"point", d.point},
                  {"strip", d.strip},
                  {"above_m", d.above},
                  {"slope_deg", d.slope / kRadiansPerDegree},
                  {"roughness_m", d.roughness}};
    if (!d.unfit.empty()) entry["left_out_because"] = d.unfit;
    json["differences"].push_back(entry);
  }
  addAccuracy(control, json);
  return json;
}

Json blockJson(const CheckedBlock& block) {
  Json json = {{"inputs", block.files}, {"strips", Json::array()}, {"pairs", Json::array()}};
  for (const CheckedStrip& strip : block.strips) {
    Json entry = {{"id", strip.id}, {"points", strip.points}, {"repeated_share", strip.repeated}};
    entry["course"] = strip.course ? Json({strip.course->x(), strip.course->y()}) : Json(nullptr);
    json["strips"].push_back(entry);
  }
  for (const CheckedPair& pair : block.pairs) json["pairs"].push_back(pairJson(pair));
  const PairCounts counts = countPairs(block.pairs);
  json["pair_counts"] = {{"measured", counts.measured},
                         {"of_one_pass", counts.of_one_pass},
                         {"too_far", counts.too_far},
                         {"unmeasurable", counts.unmeasurable},
                         {"too_small", counts.too_small}};
  json["triangles"] = Json::array();
  for (const TriangleClosure& t : block.triangles)
    json["triangles"].push_back({{"strips", {t.a, t.b, t.c}},
                                 {"cells", t.cells},
                                 {"closure_m", t.closure},
                                 {"std_m", t.std}});
  json["icpatch_triangles"] = Json::array();
  for (const MotionClosure& m : block.motions)
    json["icpatch_triangles"].push_back(
        {{"strips", {m.a, m.b, m.c}},
         {"closure_m", {m.closure.x(), m.closure.y(), m.closure.z()}},
         {"std_m", {m.std.x(), m.std.y(), m.std.z()}}});
  if (block.control) json["control"] = controlJson(*block.control);
  if (block.separation) {
    const SeparationSummary& s = *block.separation;
    json["swath_separation"] = {
        {"cell_m", s.cell},       {"green_up_to_m", s.limit}, {"yellow_up_to_m", 2.0 * s.limit},
        {"green_cells", s.green}, {"yellow_cells", s.yellow}, {"red_cells", s.red},
        {"files", s.files}};
  }
  json["smooth_roughness_m"] = block.roughness_limit;
  json["warnings"] = textsOf(block.warnings);
  json["left_out"] = excludedJson(block.excluded);
  return json;
}

Json requirementJson(const DeliveryRequirement& requirement) {
  return {{"required_level", "QL" + std::to_string(requirement.level)},
          {"kept", requirement.kept},
          {"pairs_measured", requirement.pairs},
          {"control_points", requirement.control_points},
          {"reasons", requirement.reasons}};
}

Json limitsJson(int required) {
  Json list = Json::array();
  for (const QualityLevelLimits& level : qualityLevels()) {
    list.push_back({{"level", "QL" + std::to_string(level.level)},
                    {"rmsdz_m", level.swath_overlap_rmsdz},
                    {"absolute_rmsez_m", level.absolute_rmsez}});
  }
  return {{"required", "QL" + std::to_string(required)},
          {"relative", kSwathSpecification},
          {"absolute", kAbsoluteSpecification},
          {"horizontal", kSwathGuidelines},
          {"levels", list}};
}

}  // namespace

std::string qualityJson(const QualityReport& report) {
  Json json = {{"format", "pcl_als quality"},
               {"version", 1},
               {"tool_version", PCL_ALS_VERSION},
               {"signs", "offsets are a - b, shifts move a onto b, control is strip - control"},
               {"limits", limitsJson(report.quality_level)},
               {"requirement", requirementJson(requireLevel(report.block, report.quality_level))}};
  json.update(blockJson(report.block));
  if (report.before) json["before"] = blockJson(*report.before);
  return json.dump(1) + '\n';
}

}  // namespace pcl_als
