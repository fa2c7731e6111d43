// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "bundle_problem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include <Eigen/Geometry>
#include <ceres/autodiff_cost_function.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/linear_solvers.h>
#include <pcl_als/common/number_text.h>

#include "block_check.h"

namespace pcl_als::photogrammetry {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kExpansion = 0.01;  ///< of the length of a line: standard deviation along it

/// Inverse of the lower Cholesky factor.
template <int N>
Eigen::Matrix<double, N, N> whitening(const Eigen::Matrix<double, N, N>& covariance) {
  const Eigen::LLT<Eigen::Matrix<double, N, N>> factor(covariance);
  return factor.matrixL().solve(Eigen::Matrix<double, N, N>::Identity());
}

template <typename Cost, int... Sizes>
std::shared_ptr<const ceres::CostFunction> costOf(Cost cost) {
  return std::make_shared<ceres::AutoDiffCostFunction<Cost, Sizes...>>(new Cost(std::move(cost)));
}

Vector3d middleOf(const ImageBlock& block) {
  Vector3d sum = Vector3d::Zero();
  for (const ImageOrientation& image : block.images) sum += image.position;
  return (sum / static_cast<double>(block.images.size())).array().round();
}

}  // namespace

Observation::Linear Observation::linearised(const double* image_values,
                                            const double* feature_values) const {
  const auto& sizes = cost->parameter_block_sizes();
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<RowMajor> jacobians;
  std::vector<double*> targets;
  for (const int size : sizes) jacobians.emplace_back(rows(), size);
  for (RowMajor& jacobian : jacobians) targets.push_back(jacobian.data());
  std::vector<const double*> values;
  if (image != kNone) values.push_back(image_values);
  if (feature != kNone) values.push_back(feature_values);
  Linear linear;
  linear.residual.resize(rows());
  cost->Evaluate(values.data(), linear.residual.data(), targets.data());
  if (image != kNone) linear.image = jacobians.front();
  if (feature != kNone) linear.feature = jacobians.back();
  return linear;
}

BundleProblem::BundleProblem(const ImageBlock& given, LineFormulation with)
    : block(given), formulation(with) {
  if (block.images.size() < 2)
    throw InputError("a block needs at least two images; there is " +
                     counted(block.images.size(), "image"));
  checkDirections(block);
  origin = middleOf(block);
  addImages();
  addMeasurements();
  addControl();
  startPoints();
  dropWeakFeatures();
}

void BundleProblem::addImages() {
  constexpr double kFree = 1e6;  // metres or radians: of what has no standard deviation
  for (std::size_t i = 0; i < block.images.size(); ++i) {
    const ImageOrientation& given = block.images[i];
    ImageVector values;
    values << given.position - origin, given.angles;
    images.push_back(values);
    if (given.position_sigma <= 0.0 && given.angle_sigma <= 0.0) continue;
    GivenCost<6> cost{values, Matrix6d::Identity()};
    const double position = given.position_sigma > 0.0 ? given.position_sigma : kFree;
    const double angle = given.angle_sigma > 0.0 ? given.angle_sigma : kFree;
    cost.root.topLeftCorner<3, 3>() /= position;
    cost.root.bottomRightCorner<3, 3>() /= angle;
    Observation prior;
    prior.image = i;
    prior.cost = costOf<GivenCost<6>, 6, 6>(cost);
    observations.push_back(prior);
  }
}

void BundleProblem::addMeasurements() {
  std::unordered_map<std::string, std::size_t> image_of, line_of;
  for (std::size_t i = 0; i < block.images.size(); ++i) image_of[block.images[i].id] = i;
  for (std::size_t i = 0; i < block.lines.size(); ++i) line_of[block.lines[i].id] = i;
  std::map<std::pair<bool, std::string>, std::size_t> feature_of;
  std::size_t lines = 0;
  for (std::size_t m = 0; m < block.measurements.size(); ++m) {
    const ImageMeasurement& measured = block.measurements[m];
    const auto image = image_of.find(measured.image);
    if (image == image_of.end())
      throw InputError("image " + measured.image + " has measurements and no orientation");
    const bool line = measured.kind == ImageMeasurement::Kind::line;
    const auto known = line ? line_of.find(measured.feature) : line_of.end();
    if (line && known == line_of.end()) continue;  // a line that is not in the control
    const auto [entry, added] =
        feature_of.emplace(std::pair(line, measured.feature), features.size());
    if (added) {
      Feature feature;
      feature.id = measured.feature;
      feature.line = line;
      feature.given = line ? known->second : 0;
      const int size = !line ? 3 : formulation == LineFormulation::coplanarity ? 4 : 6;
      feature.unknown = Eigen::VectorXd::Zero(size);
      features.push_back(std::move(feature));
      if (line) ++lines;
    }
    addPlace(m, image->second, entry->second);
  }
  if (lines == 0 && std::none_of(observations.begin(), observations.end(),
                                 [](const Observation& o) { return o.isPrior(); }))
    throw InputError(
        "no line that is measured in the images is among the lines of the control, which are found "
        "by name, or by position where that is asked for");
}

