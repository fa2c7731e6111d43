// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/filters/intensity_correction.h>

namespace pcl_als {

template <typename PointT>
void IntensityCorrection<PointT>::checkSettings() const {
  if (!trajectory_) throw UsageError("IntensityCorrection: no trajectory is set");
  if (!std::isfinite(gain_) || gain_ <= 0.0)
    throw UsageError("IntensityCorrection: the gain must be more than 0");
  if (normals_ && normals_->size() != this->input_->size())
    throw UsageError("IntensityCorrection: " + std::to_string(normals_->size()) + " normals for " +
                     std::to_string(this->input_->size()) + " points");
}

/// Single and last returns, which are those on surfaces.
template <typename PointT>
std::vector<Eigen::Vector3f> IntensityCorrection<PointT>::surfacePoints() const {
  std::vector<Eigen::Vector3f> points;
  if (normals_) return points;
  for (const PointT& point : *this->input_) {
    const Eigen::Vector3f place(point.x, point.y, point.z);
    if (point.return_number >= point.number_of_returns && place.allFinite())
      points.push_back(place);
  }
  return points;
}

template <typename PointT>
void IntensityCorrection<PointT>::applyFilter(PointCloud& output) {
  constexpr std::size_t kChunk = 16384;  // divides the work
  checkSettings();
  const RadiometricEvaluator evaluator(trajectory_, model_);
  const LocalSurfaces surfaces(surfacePoints(), surfaces_);
  const std::size_t count = this->indices_->size();
  radiometry_.assign(this->input_->size(), PointRadiometry());
  output = *this->input_;
  parallelFor((count + kChunk - 1) / kChunk, threads_, [&](std::size_t chunk) {
    RadiometryCursor cursor;
    for (std::size_t i = chunk * kChunk; i < std::min(count, (chunk + 1) * kChunk); ++i) {
      const auto index = static_cast<std::size_t>((*this->indices_)[i]);
      const PointT& point = (*this->input_)[index];
      const Eigen::Vector3f place(point.x, point.y, point.z);
      LocalSurface surface;
      if (normals_) {
        surface.normal = (*normals_)[index].getNormalVector3fMap().normalized();
        surface.support = 1;
      } else if (point.return_number >= point.number_of_returns) {
        surface = surfaces.at(place);
      }
      const RadiometryPoint where{alignment_(point.gps_time), frame_.toGround(place),
                                  point.return_number, point.number_of_returns};
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
