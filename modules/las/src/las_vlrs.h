// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/common/input_file.h>
#include <pcl_als/las/las_header.h>

namespace pcl_als::detail {

/** \brief Finds the VLRs between the header block and the points.
 *
 * Where there is room for fewer than the header announces, its number is corrected. Returns a
 * remark about it, empty where the number is right.
 *
 * DamagedFile for a VLR that reaches past the beginning of the points; with \a keep_intact it is
 * excluded with those behind it.
 */
std::string readVlrs(const InputFile& file, bool keep_intact, LasHeader& header,
                     std::vector<LasVlrEntry>& entries);

/// Finds the extended VLRs. DamagedFile where one does not lie between the points and the end of
/// the file.
void readExtendedEntries(const InputFile& file, const LasHeader& header,
                         std::vector<LasVlrEntry>& entries);

/// Finds the extended VLRs up to the first one that is lost, corrects their number in the header
/// and returns the number of those lost.
std::uint32_t readIntactEntries(const InputFile& file, LasHeader& header,
                                std::vector<LasVlrEntry>& entries);

}  // namespace pcl_als::detail
