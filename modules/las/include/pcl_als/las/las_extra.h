// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_als {

/// Data type of an extra-bytes field (LAS 1.4 R15, table 24), without the deprecated arrays.
enum class LasExtraType : std::uint8_t {
  undocumented = 0,
  u8 = 1,
  i8 = 2,
  u16 = 3,
  i16 = 4,
  u32 = 5,
  i32 = 6,
  u64 = 7,
  i64 = 8,
  f32 = 9,
  f64 = 10,
};

/** \brief One extra-bytes field: value = raw * scale + offset.
 */
struct LasExtraField {
  std::string name;         ///< at most 32 characters
  std::string description;  ///< at most 32 characters
  LasExtraType type = LasExtraType::f32;
  double scale = 1.0;
  double offset = 0.0;
  std::size_t position = 0;  ///< byte in the record; filled by the reader and the writer
  std::size_t size = 0;      ///< bytes; for `undocumented` as declared, else by type
  int components = 1;        ///< 2 or 3 for the deprecated array types
};

/// Bytes of a field in the record, all components.
std::size_t lasExtraSize(const LasExtraField& field);

/// The fields that an extra-bytes VLR (LASF_Spec, 4) describes, placed after the standard fields.
/// Fields that do not fit the record length are left out.
std::vector<LasExtraField> parseLasExtraFields(const std::vector<std::byte>& payload,
                                               std::size_t standard_length,
                                               std::size_t record_length);
/// The VLR's payload, 192 bytes per field.
std::vector<std::byte> serialiseLasExtraFields(const std::vector<LasExtraField>& fields);

/// One extra field (first component) of raw records as doubles, scaled.
void decodeLasExtraField(const std::byte* records, std::size_t count, std::size_t record_length,
                         const LasExtraField& field, std::vector<double>& values);
/// Stores \a values, scaled back and rounded; InputError where one does not fit the type.
void encodeLasExtraField(const std::vector<double>& values, std::size_t record_length,
                         const LasExtraField& field, const std::string& name, std::byte* records);

}  // namespace pcl_als
