// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/registration/transformation_estimation_patch.h>

namespace pcl_als {

template class TransformationEstimationPatch<PointLidar, PointLidar, float>;
template class TransformationEstimationPatch<PointLidar, PointLidar, double>;
template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
template class TransformationEstimationPatch<pcl::PointXYZ, pcl::PointXYZ, double>;

}  // namespace pcl_als
