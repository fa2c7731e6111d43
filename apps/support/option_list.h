// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

namespace pcl_als::app {

/// The arguments of a tool with the name of an option of \a lists before each of its values: those
/// that follow it up to the next option or point file (.las, .laz, .pcd), which is an input.
std::vector<std::string> spreadLists(int argc, const char* const* argv,
                                     const std::vector<std::string>& lists);

}  // namespace pcl_als::app
