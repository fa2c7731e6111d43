// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/errors.h>

namespace pcl_als::python {

/// Texts of warnings with the names of their remedies.
using WarningTexts = std::vector<std::pair<std::string, std::string>>;
WarningTexts warningTexts(const Warnings& warnings);

/// The warnings of a job as lines that name the arguments of its function which may be set about
/// them.
std::vector<std::string> hintedTexts(const char* function, const WarningTexts& warnings);

}  // namespace pcl_als::python
