// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Core>

namespace pcl_als {

/** \brief Products and triangular factors of dense matrices, in place.
 *
 * They stand in a library of their own, which is built twice: the loader of glibc takes the one for
 * AVX2 and FMA where the processor has them (folder glibc-hwcaps/x86-64-v3), which is three times
 * as fast. Arguments are views, because matrices that one library allocates cannot be freed by one
 * of another alignment. Results of the two differ by rounding, and do not depend on anything else.
 */
namespace dense {

using View = Eigen::Ref<Eigen::MatrixXd>;
using ConstView = Eigen::Ref<const Eigen::MatrixXd>;

/// The lower triangle of \a matrix becomes its Cholesky factor. \return whether it is positive
/// definite
bool factorise(View matrix);
/// right = L^-1 right, for a lower triangular matrix L.
void solveLower(const ConstView& lower, View right);
/// left = left L^-T.
void solveLowerFromRight(const ConstView& lower, View left);
/// The lower triangle of \a sum += a a'.
void addSquare(const ConstView& a, View sum);
/// result = a b
void multiply(const ConstView& a, const ConstView& b, View result);
/// sum += a' b
void addTransposedProduct(const ConstView& a, const ConstView& b, View sum);

}  // namespace dense
}  // namespace pcl_als
