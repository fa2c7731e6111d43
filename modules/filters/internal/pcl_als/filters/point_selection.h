// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include <pcl/filters/filter_indices.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_fields.h>
#include <pcl_als/common/point_types.h>

namespace pcl_als {

/** \brief Common base of the filters that select points: PCL's rules, a frame and threads.
 *
 * As in PCL, points outside setIndices() are neither selected nor removed, setNegative() inverts
 * the selection, setKeepOrganized() replaces the coordinates of removed points instead of removing
 * them, and getRemovedIndices() lists these where the constructor was given true. Points that are
 * not finite are never selected, with setNegative() neither, and count as removed.
 */
template <typename PointT>
class PointSelection : public pcl::FilterIndices<PointT> {
 public:
  using Ptr = std::shared_ptr<PointSelection<PointT>>;
  using ConstPtr = std::shared_ptr<const PointSelection<PointT>>;
  using PointCloud = typename pcl::FilterIndices<PointT>::PointCloud;
  using PointCloudConstPtr = typename PointCloud::ConstPtr;

  /// Frame of the cloud's coordinates, Strip::frame; default: the origin of the ground frame.
  void setLocalFrame(const LocalFrame& frame) { frame_ = frame; }
  const LocalFrame& getLocalFrame() const { return frame_; }

  /// 0: all cores; the result does not depend on it. Default 0.
  void setNumberOfThreads(int threads) { threads_ = requiredThreads(threads); }
  int getNumberOfThreads() const { return threads_; }

 protected:
  explicit PointSelection(bool extract_removed_indices)
      : pcl::FilterIndices<PointT>(extract_removed_indices) {}

  using pcl::FilterIndices<PointT>::applyFilter;
  void applyFilter(pcl::Indices& indices) override;

  /// Whether each of these points of the input, all finite, is selected.
  virtual std::vector<bool> select(const pcl::Indices& points) = 0;

  LocalFrame frame_;
  int threads_ = 0;
};

template <typename PointT>
void PointSelection<PointT>::applyFilter(pcl::Indices& indices) {
  pcl::Indices finite;
  finite.reserve(this->indices_->size());
  for (const auto index : *this->indices_) {
    const PointFields<PointT> point{(*this->input_)[static_cast<std::size_t>(index)]};
    if (point.isFinite()) finite.push_back(index);
  }
  const std::vector<bool> selected = select(finite);
  pcl::Indices kept, removed;
  std::size_t next = 0;
  for (const auto index : *this->indices_) {
    const bool is_finite = next < finite.size() && finite[next] == index;
    const bool keep = is_finite && selected[next] != this->negative_;
    if (is_finite) ++next;
    if (keep)
      kept.push_back(index);
    else if (this->extract_removed_indices_)
      removed.push_back(index);
  }
  indices = std::move(kept);
  *this->removed_indices_ = std::move(removed);
}

}  // namespace pcl_als
