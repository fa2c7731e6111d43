// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
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
  std::optional<double> no_data;  ///< raw value that stands for no value
  std::size_t position = 0;       ///< byte in the record; filled by the reader and the writer
  std::size_t size = 0;           ///< bytes; for `undocumented` as declared, else by type
  int components = 1;             ///< 2 or 3 for the deprecated array types
};

/// Bytes of a field in the record, all components.
std::size_t lasExtraSize(const LasExtraField& field);

/// "uint16", "3 x float", "undocumented, 12 bytes".
std::string lasExtraTypeName(const LasExtraField& field);

/// Bytes of the descriptor of a field in an extra-bytes VLR (LAS 1.4 R15, table 25).
inline constexpr std::size_t kLasExtraDescriptor = 192;

/// User id and record id of extra-bytes VLRs.
inline constexpr const char* kLasSpecUser = "LASF_Spec";
inline constexpr std::uint16_t kLasExtraBytesRecord = 4;

/** \brief The extra bytes of the records of a file, as all of its descriptors together describe
 * them.
 *
 * The fields lie one behind the other after the standard fields and end within the record.
 */
struct LasExtraBytes {
  std::vector<LasExtraField> fields;
  std::vector<std::byte> descriptors;  ///< of the fields, as the file has them
  std::vector<std::string> remarks;    ///< what of the description was ignored or is ambiguous
  std::size_t end = 0;                 ///< of the fields in the record
};

/** \brief Joins the payloads of all extra-bytes VLRs and EVLRs of a file, in their order.
 *
 * A descriptor whose field has no room in the record, or a reserved type of unknown size, is
 * ignored together with those behind it, whose positions are then unknown. Bytes behind the last
 * whole descriptor of a payload, and descriptors of no bytes, are ignored. Each is a remark.
 */
LasExtraBytes joinLasExtraBytes(const std::vector<std::vector<std::byte>>& payloads,
                                std::size_t standard_length, std::size_t record_length);

/// The payload of one VLR, 192 bytes per field.
std::vector<std::byte> serialiseLasExtraFields(const std::vector<LasExtraField>& fields);

/// The field of a name; null where there is none. InputError "FILE: …" where two have that name.
const LasExtraField* findLasExtraField(const std::vector<LasExtraField>& fields,
                                       const std::string& name, const std::string& file);

/// One extra field (first component) of raw records as doubles, scaled; NaN for no value.
void decodeLasExtraField(const std::byte* records, std::size_t count, std::size_t record_length,
                         const LasExtraField& field, std::vector<double>& values);
/// Stores \a values, scaled back and rounded; InputError where one does not fit the type.
void encodeLasExtraField(const std::vector<double>& values, std::size_t record_length,
                         const LasExtraField& field, const std::string& name, std::byte* records);

}  // namespace pcl_als
