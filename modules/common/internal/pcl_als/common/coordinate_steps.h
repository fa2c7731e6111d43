// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// So many points of a file or of a strip show the steps of their coordinates.
inline constexpr std::size_t kEnoughForSteps = 20'000;

/** \brief The steps to which coordinates are rounded, metres by axis; zero where the points do not
 * show them.
 *
 * Coordinates may be coarser than the scale of their file: they passed single precision (0.5 m in a
 * northing of UTM) or a file with a larger scale. Values of rounded coordinates repeat: each occurs
 * twice or more on average. The distances between neighbouring distinct values are the step or a
 * small multiple of it, so that their median is at most three times the 5 % quantile; without
 * rounding they are distributed exponentially, where it is 13 times as large.
 */
Eigen::Vector3d coordinateSteps(const std::vector<Eigen::Vector3d>& points);

/// "0.062 m (east), 0.5 m (north)": the axes in which steps exceed \a limit; empty: none.
std::string describeSteps(const Eigen::Vector3d& steps, const Eigen::Vector3d& limit);

}  // namespace pcl_als
