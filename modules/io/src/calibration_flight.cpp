// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <algorithm>

#include <pcl_als/common/calendar_date.h>

#include "calibration_json.h"

namespace pcl_als::detail {
namespace {

using namespace field;
using Result = CalibrationResult;

// No trajectory of a survey is wrong by more, and a lever arm or boresight is not either.
constexpr double kLargestError = 100.0;       // metres
constexpr double kLargestRotation = 20000.0;  // arc-seconds

std::string keyOf(const TrajectoryAxis& axis, const char* middle) {
  return std::string(axis.name) + middle + "_" + std::string(axis.unit);
}

/// One of the six errors of a knot, or its standard deviation.
Field<TrajectoryErrorKnot> knotField(std::size_t i, bool std) {
  using K = TrajectoryErrorKnot;
  const TrajectoryAxis& axis = kTrajectoryAxes[i];
  const auto member =
      i < 3 ? (std ? &K::position_std : &K::position) : (std ? &K::angles_std : &K::angles);
  const auto at = [ member, k = static_cast<Eigen::Index>(i % 3) ](auto& knot) -> auto& {
    return (knot.*member)[k];
  };
  const auto unit = in(axis.internal_per_unit);
  const auto limit = within(i < 3 ? kLargestError : kLargestRotation);
  if (!std) return {keyOf(axis, ""), at, "Error, assumed - true", unit, limit};
  return {keyOf(axis, "_std"), at, "Its standard deviation", unit, limit, notNegative,
          onlyIf(&K::hasStd)};
}

const Fields<TrajectoryErrorKnot>& knotFields() {
  using K = TrajectoryErrorKnot;
  static const Fields<K> fields =
      Fields<K>("knot", "Errors of the trajectory of a strip at a time; linear between knots.",
                [] {
                  std::vector<Field<K>> rows{Field<K>("time", &K::time, "On the trajectory's clock",
                                                      of("s"), alwaysKnown)};
                  for (const bool std : {false, true})
                    for (std::size_t i = 0; i < kTrajectoryAxes.size(); ++i)
                      rows.push_back(knotField(i, std));
                  return rows;
                }())
          .checked([](const K& /*knot*/, const FieldNode& node) {
            if (!node.has(keyOf(kTrajectoryAxes[0], "_std"))) return;
            for (const TrajectoryAxis& axis : kTrajectoryAxes) (void)node[keyOf(axis, "_std")];
          });
  return fields;
}

/// The lower triangle of the correlations with each other, row by row; those with the parameters,
/// error by error.
Eigen::VectorXd triangleOf(const StripErrorCorrelation& correlation) {
  Eigen::VectorXd values(15);
  for (Eigen::Index row = 1, at = 0; row < 6; ++row)
    for (Eigen::Index column = 0; column < row; ++column)
      values[at++] = correlation.errors(row, column);
  return values;
}

using WithParameters = Eigen::Matrix<double, Eigen::Dynamic, 6>;  // transposed: row by row

std::vector<double> correlationsIn(const FieldNode& node) {
  std::vector<double> values;
  for (const FieldNode& item : node.items()) values.push_back(item.within(1.0, "(correlation)"));
  return values;
}

void readTriangle(StripErrorCorrelation& correlation, const FieldNode& node) {
  (void)node.items(15);
  const std::vector<double> values = correlationsIn(node);
  correlation.errors.setIdentity();
  std::size_t at = 0;
  for (Eigen::Index row = 1; row < 6; ++row)
    for (Eigen::Index column = 0; column < row; ++column)
      correlation.errors(row, column) = correlation.errors(column, row) = values[at++];
}

void readWithParameters(StripErrorCorrelation& correlation, const FieldNode& node) {
  const std::vector<double> values = correlationsIn(node);
  if (values.size() % 6 != 0) node.refuse("must have six values for each parameter");
  const auto parameters = static_cast<Eigen::Index>(values.size() / 6);
  correlation.parameters =
      Eigen::Map<const WithParameters>(values.data(), parameters, 6).transpose();
}

const Fields<StripErrors>& stripErrorFields() {
  using C = StripErrorCorrelation;
  using S = StripErrors;
  static const Fields<C> correlations(
      "strip_correlation", "Correlations of the errors of a strip at a time, a posteriori.",
      {Field<C>("time", &C::time, "On the trajectory's clock", of("s"), alwaysKnown),
       Field<C>("errors", triangleOf,
                "Of east, north, up, pitch, roll and heading: lower triangle by rows",
                reads(readTriangle)),
       Field<C>(
           "parameters",
           [](const C& c) -> Eigen::VectorXd {
             const WithParameters values = c.parameters.transpose();
             return Eigen::Map<const Eigen::VectorXd>(values.data(), values.size());
           },
           "Of these six (rows) with the parameters of `correlation`", reads(readWithParameters))});
  static const Fields<S> fields("strip_correction", "Errors of the trajectory of one strip.",
                                {Field<S>("strip", &S::id, "Strip"),
                                 Field<S>("knots", &S::knots, knotFields(), "Errors over time"),
                                 Field<S>("correlations", &S::correlations, correlations,
                                          "At some of the knots", unlessEmpty)});
  return fields;
}

void checkCorrelations(const Result& result, const FieldNode& node) {
  for (std::size_t i = 0; i < result.strip_errors.size(); ++i) {
    const auto& all = result.strip_errors[i].correlations;
    const auto at = [&](std::size_t k) { return node.items()[i]["correlations"].items()[k]; };
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].parameters.cols() != static_cast<Eigen::Index>(result.correlation_order.size()))
        at(k)["parameters"].refuse("must have six values for each name of 'correlation.order'");
      if (k > 0 && !(all[k - 1].time < all[k].time))
        at(k)["time"].refuse("must be later than the one before");
    }
  }
}

