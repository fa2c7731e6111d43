// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl/point_cloud.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/point_types.h>

namespace pcl_als {

/// One flight line, or a part of it that lies within LocalFrame::kMaximumExtent of the frame's
/// origin.
template <typename PointT = PointLidar>
struct Strip {
  std::string id;  ///< name used in pairs and results; the point source id where the file has one
  LocalFrame frame;
  typename pcl::PointCloud<PointT>::Ptr cloud{new pcl::PointCloud<PointT>};
  std::string corrections;  ///< record of applied corrections, see PointFileInfo::corrections
};

}  // namespace pcl_als
