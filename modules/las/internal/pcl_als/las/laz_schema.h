// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_als {

/// The VLR of a LAZ file that describes the compression of its points.
inline constexpr const char* kLazUser = "laszip encoded";
inline constexpr std::uint16_t kLazRecord = 22204;
/// User id of the records of a COPC file, whose chunks are the nodes of an octree.
inline constexpr const char* kCopcUser = "copc";

/// Parts of a point record that are compressed by one method; numbers of the format.
enum class LazItemType : std::uint16_t {
  bytes = 0,
  point10 = 6,
  gps_time11 = 7,
  rgb12 = 8,
  wave_packet13 = 9,
  point14 = 10,
  rgb14 = 11,
  rgb_nir14 = 12,
  wave_packet14 = 13,
  bytes14 = 14
};

struct LazItem {
  LazItemType type = LazItemType::bytes;
  std::uint16_t size = 0;  ///< bytes in the record
  std::uint16_t version = 0;
};

/// How the points are compressed; numbers of the format.
enum class LazCompressor : std::uint16_t {
  pointwise = 1,          ///< one stream without chunks (LASzip 1.0)
  pointwise_chunked = 2,  ///< chunks that can be decoded each by itself: point formats 0 to 5
  layered_chunked = 3     ///< and in each chunk a stream per field: point formats 6 to 10
};

inline constexpr std::uint32_t kLazVariableChunks = 0xFFFFFFFFU;
inline constexpr std::uint32_t kLazDefaultChunk = 50000;

/** \brief Content of the "laszip encoded" VLR 22204 of a LAZ file.
 *
 * \code
 * const LazSchema schema = LazSchema::forFormat(6, 30);
 * const std::vector<std::uint8_t> payload = schema.serialise();
 * assert(LazSchema::parse(payload.data(), payload.size(), "a.laz").recordLength() == 30);
 * \endcode
 */
struct LazSchema {
  LazCompressor compressor = LazCompressor::pointwise_chunked;
  std::uint32_t chunk_size = kLazDefaultChunk;  ///< points; kLazVariableChunks: stored per chunk
  std::vector<LazItem> items;

  /// \param format point format 0 to 10. \param record_length in bytes, with extra bytes.
  static LazSchema forFormat(int format, std::size_t record_length,
                             std::uint32_t chunk_size = kLazDefaultChunk);
  /// InputError where the record is damaged or of a kind that is not known. \param name for
  /// messages
  static LazSchema parse(const std::uint8_t* payload, std::size_t size, const std::string& name);
  std::vector<std::uint8_t> serialise() const;

  std::size_t recordLength() const;
  bool layered() const { return compressor == LazCompressor::layered_chunked; }
  bool chunked() const { return compressor != LazCompressor::pointwise; }
  bool variableChunks() const { return chunked() && chunk_size == kLazVariableChunks; }
};

}  // namespace pcl_als
