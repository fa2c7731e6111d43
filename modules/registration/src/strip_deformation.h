// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include "patch_adjustment.h"

namespace pcl_als::registration {

/** \brief How much the motion varies over the overlap because the strips are not rigid: mean
 * squares of the unknowns over the places of the pairs, square metres.
 *
 * What remains after the adjustment is tested for polynomials of the next degree (95 % of the
 * chi-squared distribution, with a covariance that allows for errors of neighbours): heights that
 * are bent (x^2, x y, y^2), and strain in plan (extension and shear). A bend is a rotation about
 * the axes in plan that varies, and a height; strain is a shift in plan that varies, and a shear is
 * a rotation about the vertical that the directions of the strips do not share.
 */
Unknowns deformationOf(const PatchPairs& pairs, const AdjustmentFrame& frame,
                       const ScatterBySlope& scatter, const Directions& directions);

}  // namespace pcl_als::registration
