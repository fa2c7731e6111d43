// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
//
// A program with PCL's headers before those of pcl_als, and with a definition of its own of
// PCL_NO_PRECOMPILE.
#ifdef DEFINED_IN_SOURCE
#define PCL_NO_PRECOMPILE
#endif
#include <pcl/filters/voxel_grid.h>

#include <pcl_als/common/point_types.h>

int main() {
  pcl::PointCloud<pcl_als::PointLidar>::Ptr cloud(new pcl::PointCloud<pcl_als::PointLidar>(2, 1));
  pcl::PointCloud<pcl_als::PointLidar> thinned;
  pcl::VoxelGrid<pcl_als::PointLidar> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(1.0F, 1.0F, 1.0F);
  grid.filter(thinned);
  return thinned.size() == 1 ? 0 : 1;
}
