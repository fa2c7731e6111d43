// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/las/las_window.h>

namespace pcl_als::detail {

/// Content of the record "copc" 1 of a COPC file (COPC specification 1.0).
struct CopcInfo {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the cube of the octree
  double half_size = 0.0;                            ///< of the cube
  double spacing = 0.0;                              ///< distance of the points of the root node
  std::uint64_t root_offset = 0, root_size = 0;      ///< of the first page of the hierarchy, bytes
};

/// A node that has points: a chunk of the file.
struct CopcNode {
  std::uint64_t offset = 0, bytes = 0, points = 0;
  bool wanted = false;  ///< its points may lie in the window
};

/// The file as far as the hierarchy refers to it.
struct CopcFile {
  std::string name;  ///< for messages
  std::uint64_t size = 0;
  std::uint64_t points = 0;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< of the coordinates
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  std::function<void(std::uint64_t position, std::size_t bytes, std::byte* out)> read;
};

inline constexpr std::uint16_t kCopcInfoRecord = 1;
inline constexpr std::size_t kCopcInfoBytes = 160;

/// InputError where the record is too short or its numbers are impossible.
CopcInfo parseCopcInfo(const std::vector<std::byte>& payload, const CopcFile& file);

/** \brief All nodes that have points, with those marked whose points may lie in a window.
 *
 * The whole hierarchy is read, 32 bytes a node, because only then it can be told that no node is
 * missing. The cubes are enlarged by a step of the coordinates, because points may have been
 * rounded after they were sorted into them. The first point of a node must lie in its cube: this is
 * checked for every node that is wanted, and for at most 1024 others, so that a damaged key or cube
 * is noticed without reading the whole file. Time and memory are bounded by the size of the file.
 * InputError where pages or nodes lie outside the file, a page is referred to twice, a node has an
 * impossible key or size, stands twice, without its parent or in a wrong place, or the nodes do
 * not hold the points of the file.
 */
std::vector<CopcNode> copcNodes(const CopcInfo& info, const CopcFile& file,
                                const LasWindow& window);

}  // namespace pcl_als::detail
