// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/las/las_file.h>

namespace pcl_als {

/// A block of raw records that may be changed in place.
struct LasRecordBlock {
  std::byte* records = nullptr;
  std::size_t count = 0;
  std::size_t record_length = 0;
  std::uint64_t first = 0;  ///< index of the first record in the file
};

/// Changes records. Called with several blocks at once, each exactly once, in no fixed order.
using LasEdit = std::function<void(const LasRecordBlock&)>;

struct LasRewriteResult {
  std::uint64_t points = 0;
  bool box_changed = false;  ///< the bounding box of the points differs from that of the input
};

/** \brief Copies a LAS file, changing only what \a edit changes in the point records.
 *
 * Everything else is kept byte for byte: header, VLRs, EVLRs, bytes between, waveform packets,
 * extra bytes, bytes after the points, point order. The header's bounding box is rewritten where
 * the box of the integer coordinates changed, from those coordinates. Memory is constant (a few MB
 * per thread). Output through AtomicFile. .las and .laz in and out, by extension.
 *
 * UsageError when \a output is \a input.
 */
LasRewriteResult rewriteLas(const std::filesystem::path& input, const std::filesystem::path& output,
                            const LasEdit& edit, int threads = 0);
LasRewriteResult rewriteLas(const LasFile& input, const std::filesystem::path& output,
                            const LasEdit& edit, int threads = 0);

/// What a rewritten file is to have besides.
struct LasExtension {
  std::vector<LasExtraField> fields;  ///< appended to every record, zeros before the edit
  std::size_t block_records = 0;      ///< records of the blocks handed to the edit; 0: about 1 MiB
  bool keeps_coordinates = false;     ///< the edit leaves X, Y and Z alone: no box is taken of them
};

/** \brief Where the fields will lie in the records of the output: behind all that is there.
 *
 * UsageError for a name that the file has already, or more bytes than a record can hold; InputError
 * where the file describes its extra bytes in an extended VLR.
 */
std::vector<LasExtraField> placeExtension(const LasFile& input,
                                          const std::vector<LasExtraField>& fields);

/// As rewriteLas(), with longer records: the extra-bytes VLR is extended (or made); bytes of the
/// records that the input did not describe are described as undocumented. All else is kept.
LasRewriteResult extendLas(const LasFile& input, const std::filesystem::path& output,
                           const LasExtension& extension, const LasEdit& edit, int threads = 0);

}  // namespace pcl_als
