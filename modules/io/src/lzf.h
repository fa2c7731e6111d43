// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

namespace pcl_als::detail {

/// Most bytes that one byte of LZF data can stand for (a three-byte reference copies 264).
inline constexpr std::size_t kLzfMostExpansion = 88;

/// Decompresses the LZF data of a binary_compressed PCD; false unless it gives exactly \a out_size
/// bytes. Never reads or writes outside the two ranges.
bool decompressLzf(const std::byte* in, std::size_t in_size, std::byte* out, std::size_t out_size);

}  // namespace pcl_als::detail
