// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace pcl_als::detail {

enum class PcdData { ascii, binary, binary_compressed };

struct PcdField {
  std::string name;        ///< as the file has it
  std::string column;      ///< field of PointLidar that it is; empty: none
  char type = 'F';         ///< F, I or U
  std::size_t size = 4;    ///< bytes of one element
  std::size_t count = 1;   ///< elements
  std::size_t offset = 0;  ///< in the packed record
};

/** \brief The header of a file of points as packed records, checked against the file's size.
 *
 * It is that of a PCD file, or of a PLY file (parsePlyHeader()), whose vertices are such records.
 */
struct PcdHeader {
  const char* kind = "PCD";  ///< or "PLY"
  std::vector<PcdField> fields;
  std::size_t record_length = 0;  ///< bytes of a packed record
  std::uint64_t points = 0;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  bool rotated = false;  ///< of the viewpoint
  /// Whether a comment line of ours, or all fields of PointLidar, show that the file was written
  /// from clouds of this library: then the viewpoint is the origin of their frame.
  bool of_pcl_als = false;
  PcdData data = PcdData::ascii;
  std::uint64_t data_position = 0;
  std::string crs, strip_id, corrections;  ///< from our comment lines; empty without
  std::string time_fault;  ///< PointFileInfo::time_fault, of what the header states; may be empty
  std::vector<std::string> other_elements;  ///< of a PLY, besides the vertices

  /// The field that is a column of PointLidar; null when there is none.
  const PcdField* find(const std::string& column) const;
  /// The field that a user names: the one with the very name, or else the only one with that name
  /// without case and underscores; null when there is none.
  const PcdField* named(const std::string& name) const;
  /// The field behind another one in the record, apart from padding; null behind the last one.
  const PcdField* following(const PcdField& field) const;
  /// Names of the fields that are no column, apart from padding and the field of the channel.
  std::vector<std::string> unusedFields(const PcdField* channel) const;
  const char* dataName() const;
};

inline constexpr const char* kPcdComment = "# pcl_als ";
/// Every file has it, as others of the comments may be missing.
inline constexpr const char* kPcdFrameComment =
    "# pcl_als frame: VIEWPOINT is the origin of the coordinates";
inline constexpr const char* kPcdCrsComment = "# pcl_als crs ";
inline constexpr const char* kPcdStripComment = "# pcl_als strip ";
inline constexpr const char* kPcdCorrectionsComment = "# pcl_als corrections ";

/** \brief The column of PointLidar that a field holds by its name; empty where it is none.
 *
 * Case, underscores and a "scalar_" before the name do not count, as other writers have them: PDAL
 * "GpsTime", lasR "gpstime", CloudCompare "scalar_GpsTime".
 */
std::string pcdColumnOf(const std::string& field);

/// Takes a comment line of this library, "# pcl_als …", into a header.
void takePcdComment(const std::string& line, PcdHeader& header);
/// Checks the fields of a header, and sets their columns and offsets and the length of a record.
/// InputError: "NAME: …".
void layOutPcdFields(PcdHeader& header, const std::string& name);
/// InputError for more points than fit into the file.
void checkPcdRoom(const PcdHeader& header, std::uint64_t file_size, const std::string& name);

/// Parses the header lines at the beginning of \a text. InputError: "NAME: …".
PcdHeader parsePcdHeader(const std::string& text, std::uint64_t file_size, const std::string& name);

}  // namespace pcl_als::detail
