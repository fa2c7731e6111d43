// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/common/error_source.h>
#include <pcl_als/io/result_json.h>

#include "calibration_json.h"

namespace pcl_als::detail {
namespace {

using namespace field;
using Result = CalibrationResult;

const Fields<CalibrationIteration>& iterationFields() {
  using I = CalibrationIteration;
  static const Fields<I> fields(
      "iteration", "One iteration of the adjustment.",
      {Field<I>("correspondences", &I::correspondences, "Number of correspondences"),
       Field<I>("sigma0", &I::sigma0, "A posteriori standard deviation of unit weight"),
       Field<I>("largest_update", &I::largest_update, "Largest effect of the update on the ground",
                of("m"))});
  return fields;
}

const Fields<PairFit>& pairFields() {
  using P = PairFit;
  using F = Field<P>;
  static const Fields<P> fields(
      "pair", "Normal distances of one overlapping pair of strips.",
      {F("a", &P::a, "First strip"),
       F("b", &P::b,
         "Second strip; the first: its points ahead of the sensor above those behind it"),
       F("correspondences", &P::correspondences, "Number of correspondences"),
       F("rms_before_m", &P::rms_before, "RMS distance before the calibration"),
       F("rms_after_m", &P::rms_after, "RMS distance after"),
       F("mean_before_m", &P::mean_before, "Mean distance before"),
       F("mean_after_m", &P::mean_after, "Mean distance after"),
       F("rms_strip_corrections_m", &P::rms_strips, "RMS distance with the strip corrections",
         mayBeMissing),
       F("mean_strip_corrections_m", &P::mean_strips, "Mean distance with the strip corrections",
         mayBeMissing)});
  return fields;
}

const Fields<MisfitChange>& misfitFields() {
  using M = MisfitChange;
  using F = Field<M>;
  static const Fields<M> fields(
      "misfit", "Misfit of all pairs, at the same points before and after the calibration.",
      {F("points", &M::points, "Number of points"), F("areas", &M::areas, "Number of areas"),
       F("rms_before_m", &M::rms_before, "RMS distance before"),
       F("rms_after_m", &M::rms_after, "RMS distance after"),
       F("limit_m", &M::limit, "Larger distances count as this"),
       F("change_std_m", &M::change_std, "Standard deviation of the change")});
  return fields;
}

void checkResiduals(const ResidualHistogram& histogram, const FieldNode& node) {
  if (histogram.before.size() + 1 != histogram.edges.size() ||
      histogram.after.size() != histogram.before.size())
    node.refuse("must have one count before and after for each bin between 'edges_m'");
}

const Fields<ResidualHistogram>& residualFields() {
  using H = ResidualHistogram;
  using F = Field<H>;
  static const Fields<H> fields =
      Fields<H>("residuals", "Normal distances of all pairs in bins.",
                {F("edges_m", &H::edges, "Edges of the bins", alwaysKnown),
                 F("before", &H::before, "Counts before the calibration"),
                 F("after", &H::after, "Counts after")})
          .checked(checkResiduals);
  return fields;
}

const Fields<ControlFit>& controlFields() {
  using C = ControlFit;
  using F = Field<C>;
  static const Fields<C> fields(
      "control", "Heights of one strip above control.",
      {F("strip", &C::strip, "Strip"), F("points", &C::points, "Number of control points"),
       F("mean_before_m", &C::mean_before, "Mean before the calibration"),
       F("rms_before_m", &C::rms_before, "RMS before"),
       F("mean_after_m", &C::mean_after, "Mean after"),
       F("rms_after_m", &C::rms_after, "RMS after")});
  return fields;
}

const Fields<ControlPointFit>& controlPointFields() {
  using C = ControlPointFit;
  using F = Field<C>;
  static const Fields<C> fields(
      "control_point", "Mean distance of the strips from one control point.",
      {F("id", &C::id, "Control point"),
       F("component", &C::component, "Direction: height, normal (of a patch), east or north",
         mayBeMissing),
       F("strips", &C::strips, "Number of strips that see it"),
       F("sigma_m", &C::sigma, "Its stated standard deviation"),
       F("before_m", &C::before, "Distance before the calibration"),
       F("after_m", &C::after, "Distance after"),
       F("expected_std_m", &C::expected_std, "Expected standard deviation of the distance after"),
       F("used", &C::used, "false: rejected as an outlier")});
  return fields;
}

const Fields<StripOffset>& offsetFields() {
  using O = StripOffset;
  static const Fields<O> fields(
      "strip_offset", "Height of one strip above all others after the calibration.",
      {Field<O>("strip", &O::strip, "Strip"), Field<O>("offset_m", &O::offset, "Height"),
       Field<O>("expected_std_m", &O::expected_std,
                "Standard deviation that the trajectory allows"),
       Field<O>("consistent", &O::consistent, "false: it differs significantly from the rest")});
  return fields;
}

const Fields<ErrorFinding>& findingFields() {
  using E = ErrorFinding;
  using F = Field<E>;
  static const Fields<E> fields(
      "finding", "A possible cause of the misfit.",
      {F("source", &E::source, "Name of the error source or of the system parameter"),
       F("title", &E::title, "Its name for people"),
       F("probability", &E::probability, "Probability that the error is present"),
       F("value", &E::value, "Value, assumed - true, where it is present"),
       F("std", &E::std, "Standard deviation of the value"),
       F("unit", &E::unit, "Unit of value and standard deviation"),
       F("effect_m", &E::effect, "Effect on the ground at the edge of the highest swath"),
       F("determined", &E::determined, "Whether the data can tell presence from absence"),
       F("corrected", &E::corrected, "Whether the correction of points removes it"),
       F("evidence", &E::evidence, "Evidence"), F("remedy", &E::hint, "What to do about it")});
  return fields;
}

const Fields<AngleError>& curveFields() {
  using A = AngleError;
  using F = Field<A>;
  static const Fields<A> fields(
      "angle_error", "Error of the scan angle at a scan angle.",
      {F("angle_deg", &A::angle, "Scan angle, positive to the left", in(kRadiansPerDegree),
         within(90.0)),
       F("error_arcsec", &A::error, "Error", in(kRadiansPerArcsec), alwaysKnown),
       F("std_arcsec", &A::std, "Standard deviation", in(kRadiansPerArcsec), alwaysKnown)});
  return fields;
}

void readWarnings(Result& result, const FieldNode& node) {
  for (const std::string& text : node.texts()) result.warnings.emplace_back(text);
}

std::vector<Field<Result>> fitRows() {
  using F = Field<Result>;
  return {
      F("sigma0", &Result::sigma0, "A posteriori standard deviation of unit weight", mayBeMissing),
      F("redundancy", &Result::redundancy, "Redundancy of the adjustment", mayBeMissing),
      F("converged", &Result::converged, "Whether the adjustment converged", mayBeMissing),
      F("iterations", &Result::iterations, iterationFields(), "Iterations", mayBeMissing),
      F("pairs", &Result::pairs, pairFields(), "Fit of the pairs of strips", mayBeMissing),
      F("misfit", &Result::misfit, misfitFields(), "Misfit of all pairs", mayBeMissing),
      F("residuals", &Result::residuals, residualFields(), "Distances of all pairs in bins",
        onlyIf([](const Result& result) { return !result.residuals.edges.empty(); })),
      F("control", &Result::control, controlFields(), "Strips against control", mayBeMissing),
      F("control_points", &Result::control_points, controlPointFields(), "Control points",
        mayBeMissing),
      F("strip_offsets", &Result::strip_offsets, offsetFields(), "Heights of the strips",
        mayBeMissing),
      F("diagnosis", &Result::diagnosis, findingFields(), "Possible causes of the misfit",
        unlessEmpty),
      F("scan_angle_curve", &Result::scan_angle_curve, curveFields(),
        "Errors of the scan angle as a function of it, if the data support a curve",
        onlyIf([](const Result& result) { return !result.diagnosis.empty(); }), unlessEmpty)};
}

}  // namespace

const Fields<CalibrationResult>& reportFields() {
  using F = Field<Result>;
  static const Fields<Result> fields("report", "What the calibration found.", [] {
    std::vector<F> rows = fitRows();
    rows.push_back(F("observability", &Result::observability,
                     "What is weakly determined, why, and what would help", mayBeMissing));
    rows.push_back(F(
        "warnings", [](const Result& result) { return textsOf(result.warnings); },
        "What a user should know", reads(readWarnings), mayBeMissing));
    rows.push_back(F(
        "left_out", [](const Result& result) -> const auto& { return result.excluded; },
        excludedFields(), "Points that took no part"));
    return rows;
  }());
  return fields;
}

}  // namespace pcl_als::detail
