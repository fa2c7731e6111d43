// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/common/point_types.h>

namespace pcl_als::bench {

using Cloud = pcl::PointCloud<PointLidar>;

/// What a method made of a pair.
struct Alignment {
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();  ///< source to target
  double seconds = 0.0;
  double megabytes = 0.0;  ///< at most in memory beyond the clouds themselves
  bool converged = false;
  double std[6] = {};  ///< XT, YT, ZT (m), omega, phi, kappa (rad) as reported; 0: none
};

struct AlignmentMethod {
  std::string name;
  std::function<Alignment(const Cloud::ConstPtr& source, const Cloud::ConstPtr& target)> align;
};

/// IterativeClosestPatch, PCL's registrations and, where they were found, small_gicp (headers) and
/// simpleICP (\a simpleicp: its program; empty: left out). \a filter: only names that contain it.
std::vector<AlignmentMethod> alignmentMethods(int threads, const std::string& simpleicp,
                                              const std::string& filter);

/** \brief Runs a method in a process of its own, so that what it takes of memory is its own, and
 * what it leaves in the heap does not help the next one. */
Alignment runAlone(const AlignmentMethod& method, const Cloud::ConstPtr& source,
                   const Cloud::ConstPtr& target);

}  // namespace pcl_als::bench
