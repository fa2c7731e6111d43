// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/quality/strip_alignment.h>

#include "quality_fields.h"

namespace pcl_als {
namespace {

using namespace field;

/// One of the six parameters of a movement.
Field<PatchAlignmentResult> parameterField(int i) {
  using R = PatchAlignmentResult;
  const bool angle = i >= 3;
  const char* const unit = angle ? "deg" : "m";
  const double factor = angle ? kRadiansPerDegree : 1.0;
  const auto determined = [i](const R& r) {
    return r.parameters[static_cast<std::size_t>(i)].determined;
  };
  const auto value = [=](const R& r) {
    return angle ? r.motion.rotation[i - 3] : r.motion.shift[i];
  };
  const Fields<R> fields(
      std::string("icpatch_") + unit, "A parameter of a rigid movement.",
      {{"value", value, "Value", in(factor), of(unit), knownIf(determined)},
       {"std", [i](const R& r) { return r.standardDeviation(i); }, "Its standard deviation",
        in(factor), of(unit), knownIf(determined)},
       {"unit", [unit](const R&) { return unit; }, "Unit of both", oneOf({unit})},
       {"reason", [i](const R& r) { return r.parameters[static_cast<std::size_t>(i)].reason; },
        "Why it is not determined", onlyIf([=](const R& r) { return !determined(r); })}});
  return {R::name(i), kSameObject, fields, ""};
}

const Fields<ControlDifference>& differenceFields() {
  using D = ControlDifference;
  static const Fields<D> fields(
      "difference", "One strip at one control point.",
      {{"point", &D::point, "Control point"},
       {"strip", &D::strip, "Strip"},
       {"place_m", &D::position, "Place of the point: easting, northing, height"},
       {"above_m", &D::above, "Height of the strip above control"},
       {"slope_deg", &D::slope, "Slope of the surface", in(kRadiansPerDegree)},
       {"roughness_m", &D::roughness, "Roughness of the surface"},
       {"left_out_because", &D::unfit, "Why it is excluded from the statistics", unlessEmpty}});
  return fields;
}

const Fields<CommonOffset>& offsetFields() {
  using O = CommonOffset;
  static const Fields<O> fields(
      "common_offset", "A height offset that most control points have in common.",
      {{"strip", [](const O& o) { return std::optional(o.strip); }, "The strip; null: all strips",
        knownIf([](const O& o) { return !o.strip.empty(); })},
       {"offset_m", &O::offset, "Height of the strips above control"},
       {"std_m", &O::std, "Standard deviation of the offset"},
       {"points", &O::points, "Points that agree on it"},
       {"covered", &O::covered, "Points at which a surface was measured"}});
  return fields;
}

const Fields<ContradictingControl>& contradictionFields() {
  using C = ContradictingControl;
  static const Fields<C> fields(
      "contradicting_control", "Two groups of control points that contradict each other.",
      {{"strip", &C::strip, "The strip that lies at different heights above the groups"},
       {"separation_m", &C::separation, "Height above the one group less that above the other"},
       {"higher", &C::higher, "Points that the strip lies higher above"},
       {"lower", &C::lower, "Points that the strip lies lower above"}});
  return fields;
}

bool isClassed(const ControlAssessment& control) {
  return control.no_class.empty();
}

/// The ASPRS figures of control.
const Fields<ControlAssessment>& standardFields() {
  using C = ControlAssessment;
  using F = Field<C>;
  const auto of_accuracy = [](double VerticalAccuracy::*member) {
    return [member](const C& c) { return *c.accuracy.*member; };
  };
  using V = VerticalAccuracy;
  static const Fields<C> edition_2(
      "asprs", "Figures of the standard.",
      {F::constant("standard", kPositionalStandard, "The standard"),
       {"rmse_v_m", of_accuracy(&V::rmse_v), "Vertical accuracy: fit and survey together"},
       {"fit_m", of_accuracy(&V::fit), "RMSE of the strips at the points"},
       {"survey_m", of_accuracy(&V::survey), "RMSE of the heights of the points"},
       {"survey_known", &C::survey_known, "Whether the file of control states it"},
       {"class_cm", of_accuracy(&V::class_cm), "Accuracy class", knownIf(isClassed)},
       {"enough_points", [](const C& c) { return c.accuracy->enough_points; },
        "Whether there are the 30 points that the standard asks for"},
       {"no_class_because", &C::no_class, "Why there is no class", unlessEmpty}});
  static const Fields<C> edition_1(
      "asprs_older", "Figures of the edition before.",
      {F::constant("standard", kOlderPositionalStandard, "The standard"),
       {"nva_95_m", of_accuracy(&V::nva_95), "Non-vegetated vertical accuracy at 95 %"}});
  static const Fields<C> fields(
      "standards", "Figures of the standards.",
      {{"asprs", kSameObject, edition_2, "Figures of the ASPRS"},
       {"asprs_older", kSameObject, edition_1, "Figures of the edition before"},
       {"quality_level", [](const C& c) { return nameOfLevel(c.quality_level); },
        "Best level whose limit at control is kept"}});
  return fields;
}

}  // namespace

const Fields<HorizontalShift>& horizontalFields() {
  using H = HorizontalShift;
  using Vector = Eigen::Vector3d;
  const auto component = [](const char* name, int i) -> Field<Vector> {
    return {name, [i](const Vector& v) { return v[i]; }, ""};
  };
  static const Fields<Vector> vector(
      "vector", "East, north, up.",
      {component("east_m", 0), component("north_m", 1), component("up_m", 2)});
  // Of what is not determined, all components are null.
  const auto known = [](Vector H::*member) {
    return [member](const H& h) -> Vector {
      return h.determined ? h.*member : Vector::Constant(std::nan(""));
    };
  };
  static const Fields<H> fields(
      "movement", "Movement of a onto b that offsets on slopes show.",
      {{"determined", &H::determined, "Whether the slopes determine it"},
       {"places", &H::count, "Number of places on slopes"},
       {"shift", known(&H::shift), vector, "Movement"},
       {"std", known(&H::std), vector, "Standard deviations"},
       {"std_formal", known(&H::std_formal), vector, "The same with cells as independent"},
       {"reason", &H::reason, "Why it is not determined",
        onlyIf([](const H& h) { return !h.determined; })}});
  return fields;
}

const Fields<PatchAlignmentResult>& alignmentFields() {
  using R = PatchAlignmentResult;
  using Status = R::Status;
  static const Fields<DistanceSummary> distances(
      "distances", "Distances along the normals of all pairs of patches.",
      {{"mean", &DistanceSummary::mean, "Mean", of("m")},
       {"rms", &DistanceSummary::rms, "Root mean square", of("m")}});
  static const Fields<R> found("icpatch_result", "The movement that was found.", [] {
    std::vector<Field<R>> rows;
    for (int i = 0; i < R::kParameters; ++i) rows.push_back(parameterField(i));
    const std::vector<Field<R>> more = {
        {"centroid_m", [](const R& r) { return r.motion.centroid; },
         "Point that the movement is about: east, north, up"},
        {"sigma0_m", &R::sigma0, "Standard deviation of a coordinate along a normal"},
        {"pairs", &R::pairs, "Pairs of a point and a patch"},
        {"redundancy", &R::redundancy, "Redundancy"},
        {"iterations", [](const R& r) { return r.coarse_iterations + r.iterations; },
         "Number of iterations"},
        {"normal_before_m", &R::normal_before, distances, "Distances before the movement"},
        {"normal_after_m", &R::normal_after, distances, "Distances after"}};
    rows.insert(rows.end(), more.begin(), more.end());
    return rows;
  }());
  static const Fields<R> fields(
      "icpatch", "Rigid movement of a onto b about the centroid of their overlap.",
      {{"status", &R::status,
        FieldNames<Status>(toString, {Status::converged, Status::not_converged,
                                      Status::too_few_pairs, Status::no_overlap}),
        "Whether it was found"},
       {"message", &R::message, "Why it was not found", unlessEmpty},
       Field<R>::all(kSameObject, found, onlyIf(&R::hasConverged))});
  return fields;
}

const Fields<ControlAssessment>& controlFields() {
  using C = ControlAssessment;
  using F = Field<C>;
  using OfStrip = C::OfStrip;
  static const Fields<HorizontalShift> shift(
      "movement_onto_control", "Movement of the strips onto control.",
      {Field<HorizontalShift>::all(kSameObject, horizontalFields()),
       {"significant", isSignificantInPlan, "Whether it is significant in plan"}});
  static const Fields<OfStrip> strip("strip_control", "One strip above control.",
                                     {Field<OfStrip>::all(&OfStrip::offsets, summaryFields()),
                                      {"strip", &OfStrip::strip, "Strip"}});
  static const Fields<C> fields(
      "control", "Strips against control; heights are strip - control.",
      {{"points", &C::points, "Points that are used"},
       {"unseen", &C::unseen, "Points that no strip covers"},
       {"far", &C::far, "Points that are far above or below the strips"},
       {"offsets", &C::offsets, offsetFields(), "Offsets that points have in common"},
       {"contradiction", [](const C& c) { return *c.contradiction; }, contradictionFields(),
        "Points that contradict each other",
        onlyIf([](const C& c) { return c.contradiction.has_value(); })},
       {"shift_onto_control", &C::shift, shift, "Movement of the strips onto control"},
       {"all", &C::all, summaryFields(), "All strips at all points"},
       {"strips", &C::strips, strip, "Strips that have a point"},
       {"differences", &C::differences, differenceFields(), "Strips at points"},
       F::all(kSameObject, standardFields(),
              onlyIf([](const C& c) { return c.accuracy.has_value(); }))});
  return fields;
}

}  // namespace pcl_als
