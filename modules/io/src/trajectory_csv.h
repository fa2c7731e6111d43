// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>

#include <pcl_als/io/survey_io.h>

namespace pcl_als::detail {

/// The CSV half of readTrajectoryFile().
TrajectoryFile readTrajectoryCsv(const std::filesystem::path& path);

}  // namespace pcl_als::detail
