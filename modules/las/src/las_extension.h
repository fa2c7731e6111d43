// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/las/las_extra.h>
#include <pcl_als/las/las_file.h>

#include "las_output.h"

namespace pcl_als::detail {

/// The head of a file whose records are to be longer by the fields; with none, readLasHead().
LasHead extendedHead(const LasFile& file, const std::vector<LasExtraField>& fields);

}  // namespace pcl_als::detail
