// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

namespace pcl_als {

/// "6 building": an ASPRS class code with its name (LAS 1.4 R15, table 17, the codes 8 and 12 of
/// point formats 0 to 5, and 26 of AHN); the code alone where it has no name.
std::string className(int code);

}  // namespace pcl_als
