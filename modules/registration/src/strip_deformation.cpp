// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "strip_deformation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <pcl_als/adjustment/clustered_regression.h>
#include <pcl_als/adjustment/overlap_variation.h>
#include <pcl_als/adjustment/robust_weight.h>
#include <pcl_als/common/linear_solvers.h>

namespace pcl_als::registration {
namespace {

constexpr std::size_t kEnoughPairs = 20'000;
// Variances: the motion of a whole overlap differs from that of the next one of the same size by
// twice as much as those of its halves, of which the mean square over the overlap is a third.
constexpr double kNextOverlap = 2.0;

/// Three functions of the place, of which the residuals may contain multiples.
struct Shape {
  Eigen::Vector3d (*effect)(const Eigen::Vector2d& at, const Eigen::Vector3d& normal);
  /// Products by which mean squares of the unknowns follow from the three coefficients.
  void (*moments)(const Eigen::Vector2d& at, Eigen::Matrix3d (&of_unknown)[6]);
};

void addSquare(const Eigen::Vector3d& vector, Eigen::Matrix3d& moments) {
  moments += vector * vector.transpose();
}

/// Heights c . (x^2, x y, y^2): the slope along y is a rotation about x.
const Shape kBend{[](const Eigen::Vector2d& at, const Eigen::Vector3d& normal) {
                    return Eigen::Vector3d(normal.z() * at.x() * at.x(),
                                           normal.z() * at.x() * at.y(),
                                           normal.z() * at.y() * at.y());
                  },
                  [](const Eigen::Vector2d& at, Eigen::Matrix3d (&of_unknown)[6]) {
                    addSquare({at.x() * at.x(), at.x() * at.y(), at.y() * at.y()}, of_unknown[2]);
                    addSquare({0.0, at.x(), 2.0 * at.y()}, of_unknown[3]);
                    addSquare({2.0 * at.x(), at.y(), 0.0}, of_unknown[4]);
                  }};

/// Displacements (c0 x + c2 y, c2 x + c1 y).
const Shape kStrain{[](const Eigen::Vector2d& at, const Eigen::Vector3d& normal) {
                      return Eigen::Vector3d(normal.x() * at.x(), normal.y() * at.y(),
                                             normal.x() * at.y() + normal.y() * at.x());
                    },
                    [](const Eigen::Vector2d& at, Eigen::Matrix3d (&of_unknown)[6]) {
                      addSquare({at.x(), 0.0, at.y()}, of_unknown[0]);
                      addSquare({0.0, at.y(), at.x()}, of_unknown[1]);
                      addSquare({0.0, 0.0, 1.0}, of_unknown[5]);
                    }};

/// The pairs that the adjustment does not reject, in units of the frame.
struct Sample {
  std::vector<const PatchPair*> pairs;
  std::vector<double> weights;
};

Sample sampleOf(const PatchPairs& pairs, const ScatterBySlope& scatter) {
  Sample sample;
  const std::size_t stride = 1 + pairs.size() / kEnoughPairs;
  for (std::size_t i = 0; i < pairs.size(); i += stride) {
    const double sigma = scatter.sigmaOf(pairs[i]);
    const double weight = RobustWeight()(pairs[i].distance, sigma);
    if (weight == 0.0) continue;
    sample.pairs.push_back(&pairs[i]);
    sample.weights.push_back(std::sqrt(weight) / sigma);
  }
  return sample;
}

/// Adds the mean squares of a shape, where it is significant.
void addShape(const Shape& shape, const Sample& sample, const AdjustmentFrame& frame,
              const Directions& directions, Unknowns& squares) {
  const auto n = static_cast<Eigen::Index>(sample.pairs.size());
  const Eigen::MatrixXd basis = directions.basis();
  Eigen::MatrixXd rigid(n, basis.cols()), effects(n, 3);
  Eigen::VectorXd values(n);
  Eigen::Matrix3d moments[6];
  for (Eigen::Matrix3d& of_unknown : moments) of_unknown.setZero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const PatchPair& pair = *sample.pairs[static_cast<std::size_t>(i)];
    const double weight = sample.weights[static_cast<std::size_t>(i)];
    const Eigen::Vector2d at = (pair.position - frame.centre).head<2>() / frame.radius;
    rigid.row(i) = weight * (basis.transpose() * frame.rowOf(pair)).transpose();
    effects.row(i) = weight * shape.effect(at, pair.normal).transpose();
    values[i] = weight * pair.distance;
    shape.moments(at, moments);
  }
  // What the motion does not explain, of the effects as of the distances.
  const Eigen::MatrixXd inverse = inverseOrEmpty(rigid.transpose() * rigid);
  if (inverse.size() == 0) return;
  effects -= rigid * (inverse * (rigid.transpose() * effects));
  values -= rigid * (inverse * (rigid.transpose() * values));
  ClusteredRegression regression(3);
  for (Eigen::Index i = 0; i < n; ++i) {
    const PatchPair& pair = *sample.pairs[static_cast<std::size_t>(i)];
    const double weight = sample.weights[static_cast<std::size_t>(i)];
    regression.add(pair.group, effects.row(i).transpose(), values[i], pair.position.head<2>(),
                   weight * pair.normal);
  }
  const ClusteredRegression::Result fit = regression.solve();
  if (!fit.determined) return;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix3d mean = moments[i] / static_cast<double>(n);
    const double square = significantMeanSquare(fit.estimate, fit.covariance, mean);
    squares[i] += kNextOverlap * std::max(0.0, square - (mean * fit.covariance).trace());
  }
}

}  // namespace

Unknowns deformationOf(const PatchPairs& pairs, const AdjustmentFrame& frame,
                       const ScatterBySlope& scatter, const Directions& directions) {
  Unknowns squares = Unknowns::Zero();
  if (directions.strong() == 0) return squares;
  const Sample sample = sampleOf(pairs, scatter);
  for (const Shape* shape : {&kBend, &kStrain})
    addShape(*shape, sample, frame, directions, squares);
  return squares;
}

}  // namespace pcl_als::registration
