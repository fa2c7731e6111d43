// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als {

/// Bits of LasHeader::global_encoding (LAS 1.5 R00, table "Global Encoding").
enum LasGlobalEncoding : std::uint16_t {
  kLasAdjustedStandardTime = 1,  ///< GPS time is standard GPS seconds - 1e9; else seconds of week
  kLasWaveformInternal = 2,
  kLasWaveformExternal = 4,
  kLasSyntheticReturnNumbers = 8,
  kLasWkt = 16,         ///< the CRS is WKT
  kLasTimeOffset = 64,  ///< LAS 1.5: GPS time is standard GPS seconds - 1e6 time_offset
};

/** \brief The public header block of a LAS file, version 1.0 to 1.5.
 *
 * Coordinates are in the unit of the file's CRS, as stored; see LasFile::toMetres().
 * Counts are those that hold: 64-bit where the version has them, the legacy ones otherwise.
 */
struct LasHeader {
  int version_minor = 4;
  std::uint16_t file_source_id = 0;
  std::uint16_t global_encoding = 0;
  std::array<std::uint8_t, 16> project_id{};
  std::string system_id;            ///< at most 32 characters
  std::string generating_software;  ///< at most 32 characters
  std::uint16_t creation_day = 0;   ///< day of the year, from 1
  std::uint16_t creation_year = 0;
  std::uint16_t header_size = 375;  ///< bytes; may be more than the version's own
  std::uint32_t offset_to_points = 375;
  std::uint32_t vlr_count = 0;
  std::uint8_t point_format = 6;  ///< 0 … 10, without the compression bits
  bool compressed = false;        ///< the format byte carries the bits of LAZ
  std::uint16_t record_length = 30;
  std::uint64_t point_count = 0;
  std::uint64_t legacy_point_count = 0;                      ///< as stored, for checks
  std::array<std::uint64_t, 15> points_by_return{};          ///< [0] is return 1
  Eigen::Vector3d scale = Eigen::Vector3d::Constant(0.001);  ///< units per step
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();          ///< units of the file
  Eigen::Vector3d minimum = Eigen::Vector3d::Zero();         ///< units of the file
  Eigen::Vector3d maximum = Eigen::Vector3d::Zero();
  std::uint64_t waveform_start = 0;  ///< 1.3 and later
  std::uint64_t evlr_start = 0;      ///< 1.4
  std::uint32_t evlr_count = 0;
  double latest_time = 0.0;       ///< 1.5: GPS time of the points as stored, without zeros
  double earliest_time = 0.0;     ///< 1.5; both are zero where there is none
  std::uint16_t time_offset = 0;  ///< 1.5, with kLasTimeOffset: in 1e6 seconds

  /// Seconds that are added to a stored GPS time to give adjusted standard GPS time (offset GPS
  /// time of LAS 1.5), 0 otherwise.
  double timeShift() const;
  /// Bytes of the version's header: 227, 235 (1.3), 375 (1.4) or 393 (1.5).
  static std::uint16_t sizeOf(int version_minor);
  /// The sensor by system_id; empty where that is empty or names a process such as MERGE.
  std::string sensor() const;
  /// "LAS 1.4, point format 6"
  std::string describe() const;
};

/// Position of the bounding box (max x, min x, max y, min y, max z, min z) in the header block.
inline constexpr std::size_t kLasBoxPosition = 179;
/// Bytes of the header of the newest version.
inline constexpr std::size_t kLargestLasHeader = 393;

/** \brief Reads and checks a header block against the size of its file.
 *
 * \param bytes the first \a available bytes of the file (kLargestLasHeader are enough)
 * \param name the file's name, for messages
 * Every contradiction (no LAS signature, unknown version or format, records shorter than the
 * format, scale or offset that are no numbers, points beyond the end of the file, …) is an
 * InputError. Compressed files: the length of the points is not checked.
 * \param truncated accepts points beyond the end of the file
 */
LasHeader parseLasHeader(const std::byte* bytes, std::size_t available, std::uint64_t file_size,
                         const std::string& name, bool truncated = false);

/// The header block as bytes, header.header_size of them (zeros past the version's own).
std::vector<std::byte> serialiseLasHeader(const LasHeader& header);

/// A variable length record in memory. User id at most 16 characters, description at most 32.
struct LasVlr {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::string description;
  std::vector<std::byte> data;
};

/// Where a (possibly large) variable length record lies in its file.
struct LasVlrEntry {
  std::string user_id;
  std::uint16_t record_id = 0;
  std::string description;
  std::uint64_t position = 0;  ///< of the payload
  std::uint64_t length = 0;    ///< of the payload, bytes
  bool extended = false;
};

/// User id and record id of the VLR that records the corrections applied to the points of a file,
/// JSON text (io/applied_correction.h).
inline constexpr const char* kLasCorrectionsUser = "pcl_als";
inline constexpr std::uint16_t kLasCorrectionsRecord = 1;
/// The VLR with such a record.
LasVlr lasCorrectionsVlr(const std::string& corrections);

inline constexpr std::size_t kLasVlrHeader = 54;
inline constexpr std::size_t kLasEvlrHeader = 60;

/// A record with its header, as VLR (payload up to 65535 bytes) or extended VLR.
std::vector<std::byte> serialiseLasVlr(const LasVlr& vlr, bool extended = false);

}  // namespace pcl_als
