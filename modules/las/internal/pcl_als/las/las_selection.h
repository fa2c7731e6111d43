// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/las/las_file.h>

namespace pcl_als {

/** \brief Writes some of the point records of a LAS file to a new file (LAZ by extension).
 *
 * Header, VLRs, EVLRs, waveform packets and all other bytes are those of the file that the output
 * is like, and its external waveforms are copied (WaveformCopy); the number of points, the returns
 * by number and the bounding box are those of the records that are appended. Constant memory;
 * output through AtomicFile. \code const LasFile file("tile.laz"); LasSelectionWriter
 * writer("part.laz", file); writer.append(records, count); writer.finish(); \endcode
 */
class LasSelectionWriter {
 public:
  /// \param like must exist until finish(). UsageError where it is the output itself.
  LasSelectionWriter(const std::filesystem::path& path, const LasFile& like, int threads = 0);
  /// Records are longer by the fields, as those of extendLas(): see placeExtension().
  LasSelectionWriter(const std::filesystem::path& path, const LasFile& like,
                     const std::vector<LasExtraField>& fields, int threads = 0);
  ~LasSelectionWriter();

  /// Appends records of the format of \a like, with the fields.
  void append(const std::byte* records, std::size_t count);
  std::uint64_t pointCount() const;
  void finish();
  /// Of the file that the output is like: what was copied besides the records, or ignored.
  std::vector<std::string> remarks() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/** \brief Steps to be added to the raw coordinates of one file so that they have the offset of
 * another one.
 *
 * InputError, which names the first difference, where records of \a from cannot become records of
 * \a to without a change of their values: another point format, record length, scale, kind of GPS
 * time or description of extra bytes, offsets that differ by a fraction of a step, or waveforms, to
 * which records refer by their place among those of their own file.
 */
std::array<std::int64_t, 3> stepsBetween(const LasFile& from, const LasFile& to);

/// Adds steps to the raw coordinates of records. InputError "NAME: …" where a sum does not fit.
void moveRecords(const std::array<std::int64_t, 3>& steps, std::byte* records, std::size_t count,
                 std::size_t record_length, const std::string& name);

}  // namespace pcl_als
