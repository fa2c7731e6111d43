// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/** \brief Keeps one point, the first, of every cube of space, for scenes that are viewed from
 * all sides.
 *
 * Cubes begin small and double whenever more than \a most points are kept, so that any number of
 * points ends as an even choice of a bounded number. Deterministic; order of input.
 */
class VoxelThinning {
 public:
  /// \param center what positions are relative to; \param size of all points, metres
  VoxelThinning(const Eigen::Vector3d& center, const Eigen::Vector3d& size,
                std::size_t most = 6000000);

  void add(const Eigen::Vector3d& ground, float value);

  double cube() const { return cube_; }  ///< side, metres
  const std::vector<Eigen::Vector3f>& positions() const { return positions_; }
  const std::vector<float>& values() const { return values_; }

 private:
  std::uint64_t keyOf(const Eigen::Vector3d& offset) const;
  void coarsen();

  Eigen::Vector3d center_;
  double cube_;
  std::size_t most_;
  std::unordered_set<std::uint64_t> taken_;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<float> values_;
};

}  // namespace pcl_als
