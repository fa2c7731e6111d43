// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <Eigen/Geometry>

#include <pcl_als/las/las_file.h>

namespace pcl_als {

/** \brief The box of all points of a file, metres; empty without points.
 *
 * Every record is read once: 2 ns per point of a .las in memory. Of a .laz of point format 6 or
 * later only the layers of the coordinates are decoded where the file was opened with no further
 * fields than kLazZ. The box does not depend on the number of threads (0: all cores).
 */
Eigen::AlignedBox3d pointBox(const LasFile& file, int threads = 0);

}  // namespace pcl_als
