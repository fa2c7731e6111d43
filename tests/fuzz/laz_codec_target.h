// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_als::fuzz {

/// Decodes the points of a LAZ file in memory, in two ways that must agree; aborts where they do
/// not, or where bytes behind the file are asked for. \return whether the file was accepted
bool lazCodec(const std::uint8_t* data, std::size_t size);

}  // namespace pcl_als::fuzz
