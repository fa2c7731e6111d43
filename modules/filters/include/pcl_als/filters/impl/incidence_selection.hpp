// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/filters/impl/cloud_surfaces.hpp>
#include <pcl_als/filters/incidence_selection.h>
#include <pcl_als/filters/trajectory_reach.h>

namespace pcl_als {

template <typename PointT>
void IncidenceSelection<PointT>::setAngleLimits(double minimum, double maximum) {
  if (!(minimum >= 0.0 && minimum <= maximum && maximum <= 90.0))
    throw UsageError(
        "IncidenceSelection: the angles must be 0 <= minimum <= maximum <= 90 degrees, not " +
        std::to_string(minimum) + " and " + std::to_string(maximum));
  minimum_ = minimum;
  maximum_ = maximum;
}

template <typename PointT>
std::vector<bool> IncidenceSelection<PointT>::select(const pcl::Indices& points) {
  static_assert(HasGpsTime<PointT>::value,
                "IncidenceSelection needs a point type with x, y, z and gps_time (double)");
  constexpr std::size_t kChunk = 16384;  // divides the work
  if (!trajectory_) throw UsageError("IncidenceSelection: no trajectory is set");
  CloudSurfaces<PointT>::requireOnePerPoint(normals_, this->input_->size(), "IncidenceSelection");
  requireReach(*this->input_, points, this->frame_, trajectory_, alignment_, this->filter_name_);
  const RadiometricEvaluator evaluator(trajectory_, RadiometricModel());
  const CloudSurfaces<PointT> surfaces(*this->input_, normals_, surfaces_);
  std::vector<std::uint8_t> covered(points.size());
  angles_.assign(points.size(), std::numeric_limits<float>::quiet_NaN());
  parallelFor((points.size() + kChunk - 1) / kChunk, this->threads_, [&](std::size_t chunk) {
    RadiometryCursor cursor;
    for (std::size_t i = chunk * kChunk; i < std::min(points.size(), (chunk + 1) * kChunk); ++i) {
      const auto index = static_cast<std::size_t>(points[i]);
      const PointFields<PointT> fields{(*this->input_)[index]};
      const bool last = CloudSurfaces<PointT>::isLast(fields);
      const PointRadiometry found = evaluator.evaluate(
          CloudSurfaces<PointT>::returnOf(fields, this->frame_.toGround(fields.position()),
                                          alignment_(fields.gpsTime())),
          last ? surfaces.at(index) : LocalSurface(), cursor);
      covered[i] = found.status != RadiometryStatus::uncovered ? 1 : 0;
      angles_[i] = static_cast<float>(static_cast<double>(found.incidence) / kRadiansPerDegree);
    }
  });
  uncovered_ = static_cast<std::size_t>(std::count(covered.begin(), covered.end(), 0));
  if (!points.empty() && uncovered_ == points.size())
    throw InputError("IncidenceSelection: the trajectory covers the time of none of the " +
                     std::to_string(points.size()) + " points");
  std::vector<bool> selected;
  selected.reserve(points.size());
  for (const float angle : angles_)
    selected.push_back(static_cast<double>(angle) >= minimum_ &&
                       static_cast<double>(angle) <= maximum_);
  return selected;
}

}  // namespace pcl_als
