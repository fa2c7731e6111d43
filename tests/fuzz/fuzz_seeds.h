// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

namespace pcl_als::fuzz {

// Small valid files of every kind, to begin from.
std::vector<std::string> lasSeeds();
std::vector<std::string> pcdSeeds();
std::vector<std::string> trajectorySeeds();
std::vector<std::string> sbetSeeds();
std::vector<std::string> controlSeeds();
std::vector<std::string> calibrationSeeds();

}  // namespace pcl_als::fuzz
