// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <pcl_als/las/las_file.h>

namespace pcl_als::detail {

/// Consecutive point records with the same waveform.
struct WaveformPulse {
  const std::byte* records = nullptr;
  std::size_t count = 0;
  std::uint64_t first = 0;  ///< index of the first record in the file
  bool repeated = false;    ///< its packet was met before, with other records between
};

/** \brief Reads a file in order, as pulses.
 *
 * Calls \a take with the pulses of a block of records that are complete: the last pulse of a block
 * is continued in the next one. Records without a waveform are pulses by themselves.
 */
void readPulses(const LasFile& las,
                const std::function<void(const std::vector<WaveformPulse>&)>& take);

/// Calls \a take with the pulses of some records, the first and the last of which may be cut off.
void readPulseRun(const LasFile& las, std::uint64_t first, std::size_t count,
                  const std::function<void(const WaveformPulse&)>& take);

}  // namespace pcl_als::detail
