// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include <pcl_als/las/las_rewriter.h>

namespace pcl_als {

/// The version of LAS that a copy of a file is to have.
struct LasVersion {
  int minor = 4;  ///< 4 or 5
  /// 1.5: absolute times are stored less this many million seconds of standard GPS time (1500 for
  /// 2023 to 2031); empty: as adjusted standard GPS time.
  std::optional<std::uint16_t> time_offset;
};

/** \brief Copies a LAS or LAZ file in another version of the format.
 *
 * Points keep their order, values, colours, waveform packets and extra bytes; VLRs, EVLRs and
 * everything behind the points are copied. What differs:
 *
 * - 1.5 has point formats 6 to 10: formats 0 to 5 become 6, 6, 7, 7, 9 and 10. Class 12 of these
 *   becomes the overlap flag of an unclassified point, and scan angles get steps of 0.006 degrees.
 * - 1.5 states the CRS as WKT: it takes the place of GeoTIFF keys.
 * - 1.5 counts absolute times from the offset, 1.4 in adjusted standard GPS time; seconds of the
 *   week stay as they are.
 * - 1.4 states the CRS as WKT 1: it takes the place of WKT 2.
 *
 * UsageError for another version, for an offset in 1.4 and where \a output is \a input; InputError
 * for an offset of seconds of the week.
 */
LasRewriteResult convertLasVersion(const LasFile& input, const std::filesystem::path& output,
                                   const LasVersion& version, int threads = 0);

}  // namespace pcl_als
