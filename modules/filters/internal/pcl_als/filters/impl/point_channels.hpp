// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <pcl/common/io.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/system_lookup.h>

namespace pcl_als {

/** \brief The channel of the scanner of each point of a cloud, in the field by which a calibration
 * divides strips: bits 6 and 7 of the flags, a registered field of the point type with whole
 * numbers from 0 to 255, or a column beside the cloud.
 */
template <typename PointT>
class PointChannels {
 public:
  /// \a column: of all points of the cloud; empty: from the point type. UsageError naming what the
  /// points lack, because they would be corrected by the biases of another system.
  PointChannels(const SystemLookup& systems, const std::vector<std::uint8_t>& column,
                const std::string& filter)
      : column_(column), where_(filter + ": field '" + systems.channelField() + "'") {
    if (column_.empty()) findField(systems.channelField());
    const std::string objection = systems.objection(HasSourceId<PointT>::value, recorded());
    if (objection.empty()) return;
    throw UsageError(filter + ": " + objection +
                     (HasSourceId<PointT>::value || !systems.strip().empty()
                          ? ": call setChannels with the channels of the points, or use a point "
                            "type with this field"
                          : ": call setStripId"));
  }

  bool recorded() const { return !column_.empty() || field_.has_value(); }
  /// The channel of the point of an index; 0 where none is recorded.
  std::uint8_t of(const PointT& point, std::size_t index) const {
    if (!column_.empty()) return column_[index];
    if (!field_) return 0;
    const double value = valueAt(reinterpret_cast<const char*>(&point) + field_->offset);
    return static_cast<std::uint8_t>(channelOfValue(value, where_) >> shift_);
  }

 private:
  void findField(const std::string& channel_field) {
    if (channel_field.empty()) return;
    const bool from_flags = channel_field == "scanner_channel";
    for (const pcl::PCLPointField& field : pcl::getFields<PointT>()) {
      if (field.name == (from_flags ? "flags" : channel_field) && field.count == 1) field_ = field;
    }
    shift_ = from_flags ? 6U : 0U;
  }

  double valueAt(const char* at) const {
    switch (field_->datatype) {
      case pcl::PCLPointField::INT8:
        return valueAs<std::int8_t>(at);
      case pcl::PCLPointField::UINT8:
        return valueAs<std::uint8_t>(at);
      case pcl::PCLPointField::INT16:
        return valueAs<std::int16_t>(at);
      case pcl::PCLPointField::UINT16:
        return valueAs<std::uint16_t>(at);
      case pcl::PCLPointField::INT32:
        return valueAs<std::int32_t>(at);
      case pcl::PCLPointField::UINT32:
        return valueAs<std::uint32_t>(at);
      case pcl::PCLPointField::FLOAT32:
        return valueAs<float>(at);
      default:
        return valueAs<double>(at);
    }
  }
  template <typename T>
  static double valueAs(const char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return static_cast<double>(value);
  }

  const std::vector<std::uint8_t>& column_;
  const std::string where_;  ///< the channel is, for messages
  std::optional<pcl::PCLPointField> field_;
  unsigned shift_ = 0;
};

}  // namespace pcl_als