Field<LargeCorrection> largeField(const char* name, double LargeCorrection::*member,
                                  const char* what) {
  using L = LargeCorrection;
  return Field<L>(
      name, [member](const L& c) { return c.*member / c.axisInfo().internal_per_unit; }, what,
      reads([member](L& c, const FieldNode& node) {
        c.*member = node.number() * c.axisInfo().internal_per_unit;
      }));
}

void readAxis(LargeCorrection& correction, const FieldNode& node) {
  const std::string name = node.text();
  const auto* const axis = std::find_if(kTrajectoryAxes.begin(), kTrajectoryAxes.end(),
                                        [&](const TrajectoryAxis& a) { return a.name == name; });
  if (axis == kTrajectoryAxes.end()) node.refuse("must be east, north, up, pitch, roll or heading");
  correction.axis = static_cast<std::size_t>(axis - kTrajectoryAxes.begin());
}

void readAxisUnit(LargeCorrection& correction, const FieldNode& node) {
  const std::string unit(correction.axisInfo().unit);
  if (node.text() != unit) node.refuse("must be '" + unit + "'");
}

const Fields<LargeCorrection>& largeCorrectionFields() {
  using L = LargeCorrection;
  using F = Field<L>;
  static const Fields<CorrectionCause> causes(
      "cause", "What may have caused a large correction.",
      {Field<CorrectionCause>("name", &CorrectionCause::name, "One word for programs"),
       Field<CorrectionCause>("evidence", &CorrectionCause::evidence, "Evidence for it")});
  static const Fields<L> fields(
      "large_correction",
      "A part of a strip in which the trajectory is wrong by more than ordinary errors.",
      {F("strip", &L::strip, "Strip"),
       F("from", &L::from, "Begin of the interval in which the error is at least half of the value",
         of("s"), alwaysKnown),
       F("to", &L::to, "End of the interval", of("s"), alwaysKnown,
         checked([](const L& correction, const FieldNode& node) {
           if (!(correction.from <= correction.to)) node.refuse("must not be earlier than 'from'");
         })),
       F("time", &L::time, "Time of the value", of("s"), alwaysKnown),
       F(
           "axis", [](const L& correction) { return correction.axisInfo().name; },
           "Direction or rotation that is wrong",
           oneOf({"east", "north", "up", "pitch", "roll", "heading"}), reads(readAxis)),
       largeField("value", &L::value, "Largest error, assumed - true, in `unit`"),
       largeField("std", &L::std, "Its standard deviation"),
       largeField("ordinary_std", &L::ordinary, "Standard deviation of ordinary errors"),
       F(
           "unit", [](const L& correction) { return correction.axisInfo().unit; }, "m or arcsec",
           reads(readAxisUnit)),
       F("on_ground_m", &L::on_ground, "Effect at the edge of the swath", alwaysKnown),
       F("begin", &L::begin, "Easting and northing of the trajectory at the begin", of("m"),
         alwaysKnown),
       F("end", &L::end, "Easting and northing at the end", of("m"), alwaysKnown),
       F("causes", &L::causes, causes, "Probable causes; empty: none was found")});
  return fields;
}

