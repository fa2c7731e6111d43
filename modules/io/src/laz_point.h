// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>

#include <laszip/laszip_api.h>

#include <pcl_als/io/las_record.h>

namespace pcl_als::detail {

/// LASzip's point structure as the packed record of plain LAS, extra bytes included.
void packLazPoint(const laszip_point_struct& point, const LasRecordLayout& layout,
                  std::size_t record_length, std::byte* record);
/// The reverse; \a point keeps the memory for extra bytes that LASzip gave it.
void unpackLazPoint(const std::byte* record, const LasRecordLayout& layout,
                    std::size_t record_length, laszip_point_struct& point);

}  // namespace pcl_als::detail
