// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/point_flag.h>
#include <pcl_als/common/time_unit.h>
#include <pcl_als/filters/impl/point_channels.hpp>
#include <pcl_als/filters/system_bias_correction.h>
#include <pcl_als/filters/trajectory_reach.h>

namespace pcl_als {

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
    columns[0].push_back(
        correction.flightTime(secondsOfTime(PointFields<PointT>{point}.gpsTime())));
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
