// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/parameter_text.h>
#include <pcl_als/io/json_text.h>
#include <pcl_als/io/parameter_fields.h>
#include <pcl_als/report/mounting_report.h>

#include "formatted.h"

namespace pcl_als {
namespace {

using namespace field;

constexpr const char* kLeverNames[] = {"lever arm x", "lever arm y", "lever arm z"};

/// Digits of angles that are some micrometres at 1000 m.
int decimalsOfUnit(const std::string& unit) {
  return unit == "rad" ? 9 : unit == "arcsec" ? 4 : 7;
}

std::string deviationText(double value, int digits) {
  return std::isfinite(value) ? formatted("%12.*f", digits, value) : formatted("%12s", "-");
}

/// Without the sign of a zero that has come from rounding.
double rounded(double value, int digits) {
  return std::abs(value) < 0.5 * std::pow(10.0, -digits) ? 0.0 : value;
}

std::string valueRow(const std::string& name, double before, double after, double std, int digits,
                     const std::string& unit) {
  return formatted("| %-13s | %15.*f | %15.*f | ", name.c_str(), digits, rounded(before, digits),
                   digits, rounded(after, digits)) +
         deviationText(std, digits) + formatted(" | %-6s |\n", unit.c_str());
}

std::string valueTable(const MountingReport& report) {
  const MountingConvention& convention = report.input.convention;
  const MountingCorrection& correction = report.correction;
  std::string text =
      "| value         |             old |  new: type this |          std | unit   |\n"
      "|---------------|-----------------|-----------------|--------------|--------|\n";
  for (int i = 0; i < 3; ++i)
    text += valueRow(convention.angles[std::size_t(i)].name, correction.before.angles[i],
                     correction.after.angles[i], correction.std(i), decimalsOfUnit(convention.unit),
                     convention.unit);
  for (int i = 0; i < 3; ++i) {
    const std::string name = kLeverNames[i];
    text += report.input.lever_arm
                ? valueRow(name, correction.before.lever_arm[i], correction.after.lever_arm[i],
                           correction.std(3 + i), 4, "m")
                : formatted("| %-13s | %15s | %+15.4f | ", name.c_str(), "(add)",
                            rounded(correction.after.lever_arm[i], 4)) +
                      deviationText(correction.std(3 + i), 4) + " | m      |\n";
  }
  return text;
}

std::string rangeText(const MountingReport& report) {
  std::string text;
  if (report.range_correction != 0.0)
    text += formatted(
        "Ranges: measured ranges are %.4f m too %s; add %+.4f m to every range (or to the range "
        "offset that is added to it)\n",
        std::abs(report.range_correction), report.range_correction < 0.0 ? "long" : "short",
        report.range_correction);
  if (report.scan_angle_factor != 1.0)
    text += formatted(
        "Scan angles: measured scan angles are too %s; multiply every scan angle (or its scale) by "
        "%.8f\n",
        report.scan_angle_factor < 1.0 ? "large" : "small", report.scan_angle_factor);
  return text;
}

std::string matrixText(const MountingReport& report) {
  std::string text =
      "Matrix of the new rotation, scanner to body (axes " + report.input.convention.axes + ")\n";
  for (int r = 0; r < 3; ++r)
    text += formatted("  %14.10f %14.10f %14.10f\n", rounded(report.correction.matrix(r, 0), 10),
                      rounded(report.correction.matrix(r, 1), 10),
                      rounded(report.correction.matrix(r, 2), 10));
  return text;
}

std::string subtractionText(const MountingReport& report) {
  const MountingCorrection& correction = report.correction;
  const double arcsec = correction.subtracted_angle / kRadiansPerArcsec;
  const double range = report.input.range;
  const double shift = 2.0 * std::sin(0.5 * correction.subtracted_angle) * range;
  const int digits = decimalsOfUnit(report.input.convention.unit);
  std::string text = "Subtracting the biases from the old angles, axis by axis, would give";
  for (int i = 0; i < 3; ++i)
    text += formatted("%s %.*f", i == 0 ? "" : ",", digits, correction.subtracted.angles[i]);
  return text +
         formatted(": wrong by %.2f arcsec, up to %.1f mm at %.0f m; the lever arm by %.2f mm\n",
                   arcsec, 1e3 * shift, range, 1e3 * correction.subtracted_lever);
}

/// A mounting with the report that has it.
struct ReportedMounting {
  const Mounting* mounting;
  bool lever_arm;
  bool known() const { return lever_arm; }
};

/// One of the mountings of the correction.
auto mountingAt(Mounting MountingCorrection::*member) {
  return [member](const MountingReport& r) {
    return ReportedMounting{&(r.correction.*member), r.input.lever_arm.has_value()};
  };
}

const Fields<ReportedMounting>& mountingFields() {
  using M = ReportedMounting;
  static const Fields<M> fields(
      "mounting_values", "A mounting.",
      {{"angles", [](const M& m) { return m.mounting->angles; }, "In the unit of the convention"},
       {"lever_arm_m", [](const M& m) { return m.mounting->lever_arm; }, "Lever arm",
        knownIf(&M::known)}});
  return fields;
}

std::vector<std::string> angleNames(const MountingConvention& convention) {
  std::vector<std::string> names;
  for (const MountingAngle& angle : convention.angles) names.push_back(angle.name);
  return names;
}

const Fields<MountingConvention>& conventionFields() {
  using C = MountingConvention;
  static const Fields<C> fields(
      "convention", "How the program states a mounting.",
      {{"name", &C::name, "Name; empty: composed by the user"},
       {"angles", angleNames, "Names of the angles as they are typed"},
       {"unit", &C::unit, "Their unit"},
       {"axes", &C::axes, "Directions of the axes of the body"},
       {"definition", [](const C& c) { return describe(c); }, "The same as a sentence"}});
  return fields;
}

Eigen::Vector3d stdAt(const MountingReport& report, int first) {
  const MountingCorrection& c = report.correction;
  return {c.std(first), c.std(first + 1), c.std(first + 2)};
}

const Fields<MountingReport>& mountingsFields() {
  using C = MountingCorrection;
  using F = Field<MountingReport>;
  using R = MountingReport;
  static const Fields<R> changed(
      "new", "The mounting to be typed.",
      {F::all(mountingAt(&C::after), mountingFields()),
       {"lever_arm_to_add_m", [](const R& r) { return r.correction.after.lever_arm; },
        "What is added to the lever arm, if it is not known",
        onlyIf([](const R& r) { return !r.input.lever_arm; })},
       {"angles_std", [](const R& r) { return stdAt(r, 0); }, "Standard deviations of the angles"},
       {"lever_arm_std_m", [](const R& r) { return stdAt(r, 3); }, "And of the lever arm"},
       {"body_from_scanner", [](const R& r) { return r.correction.matrix; },
        "Matrix from the scanner to the axes of the body"},
       {"gimbal_sine", [](const R& r) { return r.correction.gimbal_sine; },
        "Sine of the angle between the first and the third axis"}});
  static const Fields<R> subtracted(
      "subtracted", "What subtracting the biases axis by axis would give.",
      {F::all(mountingAt(&C::subtracted), mountingFields()),
       {"wrong_by_arcsec", [](const R& r) { return r.correction.subtracted_angle; },
        "Its rotation against the exact one", in(kRadiansPerArcsec)},
       {"lever_arm_wrong_by_m", [](const R& r) { return r.correction.subtracted_lever; },
        "Its lever arm against the exact one"}});
  const auto order = [](const R& r) {
    std::vector<std::string> names = angleNames(r.input.convention);
    names.insert(names.end(), {"lever_arm_x", "lever_arm_y", "lever_arm_z"});
    return names;
  };
  static const Fields<R> covariance(
      "covariance", "Covariance of the new mounting.",
      {{"order", order, "Angles and components of the lever arm"},
       {"matrix", [](const R& r) { return r.correction.covariance; }, "Unit of the angles and m"}});
  static const Fields<R> fields(
      "mountings", "Old and new mounting.",
      {{"old", mountingAt(&C::before), mountingFields(), "The mounting of the points"},
       {"new", kSameObject, changed, "The mounting to be typed"},
       {"covariance", kSameObject, covariance, "Its covariance"},
       {"range_to_add_m", &R::range_correction, "To be added to measured ranges"},
       {"scan_angle_factor", &R::scan_angle_factor, "By which scan angles are multiplied"},
       {"subtracted", kSameObject, subtracted, "For comparison"}});
  return fields;
}

const ParameterEstimate& estimateOf(const MountingReport& report, const SystemParameterInfo& info) {
  return report.parameters[std::size_t(indexOf(info.parameter))];
}

const Fields<MountingReport>& biasesFields() {
  using P = ParameterEstimate;
  using R = MountingReport;
  static const auto fields = fieldsByParameter<R>(
      "parameters", "System parameters.", [](const SystemParameterInfo& info) -> Field<R> {
        const auto unit = in(info.internal_per_unit);
        const Fields<P> bias(
            "parameter_" + std::string(info.unit), "A parameter of the calibration.",
            {{"bias", &P::bias, "Assumed - true value", unit, of(info.unit)},
             {"std", &P::std, "Standard deviation", unit, of(info.unit)},
             unitField<P>(info.unit),
             {"status", &P::status, parameterStatusNames(), "Whether it was estimated"}});
        return {std::string(info.name),
                [&info](const R& r) -> const P& { return estimateOf(r, info); }, bias, ""};
      });
  return fields;
}

std::string parameterTable(const MountingReport& report) {
  std::string text =
      "| bias (assumed - true) |        value |          std | unit   | status         |\n"
      "|-----------------------|--------------|--------------|--------|----------------|\n";
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = estimateOf(report, info);
    const int digits = tableDecimals(info.parameter);
    text += formatted("| %-21s | %12.*f | ", std::string(info.name).c_str(), digits,
                      estimate.bias / info.internal_per_unit) +
            deviationText(estimate.std / info.internal_per_unit, digits) +
            formatted(" | %-6s | %-14s |\n", std::string(info.unit).c_str(),
                      std::string(toString(estimate.status)).c_str());
  }
  return text;
}

}  // namespace

