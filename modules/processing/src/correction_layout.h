// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl_als/common/system_lookup.h>
#include <pcl_als/filters/integer_bias_correction.h>
#include <pcl_als/las/las_file.h>

namespace pcl_als::detail {

/// Where the records of a file hold what a correction needs. InputError where the file lacks the
/// field with the channel by which the systems are told apart.
IntegerBiasCorrection::Layout correctionLayout(const LasFile& file, const SystemLookup& systems);

}  // namespace pcl_als::detail
