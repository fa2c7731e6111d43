// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include <pcl/point_types.h>

#include <pcl_als/common/time_alignment.h>
#include <pcl_als/filters/point_selection.h>
#include <pcl_als/radiometry/local_surfaces.h>
#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {

/** \brief Selects points by their incidence angle, the angle between the pulse and the normal of
 * the surface.
 *
 * The pulse starts at the trajectory's position at the time of the point (RadiometricEvaluator); 0
 * degrees is perpendicular incidence. The normals are those of setInputNormals(), of either sign,
 * or of local planes (LocalSurfaces) of the last returns of the cloud, which must be one strip. A
 * point has no incidence angle and is not selected if it has no surface (leaves, wires, edges), if
 * it is not a last return or not below the sensor, or if the trajectory does not cover its time.
 *
 * The point type needs x, y, z (float) and gps_time (double); return_number and number_of_returns
 * are used where the type has them. For other types than PointLidar include
 * impl/incidence_selection.hpp.
 * \code
 * pcl_als::IncidenceSelection<pcl_als::PointLidar> incidence;
 * incidence.setInputCloud(strip.cloud);
 * incidence.setLocalFrame(strip.frame);
 * incidence.setTrajectory(trajectory);  // std::shared_ptr<const pcl_als::Trajectory>
 * incidence.setAngleLimits(0.0, 30.0);  // degrees
 * incidence.filter(steep_view);
 * \endcode
 */
template <typename PointT>
class IncidenceSelection : public PointSelection<PointT> {
 public:
  using Ptr = std::shared_ptr<IncidenceSelection<PointT>>;
  using ConstPtr = std::shared_ptr<const IncidenceSelection<PointT>>;
  using NormalsConstPtr = pcl::PointCloud<pcl::Normal>::ConstPtr;

  explicit IncidenceSelection(bool extract_removed_indices = false)
      : PointSelection<PointT>(extract_removed_indices) {
    this->filter_name_ = "IncidenceSelection";
  }

  void setTrajectory(std::shared_ptr<const Trajectory> trajectory) {
    trajectory_ = std::move(trajectory);
  }
  std::shared_ptr<const Trajectory> getTrajectory() const { return trajectory_; }

  /// Limits of the angles of the selected points (included), degrees; default 0 and 90. UsageError
  /// unless 0 <= minimum <= maximum <= 90.
  void setAngleLimits(double minimum, double maximum);
  double getMinimumAngle() const { return minimum_; }
  double getMaximumAngle() const { return maximum_; }

  /// Normals of the input cloud, one per point; NaN: no surface. Null (default): local planes.
  void setInputNormals(NormalsConstPtr normals) { normals_ = std::move(normals); }
  NormalsConstPtr getInputNormals() const { return normals_; }

  /// Settings of the local planes, if no normals are set.
  void setSurfaceSettings(const LocalSurfaceSettings& settings) { surfaces_ = settings; }
  const LocalSurfaceSettings& getSurfaceSettings() const { return surfaces_; }

  /// Conversion of point times to those of the trajectory; default: they are the same.
  void setTimeAlignment(const TimeAlignment& alignment) { alignment_ = alignment; }
  const TimeAlignment& getTimeAlignment() const { return alignment_; }

  /// Incidence angles of the finite points of the last filter() in their order, degrees; NaN: none.
  const std::vector<float>& getAngles() const { return angles_; }
  /// Number of points of the last filter() whose time the trajectory does not cover.
  std::size_t getUncovered() const { return uncovered_; }

 protected:
  /// UsageError without a trajectory, or unless there is one normal per point; InputError if the
  /// trajectory covers none of the points, or if most of them cannot have been measured from it
  /// (setLocalFrame() was not called, or the trajectory is of another flight).
  std::vector<bool> select(const pcl::Indices& points) override;

 private:
  std::shared_ptr<const Trajectory> trajectory_;
  NormalsConstPtr normals_;
  LocalSurfaceSettings surfaces_;
  TimeAlignment alignment_;
  double minimum_ = 0.0, maximum_ = 90.0;
  std::vector<float> angles_;
  std::size_t uncovered_ = 0;
};

extern template class IncidenceSelection<PointLidar>;

}  // namespace pcl_als