std::string mountingText(const MountingReport& report) {
  const MountingConvention& convention = report.input.convention;
  std::string text = "New mounting of the scanner";
  if (!report.input.system.empty()) text += ", system " + report.input.system;
  if (!convention.name.empty()) text += ", convention " + convention.name + ": " + convention.use;
  text += "\n" + describe(convention) + "\n\n" + valueTable(report) + rangeText(report) + "\n" +
          matrixText(report) + "\n" + subtractionText(report) + "\n" + parameterTable(report);
  for (const std::string& remark : report.remarks) text += "note: " + remark + "\n";
  return text;
}

std::string conventionsText() {
  std::string text;
  for (const MountingConvention& convention : mountingConventions())
    text += convention.name + ": " + convention.use + "\n    " +
            formatted("%s, %s, %s: ", convention.angles[0].name.c_str(),
                      convention.angles[1].name.c_str(), convention.angles[2].name.c_str()) +
            describe(convention) + "\n    source: " + convention.source + "\n";
  return text;
}

const FieldTable& mountingReportFields() {
  using F = Field<MountingReport>;
  using R = MountingReport;
  static const Fields<R> fields(
      "mounting", "Result of `pcl_als_mounting`.",
      {F::constant("format", "pcl_als mounting", ""),
       F::constant("version", 1, ""),
       {"convention", [](const R& r) { return r.input.convention; }, conventionFields(),
        "How the program states a mounting"},
       {"system", [](const R& r) { return r.input.system; }, "One of several systems", unlessEmpty},
       F::all(kSameObject, mountingsFields()),
       {"parameters", kSameObject, biasesFields(), "Of the calibration"},
       {"remarks", &R::remarks, "What a user should know"},
       {"inputs", [](const R& r) { return std::vector{r.calibration}; }, "The calibration"},
       toolVersionField<R>()});
  return fields;
}

std::string mountingJson(const MountingReport& report) {
  return jsonText(mountingReportFields().write(&report));
}

}  // namespace pcl_als
