// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>

namespace pcl_als {

template class CorrespondenceEstimationPointToPatch<PointLidar, PointLidar, float>;
template class CorrespondenceEstimationPointToPatch<PointLidar, PointLidar, double>;
template class CorrespondenceEstimationPointToPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
template class CorrespondenceEstimationPointToPatch<pcl::PointXYZ, pcl::PointXYZ, double>;
template class CorrespondenceEstimationPointToPatch<pcl::PointXYZI, pcl::PointXYZI, float>;
template class CorrespondenceEstimationPointToPatch<pcl::PointXYZI, pcl::PointXYZI, double>;
template class CorrespondenceEstimationPointToPatch<pcl::PointNormal, pcl::PointNormal, float>;
template class CorrespondenceEstimationPointToPatch<pcl::PointNormal, pcl::PointNormal, double>;
template class CorrespondenceEstimationPointToPatch<pcl::PointXYZINormal, pcl::PointXYZINormal,
                                                    float>;
template class CorrespondenceEstimationPointToPatch<pcl::PointXYZINormal, pcl::PointXYZINormal,
                                                    double>;

}  // namespace pcl_als
