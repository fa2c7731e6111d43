// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <pcl_als/common/system_parameters.h>
#include <pcl_als/trajectory/bias_evaluator.h>
#include <pcl_als/trajectory/trajectory.h>

namespace pcl_als::detail {

/** \brief A delta of Habib et al. 2011, Eq. (8), for points whose times are all in one span.
 *
 * With a = dX + z df - sin(b) dr + z b dS (to the right) and d = dY - z dw + x dk (forward), Eq.
 * (8) reads: east = c a - s d, north = s a + c d, up = dZ - x df - cos(b) dr - x b dS.
 */
void biasKernel(const FlightSpan& span, const SystemVector& biases, const PointColumns& points,
                std::size_t count, const EffectColumns& effect);

}  // namespace pcl_als::detail
