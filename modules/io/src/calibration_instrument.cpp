// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <cmath>

#include <pcl_als/common/error_source.h>
#include <pcl_als/common/errors.h>
#include <pcl_als/common/printable.h>

#include "calibration_json.h"

namespace pcl_als::detail {
namespace {

using namespace field;
using Result = CalibrationResult;
using Parameters = std::array<ParameterEstimate, kSystemParameterCount>;

// No trajectory of a survey is wrong by more, and a lever arm or boresight is not either.
constexpr double kLargestShift = 100.0;   // metres
constexpr double kLargestTurn = 20000.0;  // arc-seconds

void readBias(const SystemParameterInfo& info, const FieldNode& node, double& bias) {
  bias = node.number() * info.internal_per_unit;
  const std::string refused = refusedBias(info.parameter, bias);
  if (!refused.empty()) node.refuse("is out of range: " + refused);
}

double writableBias(const SystemParameterInfo& info, double bias) {
  if (!std::isfinite(bias))
    throw UsageError("calibration: the bias of " + std::string(info.name) +
                     " is not a finite number and cannot be written");
  return bias / info.internal_per_unit;
}

Fields<ParameterEstimate> parameterFields(const SystemParameterInfo& info) {
  using P = ParameterEstimate;
  using F = Field<P>;
  const double unit = info.internal_per_unit;
  return {
      "parameter_" + std::string(info.unit),
      "Estimate of a system parameter, unit " + std::string(info.unit) + ".",
      {F(
           "bias", [&info](const P& p) { return writableBias(info, p.bias); },
           "Assumed - true value",
           reads([&info](P& p, const FieldNode& node) { readBias(info, node, p.bias); }),
           of(info.unit), alwaysKnown),
       F("std", &P::std, "Standard deviation, including errors that pairs of strips share",
         in(unit), of(info.unit), mayBeMissing),
       F("std_formal", &P::std_formal,
         "Standard deviation by the noise of points alone (Habib et al. 2011, Eq. (26))", in(unit),
         of(info.unit), mayBeMissing),
       unitField<P>(info.unit),
       F("status", &P::status, parameterStatusNames(), "Whether it was estimated", mayBeMissing),
       F("prior_share", &P::prior_share,
         "Part of the variance that stems from the prior: 0 (this flight alone) to 1 (the prior "
         "alone)",
         onlyIf([](const P& p) { return p.prior_share > 0.0; })),
       F("determined", &P::determined, "false: the estimate does not differ from zero noticeably",
         onlyIf([](const P& p) { return !p.determined; })),
       F("reason", &P::reason, "Why it is fixed, not estimable or not determined", unlessEmpty)}};
}

const Fields<Parameters>& parametersFields() {
  static const auto fields = fieldsByParameter<Parameters>(
      "parameters", "The system parameters.", [](const SystemParameterInfo& info) {
        return Field<Parameters>(std::string(info.name), ParameterElement(info.parameter),
                                 parameterFields(info), "");
      });
  return fields;
}

const Fields<SystemEstimate>& systemFields() {
  using S = SystemEstimate;
  using F = Field<S>;
  static const auto differences = fieldsByParameter<SystemVector>(
      "difference_std", "Standard deviations of the differences from the first system.",
      [](const SystemParameterInfo& info) {
        const ParameterElement element(info.parameter);
        return Field<SystemVector>(
            std::string(info.name), element, "", in(info.internal_per_unit), of(info.unit),
            onlyIf([element](const SystemVector& all) { return element(all) > 0.0; }));
      });
  static const Fields<S> fields =
      Fields<S>("system", "One of several systems that were calibrated together.",
                {F(
                     "name", [](auto& s) -> auto& { return s.group.name; }, "Name of the system"),
                 F(
                     "strips", [](auto& s) -> auto& { return s.group.strips; }, "Its strips"),
                 F("parameters", &S::parameters, parametersFields(), "Its system parameters"),
                 F("difference_std", &S::difference_std, differences,
                   "Standard deviations of the differences from the first system"),
                 F("offset_m", &S::offset,
                   "Error of its coordinates relative to the first system: east, north, up"),
                 F("offset_std_m", &S::offset_std, "Standard deviations of the offset")})
          .checked([](const S& system, const FieldNode& node) {
            constexpr double kLargestOffset = 100.0;  // metres
            if (!(system.offset.cwiseAbs().maxCoeff() < kLargestOffset))
              node["offset_m"].refuse("must be numbers of less than 100 m");
          });
  return fields;
}

/// Values beyond these are refused, internal units: an error of the file.
double largestOf(ErrorSource source) {
  switch (source) {
    case ErrorSource::slope_ranging:
    case ErrorSource::intensity_ranging:
      return 1.0;
    case ErrorSource::time_offset:
    case ErrorSource::height_offset:
    case ErrorSource::east_offset:
    case ErrorSource::north_offset:
      return 10.0;
    case ErrorSource::range_scale:
    case ErrorSource::deflection_scale:
      return 0.01;
    default:
      return kRadiansPerDegree;
  }
}

std::vector<Field<Result>> sourceRows() {
  using F = Field<Result>;
  std::vector<F> rows;
  for (const ErrorSourceInfo& info : errorSources()) {
    const int i = indexOf(info.source);
    const Fields<double> value(
        "error_source_" + std::string(info.name),
        "Error that is corrected: " + std::string(info.title) + ".",
        {Field<double>("value", kSameObject, "Assumed - true value", in(info.internal_per_unit),
                       of(info.unit), within(largestOf(info.source) / info.internal_per_unit)),
         unitField<double>(info.unit)});
    rows.push_back(F(
        std::string(info.name), [i](auto& result) -> auto& { return result.sources[i]; }, value, "",
        onlyIf([i](const Result& result) { return result.sources[i] != 0.0; })));
  }
  rows.push_back(F(
      "largest_scan_angle_deg",
      [](auto& result) -> auto& { return result.source_scale.largest_angle; },
      "Largest scan angle, to which errors of the encoder refer; 0: not known",
      in(kRadiansPerDegree), within(90.0)));
  rows.push_back(F(
      "median_intensity",
      [](auto& result) -> auto& { return result.source_scale.median_intensity; },
      "Median intensity, to which errors of the range refer; 0: not known", alwaysKnown));
  rows.push_back(F(
      "deflected_about_axis", [](auto& result) -> auto& { return result.source_scale.about_axis; },
      "true: a conical or rosette scanner",
      onlyIf([](const Result& result) { return result.source_scale.about_axis; })));
  return rows;
}

const Fields<ErrorLevels>& levelFields() {
  using L = ErrorLevels;
  const auto metres = [](const char* name, double L::*member, const char* meaning) {
    return Field<L>(name, member, meaning, within(kLargestShift), notNegative);
  };
  const auto arcsec = [](const char* name, double L::*member, const char* meaning) {
    return Field<L>(name, member, meaning, in(kRadiansPerArcsec), within(kLargestTurn),
                    notNegative);
  };
  static const Fields<L> fields(
      "error_levels",
      "Standard deviations of random errors, and of trajectory errors of which nothing else is "
      "known.",
      {metres("range_m", &L::range, "Range"),
       arcsec("angle_arcsec", &L::angle, "Direction of the pulse"),
       arcsec("footprint_arcsec", &L::footprint, "Place in the footprint that the range is of"),
       metres("position_m", &L::position, "Errors of the trajectory from point to point"),
       metres("trajectory_position_m", &L::trajectory_position, "Position of the trajectory"),
       arcsec("trajectory_roll_pitch_arcsec", &L::trajectory_roll_pitch, "Its roll and pitch"),
       arcsec("trajectory_heading_arcsec", &L::trajectory_heading, "Its heading")});
  return fields;
}

const Fields<Result>& correlationFields() {
  using F = Field<Result>;
  static const Fields<Result> fields(
      "correlation", "Correlations of the estimated parameters.",
      {F("order", &Result::correlation_order, parameterNames(), "The estimated parameters",
         reads([](Result& result, const FieldNode& node) {
           result.correlation_order = parametersNamed(node);
         })),
       F("matrix", &Result::correlation, "Correlations, in this order",
         checked([](const Result& result, const FieldNode& node) {
           const auto size = static_cast<Eigen::Index>(result.correlation_order.size());
           if (result.correlation.rows() != size || result.correlation.cols() != size)
             node.refuse("must have one row for each name of 'correlation.order'");
         }))});
  return fields;
}

void readModel(Result& result, const FieldNode& node) {
  const std::string model = node.text();
  for (const AttitudeSource source : {AttitudeSource::none, AttitudeSource::trajectory}) {
    if (model != modelName(source)) continue;
    result.attitude = source;
    return;
  }
  node.refuseText({"quasi_rigorous", "rigorous"});
}

/// The source of the attitude, which belongs to the model.
void readAttitude(Result& result, const FieldNode& node) {
  const std::string text = node.text();
  for (const AttitudeSource source : {AttitudeSource::none, AttitudeSource::points,
                                      AttitudeSource::trajectory, AttitudeSource::nominal}) {
    if (text != toString(source) || modelName(source) != modelName(result.attitude)) continue;
    result.attitude = source;
    return;
  }
  node.refuse("is '" + printable(text, kLongestQuotation) +
              "'; it must be none or points (quasi_rigorous), trajectory or nominal (rigorous)");
}

void checkPlanes(const Result& result, const FieldNode& node) {
  for (std::size_t i = 0; i < result.scan_planes.size(); ++i)
    if (!(std::abs(result.scan_planes[i].norm() - 1.0) < 1e-6))
      node.items()[i].refuse("must have a length of one");
}

void checkWindow(const Result& result, const FieldNode& node) {
  constexpr double kLongestWindow = 60.0;  // seconds, half of it; the tools' limit of -line_fit
  if (result.line_fit_half_width > kLongestWindow)
    node.refuse("must not exceed 60 seconds: the flight is taken as straight within it");
}

const Fields<CalibrationVerdict>& verdictFields() {
  using V = CalibrationVerdict;
  using Status = CalibrationStatus;
  static const Fields<V> fields(
      "verdict", "Whether the calibration may be applied to points.",
      {Field<V>("status", &V::status,
                FieldNames<Status>(
                    toString, {Status::usable, Status::parameters_affected, Status::no_improvement,
                               Status::not_determined, Status::not_converged}),
                "usable, or the most serious reason against applying it"),
       Field<V>("reason", &V::reason, "The reasons, as a sentence")});
  return fields;
}

bool hasSources(const Result& result) {
  const ErrorSourceScale& scale = result.source_scale;
  return scale.largest_angle > 0.0 || scale.median_intensity > 0.0 || !result.sources.isZero(0.0);
}

void checkSystems(const Result& result, const FieldNode& node) {
  constexpr std::size_t kMaximumSystems = 255;
  if (result.systems.size() > kMaximumSystems) node.refuse("must be at most 255");
}

std::vector<Field<Result>> modelRows() {
  using F = Field<Result>;
  return {F("system_name", &Result::system_name, "Name and serial number of the instrument",
            unlessEmpty),
          F("verdict", &Result::verdict, verdictFields(), "Whether to apply the calibration",
            mayBeMissing),
          F(
              "model", [](const Result& result) { return modelName(result.attitude); },
              "Model of the calibration", oneOf({"quasi_rigorous", "rigorous"}), reads(readModel),
              mayBeMissing),
          F("attitude", &Result::attitude, attitudeNames(), "Source of the attitude",
            reads(readAttitude), mayBeMissing),
          F("parameters", &Result::parameters, parametersFields(),
            "The system parameters; of several systems, those of the first"),
          F("systems", &Result::systems, systemFields(), "All systems, if there are several",
            checked(checkSystems), unlessEmpty),
          F("channel_field", &Result::channel_field,
            "Field of the points that divides strips by the channel of the scanner", unlessEmpty)};
}

}  // namespace

const Fields<CalibrationResult>& instrumentFields() {
  using F = Field<Result>;
  static const Fields<Result> fields(
      "instrument", "What applies to every flight with the instrument.", [] {
        std::vector<F> rows = modelRows();
        const Fields<Result> sources("error_sources", "Further errors that are corrected.",
                                     sourceRows());
        for (F row :
             {F("error_sources", kSameObject, sources, "Further errors that are corrected",
                onlyIf(hasSources)),
              F("correlation", kSameObject, correlationFields(), "Correlations of the parameters",
                mayBeMissing),
              priorField(), heldField(),
              F("line_fit_half_width_s", &Result::line_fit_half_width,
                "Half of the window in which the flight is taken as straight", alwaysKnown,
                notNegative, checked(checkWindow), mayBeMissing),
              F("scan_planes", &Result::scan_planes,
                "Unit normals of the scan planes in the body frame (right, forward, up), if there "
                "are several planes",
                alwaysKnown, checked(checkPlanes), unlessEmpty),
              F("error_levels", &Result::error_levels, levelFields(),
                "Standard deviations of errors that are not estimated", unlessEmpty)})
          rows.push_back(std::move(row));
        return rows;
      }());
  return fields;
}

const FieldNames<SystemParameter>& parameterNames() {
  static const FieldNames<SystemParameter> names = [] {
    using P = SystemParameter;
    return FieldNames<P>(
        +[](P p) { return infoOf(p).name; },
        {P::lever_arm_x, P::lever_arm_y, P::lever_arm_z, P::boresight_pitch, P::boresight_roll,
         P::boresight_heading, P::range_bias, P::scan_angle_scale});
  }();
  return names;
}

const FieldNames<AttitudeSource>& attitudeNames() {
  using A = AttitudeSource;
  static const FieldNames<A> names(toString, {A::none, A::points, A::trajectory, A::nominal});
  return names;
}

}  // namespace pcl_als::detail

namespace pcl_als {

const Fields<SystemVector>& deviationFields() {
  static const auto fields = fieldsByParameter<SystemVector>(
      "parameter_std", "Standard deviations of system parameters.",
      [](const SystemParameterInfo& info) {
        const ParameterElement element(info.parameter);
        return Field<SystemVector>(std::string(info.name), element, "",
                                   field::in(info.internal_per_unit), field::of(info.unit),
                                   field::alwaysKnown, field::notNegative,
                                   field::onlyIf([element](const SystemVector& all) {
                                     return std::isfinite(element(all));
                                   }));
      });
  return fields;
}

const FieldNames<ParameterStatus>& parameterStatusNames() {
  using Status = ParameterStatus;
  static const FieldNames<Status> names(toString,
                                        {Status::estimated, Status::fixed, Status::not_estimable});
  return names;
}

}  // namespace pcl_als
