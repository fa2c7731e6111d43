// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/las/las_extra.h>

namespace pcl_als {

/** \brief The extra fields of a file that hold the position of the sensor in each record, and its
 * attitude where there is one: "SensorX, SensorY, SensorZ, SensorRollRads"; empty without them.
 *
 * There is no standard for such fields. Three names that differ in a final x, y and z count where
 * the rest of them names the sensor (sensor, scanner, platform, beam origin, trajectory, IMU,
 * GNSS); letters count in either case, and spaces and underscores do not count. Names of the
 * attitude hold roll, pitch, yaw or heading.
 */
std::string recordedPose(const std::vector<LasExtraField>& fields);

}  // namespace pcl_als
