// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#define PCL_ALS_REGISTRATION_SOURCE
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>

namespace pcl_als {

PCL_ALS_POINT_TO_PATCH(, PointLidar)
PCL_ALS_POINT_TO_PATCH(, pcl::PointXYZ)
PCL_ALS_POINT_TO_PATCH(, pcl::PointXYZI)
PCL_ALS_POINT_TO_PATCH(, pcl::PointNormal)
PCL_ALS_POINT_TO_PATCH(, pcl::PointXYZINormal)

}  // namespace pcl_als
