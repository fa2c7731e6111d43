// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

#include "image_geometry.h"

namespace pcl_als::photogrammetry {

// Residuals over their standard deviations. Image: position (m), angles (rad). Ground coordinates
// are relative to the origin of the block.

/// Collinearity of a point; residual measured - projected (2).
struct PointCost {
  Eigen::Vector2d place;  ///< reduced, mm
  double focal_length, sigma;

  template <typename T>
  bool operator()(const T* image, const T* point, T* residual) const {
    const Eigen::Matrix<T, 3, 1> ground(point[0], point[1], point[2]);
    const Eigen::Matrix<T, 2, 1> at = projected(inImage(image, ground), focal_length);
    residual[0] = (place[0] - at[0]) / sigma;
    residual[1] = (place[1] - at[1]) / sigma;
    return true;
  }
};

/// Ends of a line as given, and the directions of its unknown offsets (3x2).
struct LineFrame {
  Eigen::Vector3d start, end;
  Eigen::Matrix<double, 3, 2> across;

  template <typename T>
  Eigen::Matrix<T, 3, 1> moved(const Eigen::Vector3d& from, const T* offset) const {
    Eigen::Matrix<T, 3, 1> place;
    for (int i = 0; i < 3; ++i)
      place[i] = from[i] + across(i, 0) * offset[0] + across(i, 1) * offset[1];
    return place;
  }
};

/// Coplanarity of an image ray and an object line whose unknowns are offsets across (4).
struct CoplanarityCost {
  Eigen::Vector2d place;
  double focal_length, sigma;
  LineFrame line;

  template <typename T>
  bool operator()(const T* image, const T* offsets, T* residual) const {
    const Eigen::Matrix<T, 3, 1> a = inImage(image, line.moved(line.start, offsets));
    const Eigen::Matrix<T, 3, 1> b = inImage(image, line.moved(line.end, offsets + 2));
    residual[0] = distanceFromLine(planeOf(a, b), place, focal_length) / sigma;
    return true;
  }
};

/// Collinearity with an end of the line, which need not be where the place was measured: the weight
/// matrix in the image is reduced to the direction n across the image of the line, P' = n n' /
/// sigma^2. Unknowns are the offsets of both ends in space (6).
struct LineEndCost {
  Eigen::Vector2d place;
  double focal_length, sigma;
  LineFrame line;

  template <typename T>
  bool operator()(const T* image, const T* offsets, T* residual) const {
    using std::sqrt;
    Eigen::Matrix<T, 3, 1> start, end;
    for (int i = 0; i < 3; ++i) {
      start[i] = line.start[i] + offsets[i];
      end[i] = line.end[i] + offsets[i + 3];
    }
    const Eigen::Matrix<T, 2, 1> at = projected(inImage(image, start), focal_length);
    const Eigen::Matrix<T, 2, 1> along = projected(inImage(image, end), focal_length) - at;
    const T length = sqrt(along[0] * along[0] + along[1] * along[1]);
    residual[0] =
        (along[1] * (place[0] - at[0]) - along[0] * (place[1] - at[1])) / (length * sigma);
    return true;
  }
};

/// Given values (N) with the inverse of the Cholesky factor of their covariance.
template <int N>
struct GivenCost {
  Eigen::Matrix<double, N, 1> value;
  Eigen::Matrix<double, N, N> root;  ///< lower triangular, L^-1 of covariance = L L'

  template <typename T>
  bool operator()(const T* unknown, T* residual) const {
    for (int row = 0; row < N; ++row) {
      residual[row] = T(0.0);
      for (int i = 0; i < N; ++i) residual[row] += root(row, i) * (unknown[i] - value[i]);
    }
    return true;
  }
};

}  // namespace pcl_als::photogrammetry
