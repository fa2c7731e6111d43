// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als::detail {

/// The CSV half of readTrajectory().
std::vector<TrajectorySample> readTrajectoryCsv(const std::filesystem::path& path);

}  // namespace pcl_als::detail
