// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/calibration/impl/system_calibration.hpp>

template class pcl_als::SystemCalibration<pcl_als::PointLidar>;
