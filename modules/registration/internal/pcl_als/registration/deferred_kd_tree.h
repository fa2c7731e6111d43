// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <utility>
#include <vector>

#include <pcl/search/kdtree.h>

namespace pcl_als {

/** \brief A kd-tree that is built at the first search.
 *
 * pcl::Registration builds one for the target at every align(). Registrations that do not search it
 * pass this tree to the base class: it is built only if getFitnessScore() is called.
 */
template <typename PointT>
class DeferredKdTree : public pcl::search::KdTree<PointT> {
 public:
  using Base = pcl::search::KdTree<PointT>;
  using typename Base::IndicesConstPtr;
  using typename Base::PointCloudConstPtr;

  /// Of PCL's function: void before version 1.14, then a bool that tells success.
  using InputResult = decltype(std::declval<Base&>().setInputCloud(PointCloudConstPtr()));

  InputResult setInputCloud(const PointCloudConstPtr& cloud,
                            const IndicesConstPtr& indices = IndicesConstPtr()) override {
    this->input_ = cloud;
    this->indices_ = indices;
    built_ = false;
    return static_cast<InputResult>(true);
  }

  int nearestKSearch(const PointT& point, int k, pcl::Indices& neighbours,
                     std::vector<float>& distances_sq) const override {
    build();
    return Base::nearestKSearch(point, k, neighbours, distances_sq);
  }

  int radiusSearch(const PointT& point, double radius, pcl::Indices& neighbours,
                   std::vector<float>& distances_sq, unsigned int most = 0) const override {
    build();
    return Base::radiusSearch(point, radius, neighbours, distances_sq, most);
  }

 private:
  void build() const {
    if (built_) return;
    const_cast<DeferredKdTree*>(this)->Base::setInputCloud(this->input_, this->indices_);
    built_ = true;
  }

  mutable bool built_ = false;
};

}  // namespace pcl_als
