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
  std::string name;
  char type = 'F';         ///< F, I or U
  std::size_t size = 4;    ///< bytes of one element
  std::size_t count = 1;   ///< elements
  std::size_t offset = 0;  ///< in the packed record
};

/// The header of a PCD file, checked against the file's size.
struct PcdHeader {
  std::vector<PcdField> fields;
  std::size_t record_length = 0;  ///< bytes of a packed record
  std::uint64_t points = 0;
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();  ///< the LocalFrame's origin
  PcdData data = PcdData::ascii;
  std::uint64_t data_position = 0;
  std::string crs, strip_id, corrections;  ///< from our comment lines; empty without

  /// The field of that name; null when there is none.
  const PcdField* find(const std::string& name) const;
  const char* dataName() const;
};

inline constexpr const char* kPcdCrsComment = "# pcl_als crs ";
inline constexpr const char* kPcdStripComment = "# pcl_als strip ";
inline constexpr const char* kPcdCorrectionsComment = "# pcl_als corrections ";

/// Parses the header lines at the beginning of \a text. InputError: "NAME: …".
PcdHeader parsePcdHeader(const std::string& text, std::uint64_t file_size, const std::string& name);

}  // namespace pcl_als::detail
