// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
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
  bool complete = true;  ///< false: abandoned (LasExtension::abandon), there is no output
  std::uint64_t points = 0;
  bool box_changed = false;  ///< the bounding box of the points differs from that of the input
  /// Of the input: descriptors of extra bytes that were ignored, a wrong box in its header,
  /// external waveforms, bytes behind the points.
  std::vector<std::string> remarks;
};

/** \brief Copies a LAS file, changing only what \a edit changes in the point records.
 *
 * Everything else is kept byte for byte: header, VLRs, EVLRs, bytes between, waveform packets,
 * extra bytes, bytes after the points, point order. External waveforms are copied beside the output
 * (WaveformCopy). The header's bounding box is rewritten from the integer coordinates where the box
 * of these changed, or where that of the input is wrong. Memory is constant (a few MB
 * per thread). Output through AtomicFile. .las and .laz in and out, by extension.
 *
 * UsageError when \a output is \a input; InputError where the name of the waveforms is taken.
 */
LasRewriteResult rewriteLas(const std::filesystem::path& input, const std::filesystem::path& output,
                            const LasEdit& edit, int threads = 0);
LasRewriteResult rewriteLas(const LasFile& input, const std::filesystem::path& output,
                            const LasEdit& edit, int threads = 0);

/// What a rewritten file is to have besides.
struct LasExtension {
  std::vector<LasExtraField> fields;  ///< appended to every record, zeros before the edit
  std::size_t block_records = 0;      ///< records of the blocks handed to the edit; 0: about 1 MiB
  bool keeps_coordinates = false;     ///< the edit leaves X, Y and Z alone
  /// Record of applied corrections (PointFileInfo::corrections) in place of that of the input; an
  /// empty text removes it. By default it is kept.
  std::optional<std::string> corrections{};
  /// Asked before each block, by several threads: true ends the rewriting without an output.
  std::function<bool()> abandon{};
};

/** \brief Where the fields will lie in the records of the output: behind all that is there.
 *
 * UsageError for a name that the file has already, or more bytes than a record can hold.
 */
std::vector<LasExtraField> placeExtension(const LasFile& input,
                                          const std::vector<LasExtraField>& fields);

/// As rewriteLas(), with longer records. One extra-bytes VLR takes the place of all VLRs and EVLRs
/// that describe extra bytes of the input: the descriptors of LasFile::extraBytes() as they are,
/// the bytes that none of them describes as undocumented, and the new fields. All else is kept.
/// InputError where the descriptors do not fit into a VLR (341 fields).
LasRewriteResult extendLas(const LasFile& input, const std::filesystem::path& output,
                           const LasExtension& extension, const LasEdit& edit, int threads = 0);

}  // namespace pcl_als
