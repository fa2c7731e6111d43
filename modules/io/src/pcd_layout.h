// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_types.h>

namespace pcl_als::detail {

/// What the header of a PCD file of PointLidar states.
struct PcdDescription {
  std::string strip_id;  ///< may be empty
  LocalFrame frame;
  std::string corrections;           ///< record of applied corrections; may be empty
  std::vector<std::string> columns;  ///< further fields of one float each
  std::uint64_t width = 0, height = 1;
  /// The header is as long as with the largest counts, so that they can be stored afterwards.
  bool counts_later = false;
};

std::string pcdHeaderText(const PcdDescription& description);

/// Bytes of a point, without further columns.
inline constexpr std::size_t kPcdRecord = 35;
void putPcdPoint(const PointLidar& point, char* at);

}  // namespace pcl_als::detail
