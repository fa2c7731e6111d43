// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pcl_als/processing/impl/delivery_check.hpp>

template class pcl_als::DeliveryCheck<pcl_als::PointLidar>;
