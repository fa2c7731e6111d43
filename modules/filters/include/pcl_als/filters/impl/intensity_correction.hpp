// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/filters/impl/cloud_surfaces.hpp>
#include <pcl_als/filters/intensity_correction.h>
#include <pcl_als/filters/trajectory_reach.h>

namespace pcl_als {

template <typename PointT>
void IntensityCorrection<PointT>::checkSettings() const {
  if (!trajectory_) throw UsageError("IntensityCorrection: no trajectory is set");
  if (!std::isfinite(gain_) || gain_ <= 0.0)
    throw UsageError("IntensityCorrection: the gain must be more than 0");
  CloudSurfaces<PointT>::requireOnePerPoint(normals_, this->input_->size(), "IntensityCorrection");
}

template <typename PointT>
void IntensityCorrection<PointT>::applyFilter(PointCloud& output) {
  constexpr std::size_t kChunk = 16384;  // divides the work
  checkSettings();
  requireReach(*this->input_, *this->indices_, frame_, trajectory_, alignment_, this->filter_name_);
  const RadiometricEvaluator evaluator(trajectory_, model_);
  const CloudSurfaces<PointT> surfaces(*this->input_, normals_, surfaces_);
  const std::size_t count = this->indices_->size();
  radiometry_.assign(this->input_->size(), PointRadiometry());
  output = *this->input_;
  parallelFor((count + kChunk - 1) / kChunk, threads_, [&](std::size_t chunk) {
    RadiometryCursor cursor;
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
      const auto index = static_cast<std::size_t>((*this->indices_)[i]);
      const PointT& point = (*this->input_)[index];
      const PointFields<PointT> fields{point};
      const bool has_surface = normals_ || CloudSurfaces<PointT>::isLast(fields);
      const LocalSurface surface = has_surface ? surfaces.at(index) : LocalSurface();
      const LidarReturn where = CloudSurfaces<PointT>::returnOf(
          fields, frame_.toGround(fields.position()), alignment_(fields.gpsTime()));
      PointRadiometry& result = radiometry_[index];
      result = evaluator.evaluate(where, surface, cursor);
      if (!result.corrected()) continue;
      output[index].intensity =
          static_cast<float>(static_cast<double>(point.intensity) * result.factor / gain_);
    }
  });
  counts_.fill(0);
  for (const auto index : *this->indices_)
    ++counts_[static_cast<std::size_t>(radiometry_[static_cast<std::size_t>(index)].status)];
  const std::size_t uncovered = counts_[static_cast<std::size_t>(RadiometryStatus::uncovered)];
  if (uncovered > 0 && !keep_uncovered_)
    throw InputError("IntensityCorrection: the trajectory does not cover the times of " +
                     std::to_string(uncovered) + " of " + std::to_string(count) + " points");
}

}  // namespace pcl_als
