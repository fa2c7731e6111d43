// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/report/alignment_report.h>

#include "excluded_json.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;
using Result = PatchAlignmentResult;

/// Internal units (m, rad) per unit of the file (m, deg).
double unitOf(int parameter) {
  return parameter < 3 ? 1.0 : kRadiansPerDegree;
}
const char* unitName(int parameter) {
  return parameter < 3 ? "m" : "deg";
}

double valueOf(const Result& result, int parameter) {
  return (parameter < 3 ? result.motion.shift[parameter] : result.motion.rotation[parameter - 3]) /
         unitOf(parameter);
}

const char* statusName(Result::Status status) {
  switch (status) {
    case Result::Status::converged:
      return "converged";
    case Result::Status::not_converged:
      return "not_converged";
    case Result::Status::too_few_pairs:
      return "too_few_pairs";
    case Result::Status::no_overlap:
      return "no_overlap";
  }
  return "";
}

Json parametersOf(const Result& result) {
  Json all;
  for (int p = 0; p < Result::kParameters; ++p) {
    Json& one = all[Result::name(p)];
    const bool known = result.parameters[p].determined;
    one["value"] = known ? Json(valueOf(result, p)) : Json();
    one["std"] = known ? Json(result.standardDeviation(p) / unitOf(p)) : Json();
    one["std_formal"] = known ? Json(result.formalStandardDeviation(p) / unitOf(p)) : Json();
    one["unit"] = unitName(p);
    one["status"] = known ? "estimated" : "not_determined";
    if (!known) one["reason"] = result.parameters[p].reason;
  }
  Json& scale = all["scale"];
  scale["value"] = result.motion.scale;
  scale["std"] = result.scale_std;
  scale["unit"] = "1";
  scale["status"] = result.scale_std > 0.0 ? "estimated" : "fixed";
  return all;
}

Json matrixOf(const Result::Matrix6d& matrix) {
  Json rows = Json::array();
  for (int i = 0; i < Result::kParameters; ++i) {
    Json row = Json::array();
    for (int j = 0; j < Result::kParameters; ++j)
      row.push_back(matrix(i, j) / (unitOf(i) * unitOf(j)));
    rows.push_back(row);
  }
  return rows;
}

Json covarianceOf(const Result& result) {
  Json all;
  for (int p = 0; p < Result::kParameters; ++p) {
    all["order"].push_back(Result::name(p));
    all["units"].push_back(unitName(p));
  }
  all["matrix"] = matrixOf(result.covariance);
  all["formal"] = matrixOf(result.covariance_formal);
  all["jackknife"] = matrixOf(result.covariance_jackknife);
  all["jackknife_groups"] = result.jackknife_groups;
  return all;
}

Json distancesOf(const DistanceSummary& before, const DistanceSummary& after, std::size_t pairs) {
  return {{"pairs", pairs},
          {"mean_before_m", before.mean},
          {"rms_before_m", before.rms},
          {"mean_after_m", after.mean},
          {"rms_after_m", after.rms}};
}

/// About the centroid: at map coordinates a matrix would lose millimetres in six digits.
Json transformationOf(const RigidMotion& motion) {
  const Eigen::Vector3d& c = motion.centroid;
  const Eigen::Matrix4d matrix = motion.transformation(c, c).matrix();
  Json rows = Json::array();
  for (int i = 0; i < 4; ++i)
    rows.push_back({matrix(i, 0), matrix(i, 1), matrix(i, 2), matrix(i, 3)});
  return {{"origin", {c.x(), c.y(), c.z()}},
          {"meaning", "target - origin = matrix (source - origin)"},
          {"matrix", rows}};
}

}  // namespace

std::string alignmentTable(const Result& result) {
  std::string table = "  parameter  unit         value          std   std formal\n";
  char line[400];
  for (int p = 0; p < Result::kParameters; ++p) {
    const int digits = p < 3 ? 4 : 6;
    if (result.parameters[p].determined) {
      std::snprintf(line, sizeof line, "  %-9s  %-4s  %12.*f %12.*f %12.*f\n", Result::name(p),
                    unitName(p), digits, valueOf(result, p), digits,
                    result.standardDeviation(p) / unitOf(p), digits,
                    result.formalStandardDeviation(p) / unitOf(p));
    } else {
      std::snprintf(line, sizeof line, "  %-9s  %-4s  not determined: %s\n", Result::name(p),
                    unitName(p), result.parameters[p].reason.c_str());
    }
    table += line;
  }
  if (result.scale_std > 0.0) {
    std::snprintf(line, sizeof line, "  scale      1     %12.7f %12.7f\n", result.motion.scale,
                  result.scale_std);
    table += line;
  }
  const auto& c = result.motion.centroid;
  std::snprintf(line, sizeof line,
                "  about the overlap's centroid %.3f %.3f %.3f m (%.0f m2, radius %.0f m)\n"
                "  normal distance   mean %.4f, RMS %.4f m before; mean %.4f, RMS %.4f m after\n"
                "  vertical distance mean %.4f m before, %.4f m after\n"
                "  sigma0 %.4f m, %zu pairs, redundancy %zu, %d iterations\n",
                c.x(), c.y(), c.z(), result.overlap_area, result.radius, result.normal_before.mean,
                result.normal_before.rms, result.normal_after.mean, result.normal_after.rms,
                result.vertical_before.mean, result.vertical_after.mean, result.sigma0,
                result.pairs, result.redundancy, result.iterations);
  return table + line;
}

std::string alignmentJson(const Result& result, const AlignedStrips& strips) {
  Json json;
  json["format"] = "pcl_als icpatch";
  json["version"] = 1;
  json["source"] = {{"name", strips.source}, {"points", strips.source_points}};
  json["target"] = {{"name", strips.target}, {"points", strips.target_points}};
  json["left_out"] = excludedJson(strips.excluded);
  json["status"] = statusName(result.status);
  json["message"] = result.message;
  const auto& c = result.motion.centroid;
  json["centroid"] = {c.x(), c.y(), c.z()};
  json["rotation"] =
      "target = centroid + shift + scale Rx(omega) Ry(phi) Rz(kappa) (source - centroid)";
  json["parameters"] = parametersOf(result);
  json["covariance"] = covarianceOf(result);
  json["transformation"] = transformationOf(result.motion);
  json["sigma0_m"] = result.sigma0;
  json["redundancy"] = result.redundancy;
  json["pairs"] = result.pairs;
  json["iterations"] = result.iterations;
  json["coarse_iterations"] = result.coarse_iterations;
  json["overlap_area_m2"] = result.overlap_area;
  json["radius_m"] = result.radius;
  json["normal_distance"] = distancesOf(result.normal_before, result.normal_after, result.pairs);
  json["vertical_distance"] =
      distancesOf(result.vertical_before, result.vertical_after, result.vertical_pairs);
  json["tool_version"] = PCL_ALS_VERSION;
  return json.dump(1) + "\n";
}

void writeAlignment(const std::filesystem::path& path, const Result& result,
                    const AlignedStrips& strips) {
  writeFile(path, alignmentJson(result, strips));
}

}  // namespace pcl_als
