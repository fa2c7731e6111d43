// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/las/las_extra.h>
#include <pcl_als/las/las_record.h>

namespace pcl_als::detail {

/// The standard fields of a record that a PointChunk has no columns for, with their positions:
/// red, green, blue, nir and user_data, as far as the point format has them.
std::vector<LasExtraField> standardColumns(const LasRecordLayout& layout);

/// Whether values of \a field are those of a standard field of that name: of its type, not scaled.
bool isStandardColumn(const LasExtraField& field);

}  // namespace pcl_als::detail
