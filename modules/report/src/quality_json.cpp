// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/processing/delivery_requirement.h>
#include <pcl_als/report/quality_report.h>

#include "quality_fields.h"

namespace pcl_als {
namespace {

using namespace field;

FieldNames<FlightRelation> relationNames() {
  using R = FlightRelation;
  return {toString, {R::unknown, R::parallel, R::opposite, R::crossing}};
}

const Fields<Trend>& trendFields() {
  static const Fields<Trend> fields(
      "trend", "Change of the offset, in metres per unit of the name.",
      {{"slope", &Trend::slope, "Change", knownIf(&Trend::determined)},
       {"std", &Trend::std, "Its standard deviation", knownIf(&Trend::determined)}});
  return fields;
}

const Fields<OverlapTrends::Roll>& rollValueFields() {
  using R = OverlapTrends::Roll;
  static const Fields<R> fields("roll_b", "Roll error of the second strip.",
                                {{"arcsec", &R::value, "Roll error", in(kRadiansPerArcsec),
                                  of("arcsec"), knownIf(&R::determined)},
                                 {"std_arcsec", &R::std, "Its standard deviation",
                                  in(kRadiansPerArcsec), knownIf(&R::determined)}});
  return fields;
}

const Fields<OverlapTrends>& rollFields() {
  using T = OverlapTrends;
  const auto strips = [](const T& t) {
    return t.relation == FlightRelation::opposite   ? "both"
           : t.relation == FlightRelation::parallel ? "a - b"
           : t.relation == FlightRelation::crossing ? "a"
                                                    : "unknown";
  };
  static const Fields<T> fields(
      "roll", "Roll error that explains the change across the overlap.",
      {Field<T>::all(&T::roll, rollValueFields()),
       {"of", strips, "Strips that have the error", oneOf({"both", "a - b", "a", "unknown"})}});
  return fields;
}

std::vector<ProfileBin> used(const std::vector<ProfileBin>& bins) {
  std::vector<ProfileBin> some;
  for (const ProfileBin& bin : bins)
    if (bin.count > 0) some.push_back(bin);
  return some;
}

const Fields<ProfileBin>& binFields() {
  using B = ProfileBin;
  const auto any = knownIf([](const B& bin) { return bin.count > 0; });
  static const Fields<B> fields("profile_bin", "Offsets of an interval.",
                                {{"from", &B::from, "Begin of the interval", csv(4)},
                                 {"to", &B::to, "End of the interval", csv(4)},
                                 {"places", &B::count, "Number of places", csv(0)},
                                 {"mean_m", &B::mean, "Mean offset", any, csv(5)},
                                 {"sd_m", &B::std, "Standard deviation", any, csv(5)}});
  return fields;
}

const Fields<OverlapTrends>& profileFields() {
  using T = OverlapTrends;
  const Fields<ProfileBin>& bins = binFields();
  static const Fields<T> fields(
      "profiles", "Offsets by intervals that have places.",
      {{"distance_m", [](const T& t) { return used(t.by_distance); }, bins,
        "Right of the centre line of the overlap, seen along the flight of a"},
       {"time_s", [](const T& t) { return used(t.by_time); }, bins, "Time of a"},
       {"scan_angle_deg", [](const T& t) { return used(t.by_scan_angle); }, bins,
        "Scan angle of a"}});
  return fields;
}

const Fields<OverlapTrends>& trendsFields() {
  using T = OverlapTrends;
  static const Fields<T> fields(
      "trends", "How offsets change over the overlap.",
      {{"flown", &T::relation, relationNames(), "Directions of the flights"},
       {"course_a", &T::course, "Plan unit vector of the flight of a: east, north"},
       {"centre_m", &T::centre, "A point of the centre line of the overlap: east, north"},
       {"across_m_per_m", &T::across, trendFields(), "To the right of the flight of a"},
       {"along_m_per_m", &T::along, trendFields(), "Along it"},
       {"time_m_per_s", &T::time, trendFields(), "With the time of a"},
       {"scan_angle_m_per_deg", &T::scan_angle, trendFields(), "With the scan angle of a"},
       {"roll", kSameObject, rollFields(), "As roll error"},
       {"roll_b", &T::roll_b, rollValueFields(), "Roll error of b, if the flights cross",
        onlyIf([](const T& t) { return t.relation == FlightRelation::crossing; })},
       {"profiles", kSameObject, profileFields(), "Offsets by intervals"}});
  return fields;
}

std::vector<SlopeAspectClass> usedClasses(const PairAssessment& p) {
  std::vector<SlopeAspectClass> some;
  for (const SlopeAspectClass& c : p.classes)
    if (c.count > 0) some.push_back(c);
  return some;
}

std::vector<Field<CheckedPair>> assessmentRows() {
  using F = Field<CheckedPair>;
  using P = PairAssessment;
  static const Fields<P> fields(
      "assessment", "Offsets of a pair.",
      {{"vertical", &P::vertical, summaryFields(), "Smooth ground of single returns below 10°"},
       {"vertical_cells", &P::vertical_cells, summaryFields(), "Means of cells of 25 m"},
       {"quality_level", [](const P& p) { return nameOfLevel(p.quality_level); },
        "Best level whose limit between swaths is kept"},
       {"normal", &P::normal, summaryFields(), "All smooth surfaces, along the normal"},
       {"horizontal", &P::horizontal, horizontalFields(), "Movement that slopes show"},
       {"slope_aspect", usedClasses, classFields(), "Distances by slope and aspect"},
       {"trends", &P::trends, trendsFields(), "How offsets change over the overlap"}});
  static const Fields<CheckedPair> work(
      "work", "What the comparison took.",
      {{"areas", &CheckedPair::areas, "Areas of comparison"},
       {"points_a", &CheckedPair::points_a, "Points of a in them"},
       {"points_b", &CheckedPair::points_b, "Points of b in them"},
       {"memory_mb", &CheckedPair::memory_mb, "Memory of points and surfaces"}});
  return {F::all(&CheckedPair::assessment, fields),
          {"work", kSameObject, work, "What the comparison took"}};
}

const Fields<CheckedPair>& pairFields() {
  using P = CheckedPair;
  using Status = PairAssessment::Status;
  static const Fields<P> fields("pair", "Two overlapping strips. Offsets are a - b.", [] {
    std::vector<Field<P>> rows = {
        {"a", &P::a, "First strip"},
        {"b", &P::b, "Second strip"},
        {"status", [](const P& p) { return p.assessment.status; },
         FieldNames<Status>(toString,
                            {Status::judged, Status::too_little, Status::copy, Status::too_far}),
         "Whether the pair was measured"},
        {"reason", [](const P& p) { return p.assessment.reason; }, "Why it is not measured",
         unlessEmpty},
        {"apart_m", [](const P& p) { return p.assessment.apart; }, "Height of a above b",
         onlyIf([](const P& p) { return p.assessment.status == Status::too_far; })},
        {"overlap_m2", &P::overlap_area, "Area of the overlap"},
        {"icpatch", &P::alignment, alignmentFields(), "Rigid movement of a onto b (ICPatch)",
         unlessEmpty}};
    for (auto& row : assessmentRows()) rows.push_back(std::move(row));
    return rows;
  }());
  return fields;
}

const Fields<CheckedStrip>& stripFields() {
  using S = CheckedStrip;
  static const Fields<S> fields(
      "strip", "A strip.",
      {{"id", &S::id, "Name of the strip"},
       {"points", &S::points, "Number of points"},
       {"repeated_share", &S::repeated, "Share of points with the coordinates of another point"},
       {"course", &S::course, "Plan unit vector of the flight: east, north"}});
  return fields;
}

const Fields<PairCounts>& countFields() {
  using C = PairCounts;
  static const Fields<C> fields(
      "pair_counts", "How many overlapping pairs were measured, and why the others were not.",
      {{"measured", &C::measured, "Of two passes"},
       {"of_one_pass", &C::of_one_pass, "Measured, but of one pass"},
       {"too_far", &C::too_far, "Further apart than surfaces are compared"},
       {"unmeasurable", &C::unmeasurable, "Too little in common, or the same points twice"},
       {"too_small", &C::too_small, "Too small overlap, not measured"}});
  return fields;
}

template <typename T>
std::vector<std::string> threeOf(const T& triangle) {
  return {triangle.a, triangle.b, triangle.c};
}

const Fields<TriangleClosure>& triangleFields() {
  using T = TriangleClosure;
  static const Fields<T> fields(
      "triangle", "Closure of height differences around three strips, a-b + b-c - (a-c).",
      {{"strips", threeOf<T>, "The strips a, b and c"},
       {"cells", &T::cells, "Cells that all three pairs have"},
       {"closure_m", &T::closure, "Mean closure"},
       {"std_m", &T::std, "Standard deviation of the mean"}});
  return fields;
}

const Fields<MotionClosure>& motionFields() {
  using M = MotionClosure;
  static const Fields<M> fields(
      "icpatch_triangle", "Difference of the movements a to b to c and a to c.",
      {{"strips", threeOf<M>, "The strips a, b and c"},
       {"closure_m", &M::closure, "Difference: east, north, up"},
       {"std_m", &M::std, "Standard deviations, of independent alignments"}});
  return fields;
}

const Fields<SeparationSummary>& separationFields() {
  using S = SeparationSummary;
  static const Fields<S> fields(
      "swath_separation", "Swath separation images.",
      {{"cell_m", &S::cell, "Size of a cell"},
       {"green_up_to_m", &S::limit, "Largest separation of green cells"},
       {"yellow_up_to_m", [](const S& s) { return 2.0 * s.limit; }, "And of yellow cells"},
       {"green_cells", &S::green, "Number of green cells"},
       {"yellow_cells", &S::yellow, "Number of yellow cells"},
       {"red_cells", &S::red, "Number of red cells"},
       {"files", &S::files, "Files of the images"}});
  return fields;
}

const Fields<CheckedBlock>& blockFields() {
  using B = CheckedBlock;
  static const Fields<B> fields(
      "block", "One set of strips.",
      {{"inputs", &B::files, "Files of the points"},
       {"strips", &B::strips, stripFields(), "Strips"},
       {"pairs", &B::pairs, pairFields(), "Overlapping pairs"},
       {"pair_counts", [](const B& b) { return countPairs(b.pairs); }, countFields(),
        "Numbers of pairs"},
       {"triangles", &B::triangles, triangleFields(), "Closures of height differences"},
       {"icpatch_triangles", &B::motions, motionFields(), "Closures of movements"},
       {"control", &B::control, controlFields(), "Strips against control", unlessEmpty},
       {"swath_separation", &B::separation, separationFields(), "Images", unlessEmpty},
       {"smooth_roughness_m", &B::roughness_limit, "Largest roughness of smooth surfaces"},
       {"warnings", [](const B& b) { return textsOf(b.warnings); }, "What a user should know"},
       {"left_out", &B::excluded, excludedFields(), "Points that took no part"}});
  return fields;
}

const Fields<DeliveryRequirement>& requirementFields() {
  using R = DeliveryRequirement;
  static const Fields<R> fields(
      "requirement", "Whether the delivery keeps the required level.",
      {{"required_level", [](const R& r) { return levelName(r.level); }, "Required level"},
       {"kept", &R::kept, "Whether it is kept"},
       {"pairs_measured", &R::pairs, "Pairs that were measured"},
       {"control_points", &R::control_points, "Control points that were used"},
       {"reasons", &R::reasons, "Why it is not kept"}});
  return fields;
}

const Fields<QualityReport>& limitFields() {
  using L = QualityLevelLimits;
  using R = QualityReport;
  using F = Field<R>;
  static const Fields<L> level("level", "Limits of a quality level.",
                               {{"level", [](const L& l) { return levelName(l.level); }, "Level"},
                                {"rmsdz_m", &L::swath_overlap_rmsdz, "Limit between swaths"},
                                {"absolute_rmsez_m", &L::absolute_rmsez, "Limit at control"}});
  const auto all = [](const R&) {
    return std::vector<L>(qualityLevels().begin(), qualityLevels().end());
  };
  static const Fields<R> fields(
      "limits", "The limits that apply.",
      {{"required", [](const R& r) { return levelName(r.quality_level); }, "Required level"},
       F::constant("relative", kSwathSpecification, "Source of the limits between swaths"),
       F::constant("absolute", kAbsoluteSpecification, "Source of the limits at control"),
       F::constant("horizontal", kSwathGuidelines, "Source of the movements on slopes"),
       {"levels", all, level, "Limits of all levels"}});
  return fields;
}

}  // namespace

std::optional<std::string> nameOfLevel(const std::optional<int>& level) {
  return level ? std::optional(levelName(level)) : std::nullopt;
}

const Fields<NamedBin>& namedBinFields() {
  static const Fields<NamedBin> fields(
      "profiles.csv", "Offsets by pair and interval.",
      {{"over", &NamedBin::over, "Quantity of the intervals, with its unit", csv(0)},
       Field<NamedBin>("", &NamedBin::bin, binFields(), "", csv(""))});
  return fields;
}

const Fields<SlopeAspectClass>& classFields() {
  using C = SlopeAspectClass;
  const auto any = knownIf([](const C& c) { return c.count > 0; });
  static const Fields<C> fields(
      "slope_aspect", "Distances on slopes of one class of slope and aspect.",
      {{"slope_from_deg", &C::slope_from, "Least slope", csv(0)},
       {"slope_to_deg", &C::slope_to, "Largest slope", csv(0)},
       {"aspect", [](const C& c) { return aspectName(c.aspect); }, "Downhill direction, or all",
        csv(0)},
       {"places", &C::count, "Number of places", csv(0)},
       {"mean_m", &C::mean, "Mean distance a - b along the normal", any, csv(5)},
       {"rms_m", &C::rms, "RMS distance", any, csv(5)}});
  return fields;
}

const Fields<OffsetSummary>& summaryFields() {
  using S = OffsetSummary;
  const auto any = knownIf([](const S& s) { return s.count > 0; });
  static const Fields<S> fields(
      "offset_summary", "Statistics of signed offsets; null without a place.",
      {{"places", &S::count, "Number of places", csv(0)},
       {"mean_m", &S::mean, "Mean", any, csv(5)},
       {"mean_std_m", &S::std_of_mean, "Standard deviation of the mean, places correlated", csv(5)},
       {"mean_std_formal_m", &S::std_of_mean_formal, "The same with cells of 25 m independent"},
       {"median_m", &S::median, "Median", any, csv(5)},
       {"sd_m", &S::std, "Standard deviation", any, csv(5)},
       {"nmad_m", &S::nmad, "1.4826 times the median absolute deviation", any},
       {"rms_m", &S::rms, "Root mean square", any, csv(5)},
       {"percentile_95_m", &S::percentile_95, "95th percentile of the absolute values", any,
        csv("p95_m", 5)},
       {"largest_m", &S::largest, "Largest absolute value", any, csv(5)}});
  return fields;
}

const FieldTable& qualityFields() {
  using R = QualityReport;
  using F = Field<R>;
  static const Fields<R> fields(
      "quality", "Result of `pcl_als_check`. Unknown values are null.",
      {F::constant("format", "pcl_als quality", ""),
       F::constant("version", 1, ""),
       toolVersionField<R>(),
       F::constant("signs", "offsets are a - b, shifts move a onto b, control is strip - control",
                   "Signs of all values"),
       {"limits", kSameObject, limitFields(), "The limits that apply"},
       {"requirement", [](const R& r) { return requireLevel(r.block, r.quality_level); },
        requirementFields(), "Whether the delivery keeps the required level"},
       F::all(&R::block, blockFields()),
       {"before", &R::before, blockFields(), "The same of the other set", unlessEmpty}});
  return fields;
}

std::string qualityJson(const QualityReport& report) {
  return jsonText(qualityFields().write(&report));
}

}  // namespace pcl_als
