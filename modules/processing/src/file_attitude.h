// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>

#include <pcl_als/common/point_types.h>
#include <pcl_als/common/strip.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/las/las_file.h>
#include <pcl_als/trajectory/attitude_recovery.h>

namespace pcl_als::detail {

/// Pitch and crab from a sample of the points of a file (one in sixteen); what attitude the flight
/// has is not used.
AttitudeRecovery::Outcome recoveredAttitude(const LasFile& file, const TimeAlignment& alignment,
                                            std::shared_ptr<const Trajectory> flight);
AttitudeRecovery::Outcome recoveredAttitude(const Strip<PointLidar>& strip,
                                            const TimeAlignment& alignment,
                                            std::shared_ptr<const Trajectory> flight);

}  // namespace pcl_als::detail
