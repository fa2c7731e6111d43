// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include <pcl/search/kdtree.h>

#include <pcl_als/registration/iterative_closest_patch.h>
#include <pcl_als/registration/point_view.h>

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

template <typename PointSource, typename PointTarget, typename Scalar>
IterativeClosestPatch<PointSource, PointTarget, Scalar>::IterativeClosestPatch() {
  this->reg_name_ = "IterativeClosestPatch";
  this->max_iterations_ = settings_.maximum_iterations;
  this->transformation_epsilon_ = settings_.convergence * settings_.convergence;
  this->corr_dist_threshold_ = settings_.search_distance;
  this->setSearchMethodTarget(pcl::make_shared<DeferredKdTree<PointTarget>>());
}

template <typename PointSource, typename PointTarget, typename Scalar>
void IterativeClosestPatch<PointSource, PointTarget, Scalar>::setFrames(const LocalFrame& source,
                                                                        const LocalFrame& target) {
  source_origin_ = source.origin;
  target_origin_ = target.origin;
}

template <typename PointSource, typename PointTarget, typename Scalar>
void IterativeClosestPatch<PointSource, PointTarget, Scalar>::setPointNoise(
    const Eigen::Matrix3d& source, const Eigen::Matrix3d& target) {
  settings_.source_noise = source;
  settings_.target_noise = target;
}

template <typename PointSource, typename PointTarget, typename Scalar>
Eigen::Affine3d IterativeClosestPatch<PointSource, PointTarget, Scalar>::getTransformation() const {
  return result_.motion.transformation(source_origin_, target_origin_);
}

template <typename PointSource, typename PointTarget, typename Scalar>
void IterativeClosestPatch<PointSource, PointTarget, Scalar>::computeTransformation(
    PointCloudSource& output, const Matrix4& guess) {
  PatchAlignmentSettings settings = settings_;
  settings.maximum_iterations = this->max_iterations_;
  settings.convergence = std::sqrt(this->transformation_epsilon_);
  settings.search_distance = this->corr_dist_threshold_;
  Eigen::Affine3d local_guess;
  local_guess.matrix() = guess.template cast<double>();
  // The initial guess refers to local coordinates; for different frames, identity means ground
  // coordinates.
  if (guess.isIdentity()) local_guess.translation() = source_origin_ - target_origin_;
  const Eigen::Affine3d ground_guess =
      Eigen::Translation3d(target_origin_) * local_guess * Eigen::Translation3d(-source_origin_);
  result_ =
      registerPatches(viewOf(*this->input_, this->indices_.get(), source_origin_),
                      viewOf(*this->target_, nullptr, target_origin_), settings, ground_guess);
  this->converged_ = result_.hasConverged();
  this->nr_iterations_ = result_.iterations;
  const Eigen::Affine3d found = this->converged_ ? getTransformation() : local_guess;
  this->transformation_ = this->final_transformation_ = found.matrix().template cast<Scalar>();
  for (std::size_t i = 0; i < output.size(); ++i) {
    const auto& from = (*this->input_)[(*this->indices_)[i]];
    output[i].getVector3fMap() =
        (found * from.getVector3fMap().template cast<double>()).template cast<float>();
  }
}

}  // namespace pcl_als
