// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/filters/impl/incidence_selection.hpp>

template class pcl_als::IncidenceSelection<pcl_als::PointLidar>;
