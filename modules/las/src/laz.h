// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <pcl_als/common/input_file.h>
#include <pcl_als/las/las_header.h>
#include <pcl_als/las/laz_point_reader.h>
#include <pcl_als/las/laz_point_writer.h>

namespace pcl_als::detail {

/// The compressed points of a file that stays open as long as the reader.
/// \param payload of the record kLazUser, kLazRecord. \param fields LazField bits.
/// \param keep_intact as in LazPoints
std::unique_ptr<LazPointReader> openLazPoints(const InputFile& file, const LasHeader& header,
                                              const std::vector<std::byte>& payload,
                                              unsigned fields, bool keep_intact);

/// What of a compressed file its points use, by the chunk table.
struct LazExtent {
  std::uint64_t end = 0;            ///< position behind the chunk table; 0: not known
  std::uint64_t surplus_bytes = 0;  ///< of chunks behind the points that the header announces
};
LazExtent readLazExtent(const InputFile& file, const LasHeader& header,
                        const std::vector<std::byte>& payload);

/// The VLR (header and payload) that a compressed file needs among its others.
std::vector<std::byte> lazVlr(const LazSchema& schema);

}  // namespace pcl_als::detail
