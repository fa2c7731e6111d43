// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/io/point_reader.h>

namespace pcl_als {

/// A little-endian number at an unaligned place of a record.
template <typename T>
T loadLas(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof(T));
  return value;
}
template <typename T>
void storeLas(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof(T));
}

/** \brief Byte positions of the fields of a LAS point record (LAS 1.4 R15, tables 7-17).
 *
 * X, Y, Z (int32) lie at 0, 4, 8 and the intensity (uint16) at 12 in every format; -1 where a
 * format lacks a field. Formats 6-10 are `extended`: four-bit return numbers, scan angle in 0.006
 * degrees, classes to 255.
 */
struct LasRecordLayout {
  int format = 6;
  std::size_t length = 30;  ///< of the standard fields; extra bytes follow
  bool extended = true;
  int classification = 16, scan_angle = 18, user_data = 17, point_source_id = 20;
  int gps_time = 22, rgb = -1, nir = -1, waveform = -1;

  static LasRecordLayout of(int format);  ///< 0 … 10, UsageError otherwise
};

/// Degrees per unit of the scan angle in formats 6-10.
inline constexpr double kLasScanAngleStep = 0.006;

/// Raw records to columns. x = X scale + offset, in double; what the format lacks is zero.
void decodeLasRecords(const std::byte* records, std::size_t count, std::size_t record_length,
                      const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                      const Eigen::Vector3d& offset, PointChunk& chunk);

/** \brief Columns to raw records; bytes of the standard fields that PointChunk lacks (user data,
 * colours, waveform) and the extra bytes are zeroed.
 *
 * What the format cannot carry (a coordinate out of the 32-bit range, return number 9 or class 64
 * in format 1, …) is an InputError: "NAME: point 12: …".
 */
void encodeLasRecords(const PointChunk& chunk, std::size_t record_length,
                      const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                      const Eigen::Vector3d& offset, std::uint64_t first_index,
                      const std::string& name, std::byte* records);

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
