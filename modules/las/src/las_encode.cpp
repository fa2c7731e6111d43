// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <limits>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/las/las_record.h>

#include "las_bytes.h"

namespace pcl_als {
namespace {

/// Nearest integer, ties to even, for |value| < 2^51 (a larger one stays large). The sum drops the
/// fraction; std::nearbyint is a library call on plain x86-64, ten times slower.
double nearestInteger(double value) {
  constexpr double kDropFraction = 6755399441055744.0;  // 1.5 * 2^52
  return (value + kDropFraction) - kDropFraction;
}

/// Encodes one point; knows what to say when the format cannot carry a value.
class Encoder {
 public:
  Encoder(const PointChunk& chunk, const LasRecordLayout& layout, const Eigen::Vector3d& scale,
          const Eigen::Vector3d& offset, std::uint64_t first_index, const std::string& name)
      : chunk_(chunk),
        layout_(layout),
        scale_(scale),
        offset_(offset),
        first_index_(first_index),
        name_(name) {}

  void encode(std::size_t i, std::byte* record) const {
    storeLas(record, coordinate(i, 0, chunk_.x[i]));
    storeLas(record + 4, coordinate(i, 1, chunk_.y[i]));
    storeLas(record + 8, coordinate(i, 2, chunk_.z[i]));
    storeLas(record + 12, rounded<std::uint16_t>(i, chunk_.intensity[i], "intensity"));
    storeLas(record + layout_.point_source_id, chunk_.point_source_id[i]);
    record[layout_.user_data] = static_cast<std::byte>(chunk_.user_data[i]);
    if (layout_.gps_time >= 0) layout_.storeTime(chunk_.gps_time[i], record);
    if (layout_.extended)
      encodeExtendedBits(i, record);
    else
      encodeLegacyBits(i, record);
  }

 private:
  std::int32_t coordinate(std::size_t i, int axis, double value) const {
    const double units = nearestInteger((value - offset_[axis]) / scale_[axis]);
    if (units >= std::numeric_limits<std::int32_t>::min() &&
        units <= std::numeric_limits<std::int32_t>::max())
      return static_cast<std::int32_t>(units);
    std::ostringstream text;
    text.precision(12);
    text << "xyz"[axis] << " = " << value << " does not fit offset " << offset_[axis]
         << " and scale " << scale_[axis] << " of the file";
    fail(i, text.str());
  }

  template <typename T>
  T rounded(std::size_t i, double value, const char* what) const {
    const double nearest = nearestInteger(value);
    if (nearest >= std::numeric_limits<T>::min() && nearest <= std::numeric_limits<T>::max())
      return static_cast<T>(nearest);
    refuse(i, what, value);
  }

  void encodeExtendedBits(std::size_t i, std::byte* record) const {
    const unsigned number = chunk_.return_number[i], returns = chunk_.number_of_returns[i];
    if (number > 15) refuse(i, "return number", number);
    if (returns > 15) refuse(i, "number of returns", returns);
    const unsigned flags = chunk_.flags[i];
    record[14] = static_cast<std::byte>(number | (returns << 4U));
    record[15] =
        static_cast<std::byte>((flags & 15U) | ((flags & 0x30U) << 2U) | ((flags & 0xC0U) >> 2U));
    record[16] = static_cast<std::byte>(chunk_.classification[i]);
    const double angle = chunk_.scan_angle[i] / kLasScanAngleStep;
    storeLas(record + 18, rounded<std::int16_t>(i, angle, "scan angle in 0.006 degrees"));
  }

  void encodeLegacyBits(std::size_t i, std::byte* record) const {
    const unsigned number = chunk_.return_number[i], returns = chunk_.number_of_returns[i];
    if (number > 7) refuse(i, "return number", number);
    if (returns > 7) refuse(i, "number of returns", returns);
    if (chunk_.classification[i] > 31) refuse(i, "class", chunk_.classification[i]);
    const unsigned flags = chunk_.flags[i];
    if ((flags & kOverlap) != 0) refuse(i, "overlap flag", 1);
    if ((flags & 0xC0U) != 0) refuse(i, "scanner channel", flags >> 6U);
    record[14] = static_cast<std::byte>(number | (returns << 3U) | ((flags & 0x30U) << 2U));
    record[15] = static_cast<std::byte>(chunk_.classification[i] | ((flags & 7U) << 5U));
    storeLas(record + 16, rounded<std::int8_t>(i, chunk_.scan_angle[i], "scan angle"));
  }

  [[noreturn]] void refuse(std::size_t i, const char* what, double value) const {
    std::ostringstream text;
    text << what << ' ' << value << " cannot be kept in point format " << layout_.format;
    fail(i, text.str());
  }

  [[noreturn]] void fail(std::size_t i, const std::string& what) const {
    throw InputError(name_ + ": point " + std::to_string(first_index_ + i) + ": " + what);
  }

  const PointChunk& chunk_;
  const LasRecordLayout& layout_;
  const Eigen::Vector3d scale_, offset_;
  const std::uint64_t first_index_;
  const std::string& name_;
};

}  // namespace

void encodeLasRecords(const PointChunk& chunk, std::size_t record_length,
                      const LasRecordLayout& layout, const Eigen::Vector3d& scale,
                      const Eigen::Vector3d& offset, std::uint64_t first_index,
                      const std::string& name, std::byte* records) {
  const Encoder encoder(chunk, layout, scale, offset, first_index, name);
  if (chunk.size() == 0) return;  // records may be null
  std::memset(records, 0, chunk.size() * record_length);
  for (std::size_t i = 0; i < chunk.size(); ++i) encoder.encode(i, records + i * record_length);
}

}  // namespace pcl_als
