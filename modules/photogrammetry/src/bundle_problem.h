// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <ceres/cost_function.h>

#include <pcl_als/photogrammetry/bundle_adjustment.h>

#include "bundle_costs.h"

namespace pcl_als::photogrammetry {

/// A point (3 unknowns) or a line (4 or 6).
struct Feature {
  std::string id;
  bool line = false;
  std::size_t given = 0;    ///< index in ImageBlock::lines of a line
  Eigen::VectorXd unknown;  ///< a point's position; a line's offsets
  bool used = true;         ///< false: too few observations remain
};

/// One observation of up to two parameter blocks: image, feature.
struct Observation {
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::shared_ptr<const ceres::CostFunction> cost;
  std::size_t image = kNone, feature = kNone;
  std::size_t measurement = kNone;  ///< none: control of a line, or orientation of an image
  bool used = true;

  bool isControl() const { return image == kNone; }
  bool isPrior() const { return feature == kNone; }
  int rows() const { return cost->num_residuals(); }

  /// Residuals, and where wanted their derivatives by image and feature.
  struct Linear {
    Eigen::VectorXd residual;
    Eigen::MatrixXd image, feature;
  };
  Linear linearised(const double* image_values, const double* feature_values) const;
};

using ImageVector = Eigen::Matrix<double, 6, 1>;

/** \brief Unknowns and observations of a block, relative to an origin in its middle. */
class BundleProblem {
 public:
  BundleProblem(const ImageBlock& block, LineFormulation formulation);

  const ImageBlock& block;
  LineFormulation formulation;
  Eigen::Vector3d origin;
  std::vector<ImageVector> images;
  std::vector<Feature> features;
  std::vector<Observation> observations;

  /// Whether an observation and what it refers to are in use.
  bool inUse(const Observation& o) const {
    return o.used && (o.feature == Observation::kNone || features[o.feature].used);
  }
  Observation::Linear linearised(const Observation& o) const;
  /// Takes features out of use that are determined by too few observations.
  void dropWeakFeatures();
  /// Reduced coordinates of a measurement, mm.
  Eigen::Vector2d reduced(std::size_t measurement) const;
  LineFrame frameOf(const Feature& line) const;
  /// Ends of a line, relative to the origin.
  std::pair<Eigen::Vector3d, Eigen::Vector3d> endsOf(const Feature& line) const;

 private:
  void addImages();
  void addMeasurements();
  void addPlace(std::size_t measurement, std::size_t image, std::size_t feature);
  void addControl();
  void startPoints();
  Eigen::Vector3d started(const std::vector<const Observation*>& rays, double height) const;
};

}  // namespace pcl_als::photogrammetry
