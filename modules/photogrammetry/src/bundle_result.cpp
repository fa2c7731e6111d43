// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "bundle_result.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "data_snooping.h"

namespace pcl_als::photogrammetry {
namespace {

/// Above this the residuals contradict the stated standard deviations of the whole block.
constexpr double kLargestSigma0 = 5.0;
/// A larger share of control lines that contradict the images shows that the block is wrong, not
/// they.
constexpr double kLargestWrongShare = 0.25;
/// A correction of the camera this many times its standard deviation is stated.
constexpr double kSignificant = 5.0;
/// Beyond this multiple the camera is wrong.
constexpr double kContradicting = 10.0;
/// Corrections of the focal length by one linear step that are a larger share of it are no values.
constexpr double kLinear = 0.25;
/// Scalar conditions that an image needs at least: six, and one more to control them.
constexpr std::size_t kLeastConditions = 7;

/// Sums of the adjustment: v'Pv, observations, unknowns.
void addSums(const BundleProblem& problem, BundleResult& result) {
  double sum = 0.0;
  for (const Observation& o : problem.observations) {
    if (!problem.inUse(o)) continue;
    sum += problem.linearised(o).residual.squaredNorm();
    result.observations += static_cast<std::size_t>(o.rows());
  }
  result.unknowns = 6 * problem.images.size();
  for (const Feature& feature : problem.features)
    if (feature.used) result.unknowns += static_cast<std::size_t>(feature.unknown.size());
  result.redundancy =
      static_cast<double>(result.observations) - static_cast<double>(result.unknowns);
  result.sigma0 = result.redundancy > 0.0 ? std::sqrt(sum / result.redundancy) : 0.0;
}

void addImages(const BundleProblem& problem, BundleResult& result) {
  for (std::size_t i = 0; i < problem.images.size(); ++i) {
    OrientedImage& image = result.images.emplace_back();
    image.orientation = problem.block.images[i];
    image.orientation.position = problem.origin + problem.images[i].head<3>();
    image.orientation.angles = problem.images[i].tail<3>();
  }
}

void addFeatures(const BundleProblem& problem, BundleResult& result) {
  std::vector<std::size_t> places(problem.features.size(), 0);
  for (const Observation& o : problem.observations)
    if (problem.inUse(o) && o.measurement != Observation::kNone) ++places[o.feature];
  for (std::size_t f = 0; f < problem.features.size(); ++f) {
    const Feature& feature = problem.features[f];
    if (!feature.line) {
      if (!feature.used) continue;
      GroundPoint& point = result.points.emplace_back();
      point.id = feature.id;
      point.position = problem.origin + feature.unknown;
      point.rays = places[f];
      continue;
    }
    AdjustedLine& line = result.lines.emplace_back();
    line.line = problem.block.lines[feature.given];
    line.used = feature.used;
    line.places = places[f];
    if (!feature.used) continue;
    const auto [start, end] = problem.endsOf(feature);
    const LineFrame frame = problem.frameOf(feature);
    line.shift << frame.across.transpose() * (start - frame.start),
        frame.across.transpose() * (end - frame.end);
    line.line.start += frame.across * line.shift.head<2>();
    line.line.end += frame.across * line.shift.tail<2>();
  }
}

/// Projects the covariance of a line's unknowns to the offsets across.
Eigen::Matrix4d acrossCovariance(const BundleProblem& problem, const Feature& feature,
                                 const Eigen::MatrixXd& covariance) {
  if (covariance.rows() == 4) return covariance;
  const LineFrame frame = problem.frameOf(feature);
  Eigen::Matrix<double, 6, 4> across = Eigen::Matrix<double, 6, 4>::Zero();
  across.topLeftCorner<3, 2>() = frame.across;
  across.bottomRightCorner<3, 2>() = frame.across;
  return across.transpose() * covariance * across;
}

void addCovariances(const BundleProblem& problem, const BundleNormal& normal,
                    BundleResult& result) {
  const double factor = std::pow(std::max(1.0, result.sigma0), 2);
  for (std::size_t i = 0; i < result.images.size(); ++i)
    result.images[i].covariance = factor * normal.imageCovariance(i);
  std::size_t point = 0, line = 0;
  for (std::size_t f = 0; f < problem.features.size(); ++f) {
    const Feature& feature = problem.features[f];
    if (feature.line && !feature.used) ++line;
    if (!feature.used) continue;
    const Eigen::MatrixXd covariance = factor * normal.featureCovariance(f);
    if (feature.line) {
      result.lines[line++].line.covariance = acrossCovariance(problem, feature, covariance);
    } else {
      result.points[point++].covariance = covariance;
    }
  }
}

/// Index of the lines of the result by feature.
std::vector<std::size_t> lineIndex(const BundleProblem& problem) {
  std::vector<std::size_t> index(problem.features.size(), 0);
  std::size_t next = 0;
  for (std::size_t f = 0; f < problem.features.size(); ++f)
    if (problem.features[f].line) index[f] = next++;
  return index;
}

void addResiduals(const BundleProblem& problem, const BundleNormal& normal, bool tested,
                  BundleResult& result) {
  const std::vector<std::size_t> line_of = lineIndex(problem);
  std::vector<double> squares(problem.images.size(), 0.0);
  for (const Observation& o : problem.observations) {
    const bool used = problem.inUse(o);
    const Observation::Linear linear = problem.linearised(o);
    const TestValue test = used && tested ? testOf(o, linear, normal) : TestValue{};
    if (o.isControl()) {
      AdjustedLine& line = result.lines[line_of[o.feature]];
      line.redundancy = test.redundancy;
      line.misfit = test.size;
    }
    if (o.measurement == Observation::kNone) continue;
    ImageResidual& residual = result.residuals.emplace_back();
    residual.measurement = o.measurement;
    residual.residual.head(o.rows()) =
        problem.block.measurements[o.measurement].sigma * linear.residual;
    residual.redundancy = test.redundancy;
    residual.standardised = test.size;
    residual.used = used;
    if (!used) continue;
    OrientedImage& image = result.images[o.image];
    ++(problem.features[o.feature].line ? image.lines : image.points);
    squares[o.image] += residual.residual.squaredNorm() / o.rows();
  }
  for (std::size_t i = 0; i < result.images.size(); ++i) {
    const auto count = static_cast<double>(result.images[i].points + result.images[i].lines);
    if (count > 0.0) result.images[i].rms = std::sqrt(squares[i] / count);
  }
}

/// States the focal length that the residuals indicate.
std::string focalLengthText(const BundleResult& result, const FrameCamera& camera) {
  // The correction is that of one linear step.
  if (std::abs(result.interior[0]) > kLinear * camera.focal_length)
    return "the residuals indicate a focal length far from that of the camera file";
  char text[240];
  std::snprintf(text, sizeof text,
                "the residuals indicate a focal length that differs by %+.3f mm (standard "
                "deviation %.3f mm) from that of the camera file",
                result.interior[0], result.interior_std[0]);
  return text;
}

/// States a camera that does not fit, and residuals that are too large.
void judge(const BundleProblem& problem, const BundleNormal& normal, BundleResult& result) {
  const auto [correction, covariance] = normal.interior();
  result.interior = correction;
  result.interior_std =
      std::max(1.0, result.sigma0) * covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  char text[240];
  std::string camera;
  const double share = std::abs(correction[0]) / result.interior_std[0];
  if (std::isfinite(share) && share > kSignificant) {
    camera = focalLengthText(result, problem.block.camera);
    result.warnings.push_back(camera);
  }
  const auto wrong =
      static_cast<std::size_t>(std::count_if(result.lines.begin(), result.lines.end(),
                                             [](const AdjustedLine& line) { return !line.used; }));
  std::string reason;
  if (result.sigma0 > kLargestSigma0) {
    std::snprintf(
        text, sizeof text,
        "the residuals are %.1f times as large as the standard deviations of measurements "
        "and lines allow",
        result.sigma0);
    reason = text;
  } else if (static_cast<double>(wrong) >
             kLargestWrongShare * static_cast<double>(result.lines.size())) {
    reason = std::to_string(wrong) + " of " + std::to_string(result.lines.size()) +
             " control lines contradict the images";
  }
  if (reason.empty() && std::isfinite(share) && share > kContradicting)
    reason = "the focal length contradicts the lines";
  if (reason.empty()) return;
  result.status = BundleResult::Status::not_determined;
  result.message = reason + ": the camera, the unit of the coordinates or the lines are wrong";
  if (!camera.empty()) result.message += "; " + camera;
}

}  // namespace

std::string tooFewMeasurements(const BundleProblem& problem) {
  std::vector<std::size_t> conditions(problem.images.size(), 0);
  for (const Observation& o : problem.observations) {
    if (!problem.inUse(o) || o.isControl()) continue;
    conditions[o.image] += static_cast<std::size_t>(o.rows());
  }
  std::string names;
  std::size_t count = 0;
  for (std::size_t i = 0; i < conditions.size(); ++i) {
    if (conditions[i] >= kLeastConditions) continue;
    if (++count <= 5) names += (names.empty() ? "" : ", ") + problem.block.images[i].id;
  }
  if (count == 0) return {};
  return "too few measurements of points and lines that are seen elsewhere too, in " +
         std::to_string(count) + (count == 1 ? " image: " : " images: ") + names +
         (count > 5 ? ", ..." : "");
}

void describe(const BundleProblem& problem, const BundleNormal& normal, bool inverted,
              BundleResult& result) {
  addSums(problem, result);
  addImages(problem, result);
  addFeatures(problem, result);
  if (inverted) addCovariances(problem, normal, result);
  addResiduals(problem, normal, inverted, result);
  if (inverted) judge(problem, normal, result);
}

}  // namespace pcl_als::photogrammetry
