// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include <pcl/common/io.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/lidar_return.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/strip_group.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/filters/trajectory_reach.h>

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

template <typename PointT>
SystemCorrection SystemBiasCorrection<PointT>::usedCorrection() const {
  if (correction_) {
    SystemCorrection correction = *correction_;
    if (!strip_id_.empty()) correction.setStrip(strip_id_);
    return correction;
  }
  if (!trajectory_) throw UsageError("SystemBiasCorrection: no trajectory is set");
  SystemCorrection correction =
      calibration_ ? SystemCorrection(*calibration_, trajectory_,
                                      {strip_corrections_, invert_, false, fallback_attitude_})
                   : SystemCorrection(biases_, trajectory_, invert_);
  correction.setTimeAlignment(alignment_);
  correction.setStrip(strip_id_);
  return correction;
}

template <typename PointT>
void SystemBiasCorrection<PointT>::applyFilter(PointCloud& output) {
  // Division of the work into parts of fixed size, so that results do not depend on the number of
  // threads.
  constexpr std::size_t kChunk = 16384;
  coverage_ = CoverageCount();
  const SystemCorrection correction = usedCorrection();
  if (!channels_.empty() && channels_.size() != this->input_->size())
    throw UsageError(this->filter_name_ + ": there are " + std::to_string(channels_.size()) +
                     " channels for " + std::to_string(this->input_->size()) + " points");
  const PointChannels<PointT> channels(correction.systems(), channels_, this->filter_name_);
  if (check_trajectory_)
    requireReach(*this->input_, *this->indices_, frame_, correction.flight(),
                 correction.timeAlignment(), this->filter_name_);
  const std::size_t count = this->indices_->size();
  const std::size_t chunks = (count + kChunk - 1) / kChunk;
  std::vector<CoverageCount> coverage(chunks);
  output = *this->input_;
  parallelFor(chunks, threads_, [&](std::size_t chunk) {
    const std::size_t first = chunk * kChunk;
    coverage[chunk] =
        correctChunk(correction, channels, first, std::min(first + kChunk, count), output);
  });
  for (const CoverageCount& part : coverage) coverage_.merge(part);
  if (coverage_.unsolved > 0 || (coverage_.missed() > 0 && !keep_uncovered_)) {
    throw InputError("SystemBiasCorrection: " + coverage_.describe(*correction.flight()));
  }
  if (check_trajectory_ && !coverage_.sizes.objection().empty())
    throw InputError(this->filter_name_ + ": " + coverage_.sizes.objection());
  if (coverage_.lacksStripErrors() && !keep_uncovered_)
    throw InputError(
        "SystemBiasCorrection: the calibration has no strip corrections at the times of " +
        std::to_string(coverage_.without_strip_errors) + " points of the cloud");
}

template <typename PointT>
CoverageCount SystemBiasCorrection<PointT>::correctChunk(const SystemCorrection& correction,
                                                         const PointChannels<PointT>& channels,
                                                         std::size_t first, std::size_t last,
                                                         PointCloud& output) const {
  std::vector<std::size_t> chosen;
  std::vector<double> columns[4], changes[3];
  std::vector<float> intensity;
  std::vector<std::int8_t> scan_direction;
  std::vector<std::uint16_t> source;
  std::vector<std::uint8_t> channel;
  chosen.reserve(last - first);
  for (std::vector<double>& column : columns) column.reserve(last - first);
  for (std::size_t i = first; i < last; ++i) {
    const auto index = static_cast<std::size_t>((*this->indices_)[i]);
    const PointT& point = (*this->input_)[index];
    if (!std::isfinite(point.x) || !std::isfinite(point.y) || !std::isfinite(point.z)) continue;
    chosen.push_back(index);
    columns[0].push_back(correction.flightTime(PointFields<PointT>{point}.gpsTime()));
    columns[1].push_back(frame_.origin.x() + static_cast<double>(point.x));
    columns[2].push_back(frame_.origin.y() + static_cast<double>(point.y));
    columns[3].push_back(frame_.origin.z() + static_cast<double>(point.z));
    if constexpr (HasIntensity<PointT>::value) intensity.push_back(point.intensity);
    if constexpr (HasFlags<PointT>::value)
      scan_direction.push_back((point.flags & kScanDirection) != 0 ? -1 : 1);
    if (correction.systems().single()) continue;
    source.push_back(PointFields<PointT>{point}.sourceId());
    channel.push_back(channels.of(point, index));
  }
  for (std::vector<double>& change : changes) change.resize(chosen.size());
  const PointColumns points{columns[0].data(),
                            columns[1].data(),
                            columns[2].data(),
                            columns[3].data(),
                            HasIntensity<PointT>::value ? intensity.data() : nullptr,
                            HasFlags<PointT>::value ? scan_direction.data() : nullptr,
                            HasSourceId<PointT>::value ? source.data() : nullptr,
                            channels.recorded() ? channel.data() : nullptr};
  const EffectColumns change{changes[0].data(), changes[1].data(), changes[2].data()};
  CoverageCount coverage;
  correction.change(points, chosen.size(), change, coverage);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const PointT& from = (*this->input_)[chosen[i]];
    PointT& to = output[chosen[i]];
    to.x = static_cast<float>(static_cast<double>(from.x) + changes[0][i]);
    to.y = static_cast<float>(static_cast<double>(from.y) + changes[1][i]);
    to.z = static_cast<float>(static_cast<double>(from.z) + changes[2][i]);
  }
  return coverage;
}

}  // namespace pcl_als
