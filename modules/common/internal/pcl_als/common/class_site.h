// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// A place or an area whose class is known: training or check. Metres, ground frame.
struct ClassSite {
  std::string name;                                 ///< of the class
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< of a point
  /// Of an area: closed rings, outer ones and holes alike; inside is what an odd number of them
  /// surround.
  std::vector<std::vector<Eigen::Vector2d>> rings;

  bool isArea() const { return !rings.empty(); }
};

/// A check point with what it is and what it was classified as.
struct CheckedSite {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  std::string reference;
  std::string classified;  ///< empty: the classification gave none
};

}  // namespace pcl_als
