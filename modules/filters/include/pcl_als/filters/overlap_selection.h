// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include <pcl_als/common/strip.h>
#include <pcl_als/filters/point_selection.h>

namespace pcl_als {

/** \brief Selects the points of a strip that lie where another strip has points.
 *
 * The ground is divided into square cells, counted from the origin of the ground frame. A point is
 * selected if one of the other strips has at least setMinimumPoints() points in its cell. Each
 * cloud is relative to its own LocalFrame. A cell should be some point spacings wide: with smaller
 * cells, gaps between points do not count as overlap, and the border of the overlap is uncertain by
 * the size of a cell.
 *
 * The point type needs x, y, z (float); for other types than PointLidar include
 * impl/overlap_selection.hpp. Time and memory are linear in the number of points and of cells.
 * \code
 * pcl_als::OverlapSelection<pcl_als::PointLidar> overlap;
 * overlap.setInputCloud(a.cloud);
 * overlap.setLocalFrame(a.frame);
 * overlap.addOtherStrip(b.cloud, b.frame);
 * overlap.filter(common);
 * \endcode
 */
template <typename PointT>
class OverlapSelection : public PointSelection<PointT> {
 public:
  using Ptr = std::shared_ptr<OverlapSelection<PointT>>;
  using ConstPtr = std::shared_ptr<const OverlapSelection<PointT>>;
  using PointCloud = typename PointSelection<PointT>::PointCloud;
  using PointCloudConstPtr = typename PointSelection<PointT>::PointCloudConstPtr;

  explicit OverlapSelection(bool extract_removed_indices = false)
      : PointSelection<PointT>(extract_removed_indices) {
    this->filter_name_ = "OverlapSelection";
  }

  /// Adds a strip; UsageError for a null cloud.
  void addOtherStrip(const PointCloudConstPtr& cloud, const LocalFrame& frame);
  /// Replaces all strips that were added.
  void setOtherStrips(const std::vector<Strip<PointT>>& strips);
  void clearOtherStrips() { others_.clear(); }

  /// Side of a cell, metres; default 2. UsageError unless it is above 0.
  void setCellSize(double metres);
  double getCellSize() const { return cell_; }

  /// Smallest number of points of one other strip in a cell; default 1. UsageError for 0.
  void setMinimumPoints(std::size_t points);
  std::size_t getMinimumPoints() const { return minimum_points_; }

 protected:
  /// UsageError if no other strip is set; InputError if the distance of the strips shows that the
  /// frame of one of them was not set.
  std::vector<bool> select(const pcl::Indices& points) override;

 private:
  struct Other {
    PointCloudConstPtr cloud;
    LocalFrame frame;
  };
  void requireSameGround(const pcl::Indices& points) const;
  std::int64_t cellOf(const LocalFrame& frame, const PointT& point) const;
  void addCovered(const Other& other, std::unordered_set<std::int64_t>& covered) const;

  std::vector<Other> others_;
  double cell_ = 2.0;
  std::size_t minimum_points_ = 1;
};

extern template class OverlapSelection<PointLidar>;

}  // namespace pcl_als
