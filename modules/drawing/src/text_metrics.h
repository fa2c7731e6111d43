// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

namespace pcl_als::detail {

/// The font of pictures, which Cairo finds through Fontconfig; another one where it is missing.
inline constexpr const char* kFontFamily = "DejaVu Sans";

/// Height of letters and digits above the baseline, and depth of letters below it, in sizes of the
/// font.
constexpr double kAscent = 0.80, kDescent = 0.24;

/// Advance of a text, pixels.
double textLength(const std::string& utf8, double size, bool bold);

}  // namespace pcl_als::detail
