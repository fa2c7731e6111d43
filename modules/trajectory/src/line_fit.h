// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/survey_types.h>

namespace pcl_als::detail {

/** \brief Plan velocities (m/s) of the least-squares lines through the samples in [t - w, t + w]
 * around each sample of samples[first, last), which has at least two of distinct, rising times.
 *
 * A window with one sample takes its neighbours too. Sums slide with the window relative to an
 * origin inside it that is renewed every few windows, so the cost is linear and the precision does
 * not depend on where or when the flight was.
 */
void fitVelocities(const std::vector<TrajectorySample>& samples, std::size_t first,
                   std::size_t last, double half_width, std::vector<Eigen::Vector2d>& velocities);

}  // namespace pcl_als::detail