void BundleProblem::addPlace(std::size_t measurement, std::size_t image, std::size_t feature) {
  const Vector2d place = reduced(measurement);
  const double f = block.camera.focal_length, sigma = block.measurements[measurement].sigma;
  Observation o;
  o.image = image;
  o.feature = feature;
  o.measurement = measurement;
  if (!features[feature].line) {
    o.cost = costOf<PointCost, 2, 6, 3>(PointCost{place, f, sigma});
  } else if (formulation == LineFormulation::coplanarity) {
    o.cost = costOf<CoplanarityCost, 1, 6, 4>(
        CoplanarityCost{place, f, sigma, frameOf(features[feature])});
  } else {
    o.cost = costOf<LineEndCost, 1, 6, 6>(LineEndCost{place, f, sigma, frameOf(features[feature])});
  }
  observations.push_back(o);
}

void BundleProblem::addControl() {
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!features[f].line) continue;
    const ObjectLine& line = block.lines[features[f].given];
    Observation o;
    o.feature = f;
    if (formulation == LineFormulation::coplanarity) {
      o.cost = costOf<GivenCost<4>, 4, 4>(
          GivenCost<4>{Eigen::Vector4d::Zero(), whitening<4>(line.covariance)});
    } else {
      // The covariance of the ends in space, expanded along the line. The images do not observe the
      // ends along the line: any expansion that is small against its length gives the same result.
      const LineFrame frame = frameOf(features[f]);
      const Vector3d along = (line.end - line.start).normalized();
      Eigen::Matrix<double, 6, 4> across = Eigen::Matrix<double, 6, 4>::Zero();
      across.topLeftCorner<3, 2>() = frame.across;
      across.bottomRightCorner<3, 2>() = frame.across;
      Matrix6d covariance = across * line.covariance * across.transpose();
      const Matrix3d expansion =
          std::pow(kExpansion * line.length(), 2) * along * along.transpose();
      covariance.topLeftCorner<3, 3>() += expansion;
      covariance.bottomRightCorner<3, 3>() += expansion;
      o.cost =
          costOf<GivenCost<6>, 6, 6>(GivenCost<6>{ImageVector::Zero(), whitening<6>(covariance)});
    }
    observations.push_back(o);
  }
}

Vector3d BundleProblem::started(const std::vector<const Observation*>& rays, double height) const {
  Matrix3d normal = Matrix3d::Zero();
  Vector3d right = Vector3d::Zero();
  Vector3d fallback = Vector3d::Zero();
  for (const Observation* o : rays) {
    const ImageVector& image = images[o->image];
    const Vector2d place = reduced(o->measurement);
    const Vector3d ray = (groundFromImage(image.data() + 3) *
                          Vector3d(place.x(), place.y(), -block.camera.focal_length))
                             .normalized();
    const Matrix3d across = Matrix3d::Identity() - ray * ray.transpose();
    normal += across;
    right += across * image.head<3>();
    const double down = std::min(ray.z(), -0.1);
    fallback +=
        (image.head<3>() + ray * ((height - image.z()) / down)) / static_cast<double>(rays.size());
  }
  const Vector3d crossing = solveSymmetric(normal, right);
  for (const Observation* o : rays) {
    // Behind the image, or beyond where rays that are nearly parallel would meet.
    const double depth = -inImage(images[o->image].data(), crossing).z();
    const double expected = images[o->image].z() - height;
    if (!crossing.allFinite() || depth < 0.2 * expected || depth > 5.0 * expected) return fallback;
  }
  return crossing;
}

void BundleProblem::startPoints() {
  std::vector<std::vector<const Observation*>> rays(features.size());
  double height = 0.0;
  std::size_t lines = 0;
  for (const Feature& feature : features) {
    if (!feature.line) continue;
    height += block.lines[feature.given].start.z() - origin.z();
    ++lines;
  }
  height = lines > 0 ? height / static_cast<double>(lines) : -1000.0;
  for (const Observation& o : observations) {
    if (!o.isControl() && !o.isPrior() && !features[o.feature].line) rays[o.feature].push_back(&o);
  }
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!features[f].line) features[f].unknown = started(rays[f], height);
  }
}

void BundleProblem::dropWeakFeatures() {
  std::vector<std::size_t> places(features.size(), 0);
  std::vector<bool> controlled(features.size(), false);
  for (const Observation& o : observations) {
    if (!o.used || o.isPrior()) continue;
    if (o.isControl()) controlled[o.feature] = true;
    if (!o.isControl()) ++places[o.feature];
  }
  for (std::size_t f = 0; f < features.size(); ++f) {
    const bool enough = features[f].line ? controlled[f] && places[f] > 0 : places[f] >= 2;
    features[f].used = features[f].used && enough;
  }
}

Vector2d BundleProblem::reduced(std::size_t measurement) const {
  return block.camera.reduced(block.measurements[measurement].position);
}

LineFrame BundleProblem::frameOf(const Feature& feature) const {
  const ObjectLine& line = block.lines[feature.given];
  return {line.start - origin, line.end - origin, acrossLine(line.end - line.start)};
}

std::pair<Vector3d, Vector3d> BundleProblem::endsOf(const Feature& feature) const {
  const LineFrame frame = frameOf(feature);
  if (feature.unknown.size() == 6)
    return {frame.start + feature.unknown.head<3>(), frame.end + feature.unknown.tail<3>()};
  return {frame.moved(frame.start, feature.unknown.data()),
          frame.moved(frame.end, feature.unknown.data() + 2)};
}

Observation::Linear BundleProblem::linearised(const Observation& o) const {
  return o.linearised(
      o.image == Observation::kNone ? nullptr : images[o.image].data(),
      o.feature == Observation::kNone ? nullptr : features[o.feature].unknown.data());
}

}  // namespace pcl_als::photogrammetry