/// Lists by column: a knot of a long flight takes a fifth of what an object with names would.
struct AttitudePass {
  std::vector<double> times, pitch, crab;
};

std::vector<AttitudePass> passesOf(const Result& result) {
  std::vector<AttitudePass> passes;
  for (const RecoveredAttitude::Pass& pass : result.recovered_attitude.passes()) {
    AttitudePass& columns = passes.emplace_back();
    for (const RecoveredAttitude::Knot& knot : pass) {
      columns.times.push_back(knot.time);
      columns.pitch.push_back(knot.angles.pitch);
      columns.crab.push_back(knot.angles.crab);
    }
  }
  return passes;
}

const Fields<AttitudePass>& passFields() {
  using P = AttitudePass;
  constexpr double kRightAngle = 324000.0;  // arc-seconds
  static const Fields<P> fields(
      "attitude_pass", "Pitch and crab of an uninterrupted piece of flight.",
      {Field<P>("times", &P::times, "On the trajectory's clock", of("s"), alwaysKnown),
       Field<P>("pitch_arcsec", &P::pitch, "Pitch, nose up", in(kRadiansPerArcsec),
                within(kRightAngle)),
       Field<P>("crab_arcsec", &P::crab, "Crab, counter-clockwise against the line of flight",
                in(kRadiansPerArcsec), within(kRightAngle))});
  return fields;
}

void readPasses(Result& result, const FieldNode& node) {
  for (const FieldNode& item : node.items()) {
    AttitudePass columns;
    passFields().read(columns, item);
    const std::vector<double>& times = columns.times;
    if (times.empty() || times.size() != columns.pitch.size() ||
        times.size() != columns.crab.size())
      item.refuse("must have as many times as pitch_arcsec and crab_arcsec, one at least");
    RecoveredAttitude::Pass pass(times.size());
    for (std::size_t i = 0; i < pass.size(); ++i) {
      pass[i] = {times[i], {columns.pitch[i], columns.crab[i]}};
      if (i > 0 && !(times[i] > times[i - 1])) item["times"].items()[i].refuse("must be later");
    }
    result.recovered_attitude.addPass(std::move(pass));
  }
}

const Fields<FixedSurface>& heldSurfaceFields() {
  using H = FixedSurface;
  using F = Field<H>;
  static const Fields<H> fields(
      "held_surface", "Strips or a reference surface that were held fixed.",
      {F("name", &H::name, "\"fixed strips\", or the file of the surface"),
       F("strips", &H::strips, "The fixed strips; empty for a surface"),
       F("std_m", &H::std, "A priori standard deviation of its points"),
       F("offset_prior_m", &H::offset_prior,
         "A priori standard deviation of a common height error; 0: none"),
       F("correspondences", &H::correspondences, "Correspondences with other strips"),
       F("mean_before_m", &H::mean_before, "Mean distance of other strips above it, before"),
       F("rms_before_m", &H::rms_before, "RMS distance before"),
       F("mean_after_m", &H::mean_after, "Mean distance after the calibration"),
       F("rms_after_m", &H::rms_after, "RMS distance after"),
       F("offset_m", &H::offset, "Its height above the rest of the block"),
       F("offset_std_m", &H::offset_std, "Standard deviation of the offset"),
       F("offset_determined", &H::offset_determined,
         "false: it alone determines the height of the block")});
  return fields;
}

void readDate(Result& result, const FieldNode& node) {
  result.day = daysOfGps(node.text(), "ymd");
  if (!result.day) node.refuse("is no date such as 2026-05-04");
}

}  // namespace

const Fields<CalibrationResult>& flightFields() {
  using F = Field<Result>;
  static const Fields<Result> fields(
      "flight", "What applies only to the flight that was calibrated with.",
      {F(
           "date", [](const Result& result) { return result.day ? dateText(*result.day) : ""; },
           "Date of the flight, if the times of the points tell it", reads(readDate), unlessEmpty),
       F("strip_corrections", &Result::strip_errors, stripErrorFields(),
         "Errors of the trajectory, strip by strip", checked(checkCorrelations), mayBeMissing),
       F("large_corrections", &Result::large_corrections, largeCorrectionFields(),
         "Where the trajectory is wrong by more than ordinary errors; at most ten", unlessEmpty),
       F("recovered_attitude", passesOf, passFields(),
         "Pitch and crab by pass, if they were recovered from the points", reads(readPasses),
         unlessEmpty),
       F("held", &Result::held, heldSurfaceFields(), "What was held fixed", unlessEmpty)});
  return fields;
}

}  // namespace pcl_als::detail
