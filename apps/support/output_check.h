// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pcl_als::app {

/// Checks an output before the computation: InputError unless the file's folder is
/// there and can be written to.
void checkWritable(const std::filesystem::path& file);

/// Makes the folder that an option names; InputError naming the option where that cannot be.
void makeOutputFolder(const std::string& option, const std::filesystem::path& folder);

/// UsageError naming the option when its file is one that is read.
void refuseInput(const std::string& option, const std::filesystem::path& output,
                 const std::vector<std::filesystem::path>& inputs);

}  // namespace pcl_als::app
