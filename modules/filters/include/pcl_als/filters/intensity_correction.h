// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include <pcl/filters/filter.h>
#include <pcl/point_types.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/common/time_alignment.h>
#include <pcl_als/radiometry/radiometric_model.h>

namespace pcl_als {

/** \brief Corrects the intensity of a strip for range, incidence and atmosphere.
 *
 * I_c = I / g (r / r0)^m / cos(theta)^k exp(2 a (r - r0)): Habib, Kersting, Shaker, Yan 2011, Eq.
 * (35)-(36), for extended targets, at a reference range; see RadiometricModel for the terms, and
 * extinctionOf() for a.
 *
 * The cloud is one strip, relative to its LocalFrame, with the coordinates of the calibrated
 * geometry. The normals are those of setInputNormals(), or of local planes (LocalSurfaces) of the
 * single and last returns. Leaves, wires and edges have no plane, and returns before the last have
 * only a part of the energy of their pulse: both are corrected for range and atmosphere only.
 * getCounts() counts them.
 *
 * Fields needed: x, y, z, intensity (float), gps_time (double), return_number and
 * number_of_returns; for other types than PointLidar include impl/intensity_correction.hpp. All
 * other fields are kept bit for bit; the input is not changed. Points that are not finite or not
 * below the sensor, and points outside given indices, stay unchanged. InputError for points that
 * the trajectory does not cover, unless setKeepUncovered(true), and for a cloud most of whose
 * points cannot have been measured from the trajectory (setLocalFrame() was not called, or the
 * trajectory is of another flight).
 * \code
 * pcl_als::IntensityCorrection<pcl_als::PointLidar> correction;
 * correction.setTrajectory(trajectory);
 * pcl_als::RadiometricModel model;
 * model.extinction_per_km = pcl_als::extinctionOf(weather).total();
 * correction.setModel(model);
 * correction.setLocalFrame(strip.frame);
 * correction.setInputCloud(strip.cloud);
 * correction.filter(*strip.cloud);
 * \endcode
 */
template <typename PointT>
class IntensityCorrection : public pcl::Filter<PointT> {
 public:
  using Ptr = std::shared_ptr<IntensityCorrection<PointT>>;
  using ConstPtr = std::shared_ptr<const IntensityCorrection<PointT>>;
  using PointCloud = typename pcl::Filter<PointT>::PointCloud;
  using NormalsConstPtr = pcl::PointCloud<pcl::Normal>::ConstPtr;
  using Counts = std::array<std::size_t, kRadiometryStatusCount>;

  IntensityCorrection() { this->filter_name_ = "IntensityCorrection"; }

  void setTrajectory(std::shared_ptr<const Trajectory> trajectory) {
    trajectory_ = std::move(trajectory);
  }
  std::shared_ptr<const Trajectory> getTrajectory() const { return trajectory_; }

  /// Frame of the cloud's coordinates, Strip::frame; default: the origin of the ground frame.
  void setLocalFrame(const LocalFrame& frame) { frame_ = frame; }
  const LocalFrame& getLocalFrame() const { return frame_; }

  /// Terms and their weights; UsageError (in filter()) for values out of range.
  void setModel(const RadiometricModel& model) { model_ = model; }
  const RadiometricModel& getModel() const { return model_; }

  /// Known factor g of the strip's intensities (receiver, pulse energy), > 0; default 1. UsageError
  /// (in filter()) for another value.
  void setGain(double gain) { gain_ = gain; }
  double getGain() const { return gain_; }

  /// Normals of the input cloud, one per point; NaN: no surface. Null (default): local planes.
  void setInputNormals(NormalsConstPtr normals) { normals_ = std::move(normals); }
  NormalsConstPtr getInputNormals() const { return normals_; }

  /// Settings of the local planes, if no normals are set.
  void setSurfaceSettings(const LocalSurfaceSettings& settings) { surfaces_ = settings; }
  const LocalSurfaceSettings& getSurfaceSettings() const { return surfaces_; }

  /// Conversion of point times to those of the trajectory; default: they are the same.
  void setTimeAlignment(const TimeAlignment& alignment) { alignment_ = alignment; }
  const TimeAlignment& getTimeAlignment() const { return alignment_; }

  /// Keeps points without a trajectory unchanged instead of refusing the cloud; default false.
  void setKeepUncovered(bool keep) { keep_uncovered_ = keep; }
  bool getKeepUncovered() const { return keep_uncovered_; }

  /// 0: all cores; the result does not depend on it. Default 0.
  void setNumberOfThreads(int threads) { threads_ = requiredThreads(threads); }
  int getNumberOfThreads() const { return threads_; }

  /// Numbers of points of the last filter() by RadiometryStatus.
  const Counts& getCounts() const { return counts_; }
  /// Range, incidence and status of every input point of the last filter(), 40 bytes each.
  const std::vector<PointRadiometry>& getRadiometry() const { return radiometry_; }

 protected:
  void applyFilter(PointCloud& output) override;

 private:
  void checkSettings() const;

  std::shared_ptr<const Trajectory> trajectory_;
  NormalsConstPtr normals_;
  LocalFrame frame_;
  RadiometricModel model_;
  LocalSurfaceSettings surfaces_;
  TimeAlignment alignment_;
  double gain_ = 1.0;
  bool keep_uncovered_ = false;
  int threads_ = 0;
  Counts counts_{};
  std::vector<PointRadiometry> radiometry_;
};

extern template class IntensityCorrection<PointLidar>;

}  // namespace pcl_als
