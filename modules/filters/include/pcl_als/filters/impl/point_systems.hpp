// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include <pcl/common/io.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/system_lookup.h>

namespace pcl_als {

/** \brief The system of each point of a cloud, by its point source id and the channel of the
 * scanner, as of the records of a file (IntegerBiasCorrection).
 *
 * The channel is that of the field that the calibration divides strips by: bits of the flags, or a
 * registered field of one byte, such as user_data. UsageError naming the field that a point type
 * lacks, because its points would be corrected by the biases of another channel.
 */
template <typename PointT>
class PointSystems {
 public:
  PointSystems(const SystemLookup& systems, const std::string& filter) : systems_(systems) {
    if (systems.single()) return;
    if (!HasSourceId<PointT>::value && systems.strip().empty())
      throw UsageError(filter +
                       ": the calibration has several systems or fixed strips, and the point type "
                       "has no field point_source_id: call setStripId with the id of the strip");
    const std::string& field = systems.channelField();
    if (field.empty()) return;
    const bool from_flags = field == "scanner_channel";
    const std::size_t position = positionOf(from_flags ? "flags" : field, filter);
    position_ = static_cast<std::ptrdiff_t>(position);
    shift_ = from_flags ? 6U : 0U;
  }

  std::uint8_t of(const PointT& point) {
    const std::uint16_t source = PointFields<PointT>{point}.sourceId();
    const std::uint8_t channel = channelOf(point);
    if (!known_ || source != source_ || channel != channel_) {
      system_ = systems_.of(source, channel);
      source_ = source, channel_ = channel, known_ = true;
    }
    return system_;
  }

 private:
  static std::size_t positionOf(const std::string& name, const std::string& filter) {
    for (const pcl::PCLPointField& field : pcl::getFields<PointT>()) {
      if (field.name == name && field.datatype == pcl::PCLPointField::UINT8) return field.offset;
    }
    throw UsageError(filter + ": the calibration divides strips by the channel of the scanner in " +
                     "the field " + name + ", which the point type does not have as uint8: use " +
                     "points with this field, or correct the files");
  }

  std::uint8_t channelOf(const PointT& point) const {
    if (position_ < 0) return 0;
    std::uint8_t byte = 0;
    std::memcpy(&byte, reinterpret_cast<const char*>(&point) + position_, 1);
    return static_cast<std::uint8_t>(byte >> shift_);
  }

  const SystemLookup& systems_;
  std::ptrdiff_t position_ = -1;  ///< of the byte with the channel in a point; -1: not needed
  unsigned shift_ = 0;
  bool known_ = false;  ///< of the point before, for runs of points of one system
  std::uint16_t source_ = 0;
  std::uint8_t channel_ = 0, system_ = 0;
};

}  // namespace pcl_als
