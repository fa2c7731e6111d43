// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <pcl_als/filters/point_selection.h>
#include <pcl_als/tin/surface_criterion.h>

namespace pcl_als {

/** \brief Selects the points of a strip that lie on a surface suitable for measurement.
 *
 * The criterion is the one by which the calibration chooses points (SurfaceCriterion,
 * suitablePoints(); Habib et al. 2011, section 2.3: patches of a TIN): a single return in a
 * neighbourhood that is plane within the limit of roughness, inside the strip, not beside a void,
 * and not as steep as a wall. The TIN consists of the last returns of the whole cloud that are not
 * classified as vegetation (3-5) or noise (7, 18) and not withheld: setIndices() limits the
 * selection and not the surface. Leaves, wires, edges of roofs, and points at the border of the
 * cloud are excluded.
 *
 * The cloud must be one strip: with several, the offsets between them would count as roughness.
 * Fields used where the type has them: return_number and number_of_returns, classification, flags.
 * For other types than PointLidar include impl/surface_selection.hpp. Memory: about 40 bytes per
 * point, and 200 per point of a square of 50 m and thread.
 * \code
 * pcl_als::SurfaceSelection<pcl_als::PointLidar> surfaces;
 * surfaces.setInputCloud(strip.cloud);
 * surfaces.setLocalFrame(strip.frame);
 * surfaces.filter(measurable);
 * \endcode
 */
template <typename PointT>
class SurfaceSelection : public PointSelection<PointT> {
 public:
  using Ptr = std::shared_ptr<SurfaceSelection<PointT>>;
  using ConstPtr = std::shared_ptr<const SurfaceSelection<PointT>>;

  explicit SurfaceSelection(bool extract_removed_indices = false)
      : PointSelection<PointT>(extract_removed_indices) {
    this->filter_name_ = "SurfaceSelection";
  }

  /// The criterion of suitable surfaces; default: that of the calibration.
  void setCriterion(const SurfaceCriterion& criterion) { criterion_ = criterion; }
  const SurfaceCriterion& getCriterion() const { return criterion_; }

  /// Size of the squares that are triangulated, and the automatic limit of roughness; UsageError
  /// (in filter()) for values out of range. The number of threads is that of setNumberOfThreads().
  void setSettings(const SuitablePointsSettings& settings) { settings_ = settings; }
  const SuitablePointsSettings& getSettings() const { return settings_; }

  /// Whether last returns of pulses with several returns may be selected; default false.
  void setMultipleReturns(bool use) { multiple_returns_ = use; }
  bool getMultipleReturns() const { return multiple_returns_; }

 protected:
  std::vector<bool> select(const pcl::Indices& points) override;

 private:
  static bool isSurfacePoint(const PointFields<PointT>& point);

  SurfaceCriterion criterion_;
  SuitablePointsSettings settings_;
  bool multiple_returns_ = false;
};

extern template class SurfaceSelection<PointLidar>;

}  // namespace pcl_als
