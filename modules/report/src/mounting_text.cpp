// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/report/mounting_report.h>

#include "formatted.h"
#include "json_number.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

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

std::string parameterTable(const MountingReport& report) {
  std::string text =
      "| bias (assumed - true) |        value |          std | unit   | status         |\n"
      "|-----------------------|--------------|--------------|--------|----------------|\n";
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = report.parameters[std::size_t(indexOf(info.parameter))];
    const int digits = tableDecimals(info.parameter);
    text += formatted("| %-21s | %12.*f | ", std::string(info.name).c_str(), digits,
                      estimate.bias / info.internal_per_unit) +
            deviationText(estimate.std / info.internal_per_unit, digits) +
            formatted(" | %-6s | %-14s |\n", std::string(info.unit).c_str(),
                      std::string(toString(estimate.status)).c_str());
  }
  return text;
}

Json vectorJson(const Eigen::Vector3d& v) {
  return {number(v[0]), number(v[1]), number(v[2])};
}

Json matrixJson(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Json row = Json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) row.push_back(number(matrix(r, c)));
    rows.push_back(std::move(row));
  }
  return rows;
}

Json namesJson(const MountingConvention& convention) {
  Json names = Json::array();
  for (const MountingAngle& angle : convention.angles) names.push_back(angle.name);
  return names;
}

Json mountingValues(const MountingReport& report, const Mounting& mounting) {
  Json json{{"angles", vectorJson(mounting.angles)}};
  json["lever_arm_m"] = report.input.lever_arm ? vectorJson(mounting.lever_arm) : Json(nullptr);
  return json;
}

Json conventionJson(const MountingConvention& convention) {
  return {{"name", convention.name},
          {"angles", namesJson(convention)},
          {"unit", convention.unit},
          {"axes", convention.axes},
          {"definition", describe(convention)}};
}

Json newJson(const MountingReport& report) {
  const MountingCorrection& correction = report.correction;
  Json json = mountingValues(report, correction.after);
  if (!report.input.lever_arm) json["lever_arm_to_add_m"] = vectorJson(correction.after.lever_arm);
  json["angles_std"] = {number(correction.std(0)), number(correction.std(1)),
                        number(correction.std(2))};
  json["lever_arm_std_m"] = {number(correction.std(3)), number(correction.std(4)),
                             number(correction.std(5))};
  json["body_from_scanner"] = matrixJson(correction.matrix);
  json["gimbal_sine"] = number(correction.gimbal_sine);
  return json;
}

Json covarianceJson(const MountingReport& report) {
  Json order = namesJson(report.input.convention);
  for (const char* name : {"lever_arm_x", "lever_arm_y", "lever_arm_z"}) order.push_back(name);
  return {{"order", std::move(order)}, {"matrix", matrixJson(report.correction.covariance)}};
}

Json biasesJson(const MountingReport& report) {
  Json json = Json::object();
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate = report.parameters[std::size_t(indexOf(info.parameter))];
    json[std::string(info.name)] = {{"bias", number(estimate.bias / info.internal_per_unit)},
                                    {"std", number(estimate.std / info.internal_per_unit)},
                                    {"unit", info.unit},
                                    {"status", toString(estimate.status)}};
  }
  return json;
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

std::string mountingJson(const MountingReport& report) {
  const MountingCorrection& correction = report.correction;
  Json root{{"format", "pcl_als mounting"}, {"version", 1}};
  root["convention"] = conventionJson(report.input.convention);
  if (!report.input.system.empty()) root["system"] = report.input.system;
  root["old"] = mountingValues(report, correction.before);
  root["new"] = newJson(report);
  root["covariance"] = covarianceJson(report);
  root["range_to_add_m"] = number(report.range_correction);
  root["scan_angle_factor"] = number(report.scan_angle_factor);
  root["subtracted"] = mountingValues(report, correction.subtracted);
  root["subtracted"]["wrong_by_arcsec"] = number(correction.subtracted_angle / kRadiansPerArcsec);
  root["subtracted"]["lever_arm_wrong_by_m"] = number(correction.subtracted_lever);
  root["parameters"] = biasesJson(report);
  root["remarks"] = report.remarks;
  root["inputs"] = {report.calibration};
  root["tool_version"] = PCL_ALS_VERSION;
  return root.dump(2) + "\n";
}

void writeMounting(const std::filesystem::path& path, const MountingReport& report) {
  writeFile(path, mountingJson(report));
}

}  // namespace pcl_als
