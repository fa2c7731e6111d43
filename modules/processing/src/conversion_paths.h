// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_als::detail {

/// The output of each input: the output itself, or files in the output folder, which is made.
std::vector<std::filesystem::path> outputPaths(const std::vector<std::filesystem::path>& inputs,
                                               const std::filesystem::path& output,
                                               const std::string& format);

/// The output of each strip in the output folder, which is made.
std::vector<std::filesystem::path> stripPaths(const std::vector<std::filesystem::path>& inputs,
                                              const std::filesystem::path& folder,
                                              const std::string& format,
                                              const std::vector<std::string>& strips);

/// By strip, the point source id that its points get: the name where it is one, else the next
/// number from 1 that no strip has. InputError for more strips than there are numbers.
std::vector<std::uint16_t> lineNumbers(const std::vector<std::string>& strips);

}  // namespace pcl_als::detail
