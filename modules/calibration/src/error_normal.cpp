// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "error_normal.h"

namespace pcl_als {

ErrorNormal::ErrorNormal(int unknowns) {
  tg.setZero(unknowns, kGlobal);
  right_t.setZero(unknowns);
}

void ErrorNormal::add(const AreaNormal::Reduced& area, const std::vector<int>& knots) {
  gg += area.matrix.topLeftCorner<kGlobal, kGlobal>();
  right_g += area.right.head<kGlobal>();
  log_determinant += area.log_determinant;
  explained += area.explained;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const auto at_i = kGlobal + static_cast<Eigen::Index>(i) * kKnot;
    tg.middleRows<kKnot>(knots[i] * kKnot) += area.matrix.block<kKnot, kGlobal>(at_i, 0);
    right_t.segment<kKnot>(knots[i] * kKnot) += area.right.segment<kKnot>(at_i);
    for (std::size_t j = 0; j <= i; ++j) {  // knots increase
      const auto at_j = kGlobal + static_cast<Eigen::Index>(j) * kKnot;
      tt.try_emplace({knots[i], knots[j]}, KnotBlocks::mapped_type::Zero()).first->second +=
          area.matrix.block<kKnot, kKnot>(at_i, at_j);
    }
  }
}

Eigen::MatrixXd ErrorNormal::times(const Eigen::MatrixXd& right) const {
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(right.rows(), right.cols());
  for (const auto& [knots, block] : tt) {
    product.middleRows<kKnot>(knots.first * kKnot).noalias() +=
        block * right.middleRows<kKnot>(knots.second * kKnot);
    if (knots.first == knots.second) continue;
    product.middleRows<kKnot>(knots.second * kKnot).noalias() +=
        block.transpose() * right.middleRows<kKnot>(knots.first * kKnot);
  }
  return product;
}

}  // namespace pcl_als
