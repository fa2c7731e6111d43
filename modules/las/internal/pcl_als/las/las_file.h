// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/common/linear_units.h>
#include <pcl_als/common/point_file_info.h>
#include <pcl_als/las/las_extra.h>
#include <pcl_als/las/las_header.h>
#include <pcl_als/las/las_record.h>
#include <pcl_als/las/las_window.h>
#include <pcl_als/las/laz_io.h>

namespace pcl_als {

/// How raw integer coordinates become metres: metres = raw * scale + offset.
struct LasScaling {
  Eigen::Vector3d scale = Eigen::Vector3d::Constant(0.001);  ///< metres per step
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();          ///< metres, ground frame
};

/// What a LasFile does with a file that is damaged or cut off behind its header and VLRs.
enum class LasDamage {
  refuse,
  keep_intact  ///< LasFile::intact() can be read; extended VLRs that are lost are omitted
};

/// The part of a damaged file that can be read.
struct LasIntact {
  std::vector<LasRecordRange> records;  ///< in file order
  std::uint64_t record_count = 0;       ///< of these
  std::uint64_t announced = 0;          ///< records by the header
  /// Of a .laz: intact chunks, and all chunks; all is 0 where the chunk table is lost.
  std::uint64_t chunks = 0, chunk_count = 0;
  std::uint32_t lost_evlrs = 0;

  bool complete() const { return record_count == announced && lost_evlrs == 0; }
  /// "12 of 15 chunks are intact, with 600 000 of 750 000 points; 1 extended VLR is lost".
  std::string describe() const;
};

/** \brief A .las or .laz file opened for reading its raw point records.
 *
 * The constructor checks header, VLRs, EVLRs and point range against the size of the file; nothing
 * in the file is trusted. Memory does not grow with the file. Records of a .laz are packed as the
 * plain LAS records they came from.
 *
 * header() is in the file's own unit; toMetres() is what coordinates are computed with.
 * \code
 * LasFile file("strip1.las");
 * std::vector<std::byte> records(n * file.header().record_length);
 * file.readRecords(0, n, records.data());
 * \endcode
 */
class LasFile {
 public:
  /// \param laz_fields LazField bits: what a caller does not need is not decoded from layers.
  explicit LasFile(std::filesystem::path path, unsigned laz_fields = kLazAllFields,
                   LasDamage damage = LasDamage::refuse);
  ~LasFile();
  LasFile(LasFile&&) noexcept;
  LasFile& operator=(LasFile&&) = delete;

  const std::filesystem::path& path() const;
  const LasHeader& header() const;
  const LasRecordLayout& layout() const;
  const std::vector<LasVlrEntry>& vlrs() const;  ///< VLRs, then EVLRs, in file order
  /// The one description of the extra bytes that all its VLRs and EVLRs give together.
  const LasExtraBytes& extraBytes() const;
  const std::vector<LasExtraField>& extraFields() const { return extraBytes().fields; }
  /// What of the header, the VLRs and the descriptors of extra bytes was ignored or corrected.
  const std::vector<std::string>& remarks() const;
  std::string crs() const;  ///< WKT or "EPSG:…"; empty when the file does not state it
  CrsKind crsKind() const;
  /// What the coordinates count in; of geographic and geocentric ones the default.
  const LinearUnits& units() const;
  /// InputError for a file whose coordinates are no map coordinates: degrees or geocentric.
  LasScaling toMetres() const;
  std::uint64_t fileSize() const;
  /// Position of the first byte behind the points, and behind the chunk table of a .laz; 0: not
  /// known.
  std::uint64_t pointsEnd() const;
  /// Bytes of compressed points of a .laz behind those that the header announces.
  std::uint64_t surplusPointBytes() const;
  PointFileInfo info() const;

  /// Payload of a VLR; InputError when it is longer than \a limit bytes.
  std::vector<std::byte> payload(const LasVlrEntry& vlr,
                                 std::size_t limit = std::size_t{1} << 26) const;
  /// Any bytes of the file as they are.
  void readBytes(std::uint64_t position, std::size_t bytes, std::byte* out) const;
  /// Raw records [first, first + count). Several threads may call it at once; for a .laz they wait
  /// for each other, because each call decodes on several threads. Fast in the order of the file.
  void readRecords(std::uint64_t first, std::size_t count, std::byte* out) const;
  /// The records of several ranges, one behind the other; faster where these are whole chunks.
  void readRanges(const std::vector<LasRecordRange>& ranges, std::byte* out) const;

  /// With LasDamage::keep_intact: the records that can be read. A .laz is decoded for it, once.
  const LasIntact& intact() const;
  /// With LasDamage::keep_intact: whether uncompressed points or extended VLRs that the header
  /// announces lie past the end of the file.
  bool isTruncated() const;

  /// Whether the chunks of a .laz are the nodes of an octree (COPC specification 1.0).
  bool isCopc() const;
  /** The records that may lie in a part of the file, in file order: of a COPC file those of the
   * nodes that meet the window, of which only the necessary pages of the hierarchy are read; of
   * another file all.
   *
   * InputError where the hierarchy of a COPC file contradicts the file or its chunks, and for a
   * resolution of a file that is not COPC.
   */
  std::vector<LasRecordRange> recordsWithin(const LasWindow& window) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pcl_als
