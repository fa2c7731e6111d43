// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <Eigen/Cholesky>

#include <pcl_als/adjustment/dense_products.h>

namespace pcl_als::dense {

bool factorise(View matrix) {
  return Eigen::LLT<View>(matrix).info() == Eigen::Success;
}

void solveLower(const ConstView& lower, View right) {
  lower.triangularView<Eigen::Lower>().solveInPlace(right);
}

void solveLowerFromRight(const ConstView& lower, View left) {
  lower.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(left);
}

void addSquare(const ConstView& a, View sum) {
  sum.selfadjointView<Eigen::Lower>().rankUpdate(a);
}

void multiply(const ConstView& a, const ConstView& b, View result) {
  result.noalias() = a * b;
}

void addTransposedProduct(const ConstView& a, const ConstView& b, View sum) {
  sum.noalias() += a.transpose() * b;
}

}  // namespace pcl_als::dense
