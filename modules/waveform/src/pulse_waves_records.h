// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <pcl_als/waveform/pulse_waves_file.h>

namespace pcl_als::detail {

inline constexpr std::size_t kPulseHeader = 352;  ///< bytes of the header of version 0.3
inline constexpr std::size_t kPulseRecord = 48;   ///< bytes of a pulse without attributes

/// \param bytes kPulseHeader of them \param name of the file, for messages
/// InputError for what PulseWavesFile refuses in a header.
PulseWavesHeader parsePulseHeader(const std::byte* bytes, std::uint64_t file_size,
                                  const std::string& name);

/// The payloads of records of the user PulseWaves_Spec. \param name of file and record. InputError
/// for what PulseWavesFile refuses.
PulseDescriptor parsePulseDescriptor(const std::vector<std::byte>& bytes, const std::string& name);
PulseScanner parsePulseScanner(const std::vector<std::byte>& bytes, const std::string& name);
std::vector<SampleTable> parseSampleTables(const std::vector<std::byte>& bytes,
                                           const std::string& name);

/// A text of at most \a size bytes, up to its first zero.
std::string pulseText(const std::byte* at, std::size_t size);

}  // namespace pcl_als::detail
