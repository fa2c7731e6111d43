// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/common/strip.h>
#include <pcl_als/las/las_extra.h>

namespace pcl_als {

/** \brief A field of points besides those of PointLidar.
 *
 * Fields of LAS records are called red, green, blue and nir (16 bits each);
 * a field of another name or type is stored as extra bytes.
 */
struct PointColumn {
  LasExtraField field;         ///< name, description and type; scale and offset in files
  std::vector<double> values;  ///< one for each point, as raw * scale + offset
};

/// A strip with further fields of its points.
struct StripWithColumns : Strip<PointLidar> {
  std::vector<PointColumn> columns;
};

}  // namespace pcl_als
