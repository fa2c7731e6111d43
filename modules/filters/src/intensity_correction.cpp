// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/filters/impl/intensity_correction.hpp>

template class pcl_als::IntensityCorrection<pcl_als::PointLidar>;
