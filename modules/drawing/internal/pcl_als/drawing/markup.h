// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pcl_als {

/// Text escaped for HTML and SVG, between tags and in quoted attributes.
std::string escapeHtml(const std::string& text);

/// Bytes as a data URL holds them.
std::string base64(const std::vector<std::uint8_t>& bytes);

}  // namespace pcl_als
