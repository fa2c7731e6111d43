// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <vector>

#include <pcl_als/io/strip_loader.h>

namespace pcl_als {

/** \brief Writes strips from memory into one file: .las, .laz or .pcd by its extension.
 *
 * LAS and LAZ: version 1.4 with point format 6, 7 where a strip has a column red, green or blue,
 * and 8 where one has nir; coordinates in steps of 0.001 of the unit of the CRS; all other columns
 * as extra bytes, of which points of strips without them get zero. Times from 0 to 1 209 600 s
 * (two weeks) are taken as seconds of the week, others as adjusted standard GPS time. Where the
 * points of a strip have no point_source_id and its id is a number from 1 to 65535, it is written
 * as that of the points. loadStrips() reads what was written, with coordinates rounded to the step.
 *
 * PCD: one strip, as savePcd() writes it, with columns as 32-bit floats.
 *
 * UsageError for another extension, without any point, for several strips in a PCD, in different
 * CRS, or that could not be told apart in the file, for columns that are not as long as the cloud
 * or that a PCD would round to other integers. InputError for a value that does not fit its type.
 * The file appears when it is complete.
 */
void saveStrips(const std::filesystem::path& path, const std::vector<StripWithColumns>& strips);

}  // namespace pcl_als
