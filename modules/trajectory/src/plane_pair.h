// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <optional>

#include <Eigen/Core>

#include <pcl_als/trajectory/scanner_detection.h>

namespace pcl_als {

/// The monomials of a quadratic form: xx yy zz xy xz yz.
Eigen::Matrix<double, 6, 1> quadraticMonomials(const Eigen::Vector3d& e);

/** \brief The unit normals of two planes through the origin, one of which contains each pulse of a
 * channel: of two channels that are not recorded.
 *
 * The pulses e satisfy (n1 . e)(n2 . e) = 0, a quadratic form e'Qe whose coefficients are the
 * eigenvector of the least eigenvalue of their sums of products, and whose three eigenvalues are
 * positive, zero and negative: Q = n1 n2' + n2 n1'. Nothing where the pulses do not lie in two
 * planes, or in planes less than \a least_angle apart (radians), or where one has few of them.
 * \param most_off radians, RMS distance of the pulses from their planes
 */
std::optional<std::array<Eigen::Vector3d, 2>> planePairOf(const ScannerDetection::Channel& channel,
                                                          double least_angle, double most_off);

}  // namespace pcl_als
