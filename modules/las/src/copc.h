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
};

/// The file as far as the hierarchy refers to it.
struct CopcFile {
  std::string name;  ///< for messages
  std::uint64_t size = 0;
  double step = 0.0;  ///< of the coordinates in plan
  std::function<void(std::uint64_t position, std::size_t bytes, std::byte* out)> read;
};

inline constexpr std::uint16_t kCopcInfoRecord = 1;
inline constexpr std::size_t kCopcInfoBytes = 160;

/// InputError where the record is too short or its numbers are impossible.
CopcInfo parseCopcInfo(const std::vector<std::byte>& payload, const CopcFile& file);

/** \brief The nodes whose points may lie in a window.
 *
 * Only pages of the hierarchy are read whose cubes meet the window. The cubes are enlarged by a
 * step of the coordinates, because points may have been rounded after they were sorted into them.
 * Time and memory are bounded by the size of the file. InputError where pages or nodes lie outside
 * the file, a page is referred to twice, or a node has an impossible key or size.
 */
std::vector<CopcNode> copcNodes(const CopcInfo& info, const CopcFile& file,
                                const LasWindow& window);

}  // namespace pcl_als::detail
