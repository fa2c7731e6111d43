// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <pcl_als/las/las_file.h>

namespace pcl_als {

/** \brief The channel of the scanner in the point records of a file.
 *
 * It is recorded in two bits of point formats 6 to 10 (or in the extra bytes that stand for them in
 * LAS 1.4 compatibility mode), in the user data, or in a field of extra bytes.
 */
class LasChannel {
 public:
  LasChannel() = default;  ///< none is recorded
  /// \param field "scanner_channel" or empty, "user_data", or the name of a field of extra bytes.
  /// InputError naming the file where it has no such field, or one without a data type.
  LasChannel(const LasFile& file, const std::string& field);

  /// False for a scanner channel in point formats 0 to 5, which have none.
  bool recorded() const { return mask_ != 0 || field_.has_value(); }
  /// The channels of records; 0 where none is recorded. InputError for a value of the extra bytes
  /// that is not between 0 and 255.
  void decode(const std::byte* records, std::size_t count, std::size_t record_length,
              std::uint8_t* channels) const;

  /// LazField bits that have to be decoded for a field; 0: that of the point format.
  static unsigned lazFields(const std::string& field);

 private:
  void takeExtraField(const LasFile& file, const std::string& field);

  std::string file_;
  std::optional<LasExtraField> field_;
  std::size_t position_ = 0;       ///< without a field: byte of the record
  unsigned shift_ = 0, mask_ = 0;  ///< channel = (byte >> shift) & mask
};

}  // namespace pcl_als
