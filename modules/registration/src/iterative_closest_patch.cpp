// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/registration/iterative_closest_patch.h>

namespace pcl_als {

template class IterativeClosestPatch<PointLidar, PointLidar, float>;
template class IterativeClosestPatch<PointLidar, PointLidar, double>;
template class IterativeClosestPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
template class IterativeClosestPatch<pcl::PointXYZ, pcl::PointXYZ, double>;
template class IterativeClosestPatch<pcl::PointXYZI, pcl::PointXYZI, float>;
template class IterativeClosestPatch<pcl::PointXYZI, pcl::PointXYZI, double>;

}  // namespace pcl_als
