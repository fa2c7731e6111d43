// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/time_alignment.h>

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

/** \brief Byte positions of the fields of a LAS point record (LAS 1.4 R15, tables 7-17), and the
 * scale of its GPS time.
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
  double time_shift = 0.0;  ///< LasHeader::timeShift(), seconds

  /// GPS time of a record in seconds, of the week or adjusted standard time; 0 where it has none.
  double timeOf(const std::byte* record) const {
    if (gps_time < 0) return 0.0;
    const double seconds = secondsOfTime(loadLas<double>(record + gps_time));
    return seconds == 0.0 ? 0.0 : seconds + time_shift;
  }
  /// Stores what timeOf() returns. The format must have a GPS time.
  void storeTime(double seconds, std::byte* record) const {
    storeLas(record + gps_time, seconds == 0.0 ? 0.0 : seconds - time_shift);
  }

  /// X, Y or Z (axis 0, 1, 2) in coordinate steps of the file.
  static std::int32_t coordinateOf(const std::byte* record, int axis) {
    return loadLas<std::int32_t>(record + 4 * axis);
  }
  static void storeCoordinate(std::int32_t value, int axis, std::byte* record) {
    storeLas(record + 4 * axis, value);
  }
  static Eigen::Vector3d positionOf(const std::byte* record, const Eigen::Vector3d& scale,
                                    const Eigen::Vector3d& offset) {
    const Eigen::Vector3d raw(coordinateOf(record, 0), coordinateOf(record, 1),
                              coordinateOf(record, 2));
    return raw.cwiseProduct(scale) + offset;
  }
  /// X, Y, Z and, in the last lane, other fields, for comparisons of many records at once.
  using Lanes = std::int32_t __attribute__((vector_size(16)));
  static Lanes lanesOf(const std::byte* record) { return loadLas<Lanes>(record); }
  static std::uint16_t intensityOf(const std::byte* record) {
    return loadLas<std::uint16_t>(record + kIntensity);
  }
  static void storeIntensity(std::uint16_t value, std::byte* record) {
    storeLas(record + kIntensity, value);
  }
  unsigned returnNumberOf(const std::byte* record) const {
    return std::to_integer<unsigned>(record[kReturns]) & (extended ? 15U : 7U);
  }
  unsigned numberOfReturnsOf(const std::byte* record) const {
    return std::to_integer<unsigned>(record[kReturns]) >> (extended ? 4U : 3U) &
           (extended ? 15U : 7U);
  }
  /// The class; formats 0-5 keep flags in the upper three bits of its byte.
  std::uint8_t classOf(const std::byte* record) const {
    return static_cast<std::uint8_t>(std::to_integer<unsigned>(record[classification]) &
                                     (extended ? 255U : 31U));
  }
  void storeClass(std::uint8_t code, std::byte* record) const {
    const std::byte flags = extended ? std::byte{0} : record[classification] & std::byte{0xE0};
    record[classification] = flags | std::byte{code};
  }
  std::uint16_t sourceOf(const std::byte* record) const {
    return loadLas<std::uint16_t>(record + point_source_id);
  }
  void storeSource(std::uint16_t id, std::byte* record) const {
    storeLas(record + point_source_id, id);
  }
  /// The scan direction flag: true for a scan to the right.
  bool scanDirectionOf(const std::byte* record) const {
    return (record[extended ? kReturns + 1 : kReturns] & std::byte{0x40}) != std::byte{0};
  }
  static LasRecordLayout of(int format);  ///< 0 … 10, UsageError otherwise

 private:
  static constexpr std::size_t kIntensity = 12, kReturns = 14;
};

/// Degrees per unit of the scan angle in formats 6-10.
inline constexpr double kLasScanAngleStep = 0.006;

/// Raw records to columns. x = X scale + offset, in double; what the format lacks is zero.
void decodeLasRecords(const std::byte* records, std::size_t count, std::size_t record_length,
                      const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                      const Eigen::Vector3d& offset, PointChunk& chunk);

/** \brief Columns to raw records; bytes of the standard fields that PointChunk lacks (colours,
 * waveform) and the extra bytes are zeroed.
 *
 * The scanner channel of formats 6-10, which has two bits, is that of PointChunk::flags.
 *
 * What the format cannot carry (a coordinate out of the 32-bit range, return number 9 or class 64
 * in format 1, …) is an InputError: "NAME: point 12: …".
 */
void encodeLasRecords(const PointChunk& chunk, std::size_t record_length,
                      const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                      const Eigen::Vector3d& offset, std::uint64_t first_index,
                      const std::string& name, std::byte* records);

}  // namespace pcl_als
