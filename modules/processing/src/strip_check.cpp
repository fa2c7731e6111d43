// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/processing/impl/strip_check.hpp>

template class pcl_als::StripCheck<pcl_als::PointLidar>;
