// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>

#include "trajectory_records.h"

namespace pcl_als::detail {

/** \brief Reads a Leica sensor trajectory (.sol).
 *
 * Messages of 184 little-endian bytes, as NERC-ARF (formerly ARSF) published the structure that its
 * tools read: a header of 35 bytes whose last one is the exclusive or of the others; latitude,
 * longitude (rad), height (m), roll, pitch, true heading (rad) and their standard deviations. The
 * times are seconds of the GPS week. Standard deviations of latitude and longitude are not read,
 * because their unit is not documented.
 *
 * InputError names file and record.
 */
TrajectoryRecords readLeicaTrajectory(const std::filesystem::path& path,
                                      const TrajectoryReading& reading);

}  // namespace pcl_als::detail
