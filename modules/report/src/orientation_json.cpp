// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <nlohmann/json.hpp>

#include <pcl_als/common/atomic_file.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/image_block_io.h>
#include <pcl_als/report/orientation_report.h>

#include "json_number.h"

namespace pcl_als {
namespace {

using Json = nlohmann::ordered_json;

Json listOf(const Eigen::VectorXd& values, bool known = true) {
  Json list = Json::array();
  for (Eigen::Index i = 0; i < values.size(); ++i) list.push_back(number(values[i], known));
  return list;
}

Json matrixOf(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(listOf(matrix.row(i)));
  return rows;
}

const char* nameOf(BundleResult::Status status) {
  switch (status) {
    case BundleResult::Status::converged:
      return "converged";
    case BundleResult::Status::not_converged:
      return "not_converged";
    case BundleResult::Status::not_determined:
      return "not_determined";
  }
  return "";
}

/// The covariance is in m and degrees, as the values.
Json imagesOf(const BundleResult& bundle) {
  Json all = Json::array();
  const bool known = bundle.reliable();
  for (const OrientedImage& image : bundle.images) {
    Eigen::Matrix<double, 6, 1> unit;
    unit << Eigen::Vector3d::Ones(), Eigen::Vector3d::Constant(1.0 / kRadiansPerDegree);
    const Matrix6d covariance = unit.asDiagonal() * image.covariance * unit.asDiagonal();
    const Eigen::VectorXd std = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    Json one;
    one["image"] = image.orientation.id;
    one["position_m"] = listOf(image.orientation.position);
    one["omega_phi_kappa_deg"] = listOf(image.orientation.angles / kRadiansPerDegree);
    one["std_position_m"] = listOf(std.head(3), known);
    one["std_omega_phi_kappa_deg"] = listOf(std.tail(3), known);
    one["covariance"] = known ? matrixOf(covariance) : Json();
    one["points"] = image.points;
    one["places_on_lines"] = image.lines;
    one["rms_mm"] = image.rms;
    all.push_back(std::move(one));
  }
  return all;
}

Json pointsOf(const BundleResult& bundle) {
  Json all = Json::array();
  for (const GroundPoint& point : bundle.points) {
    const Eigen::VectorXd std = point.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    all.push_back({{"point", point.id},
                   {"position_m", listOf(point.position)},
                   {"std_m", listOf(std, bundle.reliable())},
                   {"covariance_m2", bundle.reliable() ? matrixOf(point.covariance) : Json()},
                   {"rays", point.rays}});
  }
  return all;
}

Json linesOf(const BundleResult& bundle) {
  Json all = Json::array();
  for (const AdjustedLine& line : bundle.lines) {
    const Eigen::VectorXd std = line.line.covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    all.push_back({{"line", line.line.id},
                   {"used", line.used},
                   {"start_m", listOf(line.line.start)},
                   {"end_m", listOf(line.line.end)},
                   {"shift_m", listOf(line.shift)},
                   {"std_m", listOf(std, bundle.reliable())},
                   {"redundancy", line.redundancy},
                   {"standardised", line.misfit},
                   {"places", line.places}});
  }
  return all;
}

Json blundersOf(const BundleResult& bundle) {
  Json all = Json::array();
  for (const Blunder& blunder : bundle.blunders) {
    all.push_back({{"kind", blunder.image.empty() ? "control line"
                            : blunder.line        ? "line"
                                                  : "point"},
                   {"feature", blunder.feature},
                   {"image", blunder.image.empty() ? Json() : Json(blunder.image)},
                   {"localised", blunder.localised},
                   {"standardised", blunder.standardised}});
  }
  return all;
}

Json assignmentsOf(const ImageOrientationResult& result) {
  Json all = Json::array();
  for (const LineAssignment& assignment : result.assignments) {
    all.push_back({{"image_line", assignment.image_line},
                   {"control_line", assignment.object_line},
                   {"distance_m", assignment.distance}});
  }
  return all;
}

Json checkOf(const ImageOrientationResult& result) {
  Json json;
  const CheckSummary summary = summaryOf(result.check_points);
  json["count"] = result.check_points.size();
  json["mean_m"] = listOf(summary.mean);
  json["std_m"] = listOf(summary.std);
  json["rmse_m"] = listOf(summary.rmse);
  json["rmse_total_m"] = summary.total;
  json["points"] = Json::array();
  for (const ImageCheckPoint& point : result.check_points) {
    json["points"].push_back({{"point", point.id},
                              {"difference_m", listOf(point.difference)},
                              {"std_m", listOf(point.std, result.bundle.reliable())},
                              {"rays", point.rays}});
  }
  json["not_in_the_images"] = result.missing_points;
  return json;
}

Json residualsOf(const ImageOrientationResult& result) {
  Json all = Json::array();
  for (const ImageResidual& residual : result.bundle.residuals) {
    const ImageMeasurement& m = result.block.measurements[residual.measurement];
    const bool line = m.kind == ImageMeasurement::Kind::line;
    all.push_back({{"image", m.image},
                   {"kind", line ? "line" : "point"},
                   {"feature", m.feature},
                   {"residual_mm", listOf(residual.residual.head(line ? 1 : 2))},
                   {"redundancy", residual.redundancy},
                   {"standardised", residual.standardised},
                   {"used", residual.used}});
  }
  return all;
}

}  // namespace

std::string orientationJson(const ImageOrientationResult& result) {
  const BundleResult& bundle = result.bundle;
  Json json;
  json["format"] = "pcl_als orientation";
  json["version"] = 1;
  json["rotation"] =
      "ground = position + s Rx(omega) Ry(phi) Rz(kappa) (x, y, minus the focal length), image x "
      "to the right, y up";
  json["status"] = nameOf(bundle.status);
  json["message"] = bundle.message;
  json["sigma0"] = bundle.sigma0;
  json["redundancy"] = bundle.redundancy;
  if (!bundle.weakest.empty())
    json["determined_worst"] = {{"name", bundle.weakest}, {"std_m", bundle.weakest_std}};
  json["observations"] = bundle.observations;
  json["unknowns"] = bundle.unknowns;
  json["iterations"] = bundle.iterations;
  json["camera"] = result.block.camera.name;
  json["camera_test"] = {{"order", {"focal_length", "principal_point_x", "principal_point_y"}},
                         {"indicated_correction_mm", listOf(bundle.interior)},
                         {"std_mm", listOf(bundle.interior_std)}};
  json["images"] = imagesOf(bundle);
  json["points"] = pointsOf(bundle);
  json["lines"] = linesOf(bundle);
  json["blunders"] = blundersOf(bundle);
  json["assigned_lines"] = assignmentsOf(result);
  json["lines_without_control"] = result.unknown_lines;
  json["check_points"] = checkOf(result);
  json["residuals"] = residualsOf(result);
  json["warnings"] = bundle.warnings;
  json["tool_version"] = PCL_ALS_VERSION;
  return json.dump(1) + "\n";
}

void writeOrientation(const std::filesystem::path& path, const ImageOrientationResult& result) {
  writeFile(path, orientationJson(result));
}

}  // namespace pcl_als
