// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/classification/impl/land_cover_filter.hpp>

template class pcl_als::LandCoverFilter<pcl_als::PointLidar>;
