// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>

#include "pcd_header.h"

namespace pcl_als::detail {

/** \brief Parses the header at the beginning of a PLY file: formats ascii and binary_little_endian.
 *
 * The vertices are records whose fields are their properties; other elements are not read. Those
 * before the vertices must have a fixed size in bytes. InputError: "NAME: …".
 */
PcdHeader parsePlyHeader(const std::string& text, std::uint64_t file_size, const std::string& name);

}  // namespace pcl_als::detail
