// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/fields.h>
#include <pcl_als/report/inventory_report.h>

namespace pcl_als {

/// The keys of trajectories, scanners and files of accuracies.
const Fields<ListedTrajectory>& flightFields();

}  // namespace pcl_als
