// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace pcl_als::bench {

/// Relative to one origin near both clouds.
using Points = std::vector<Eigen::Vector3f>;

/// What a method made of a pair.
struct Alignment {
  Eigen::Matrix4d motion = Eigen::Matrix4d::Identity();  ///< source to target
  double seconds = 0.0;
  double cpu_seconds = 0.0;  ///< of all threads, with copying the points
  double megabytes = 0.0;    ///< at most in memory beyond the clouds themselves
  bool converged = false;
  double centroid[3] = {};  ///< of the overlap, where the method says it
  double std[6] = {};       ///< XT, YT, ZT (m), omega, phi, kappa (rad) as reported; 0: none
};

struct AlignmentMethod {
  std::string name;
  std::function<Alignment(const Points& source, const Points& target)> align;
};

/// PCL's registrations and, where they were found, small_gicp (a library) and simpleICP (\a
/// simpleicp: its program; empty: left out).
std::vector<AlignmentMethod> otherMethods(int threads, const std::string& simpleicp);

/** \brief Runs a method in a process of its own, so that what it takes of memory is its own, and
 * what it leaves in the heap does not help the next one. */
Alignment runAlone(const AlignmentMethod& method, const Points& source, const Points& target);

}  // namespace pcl_als::bench
