// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::detail {

/** \brief Which points are ground, by pcl::ApproximateProgressiveMorphologicalFilter (Zhang et al.
 * 2003): openings of the lowest heights with windows up to \a largest_object metres.
 *
 * \param points metres, near the origin (float); \param cell of the filter's grid, metres
 * \return indices, ascending
 */
std::vector<std::size_t> groundPoints(const std::vector<Eigen::Vector3d>& points, double cell,
                                      double largest_object);

}  // namespace pcl_als::detail
