// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl/registration/registration.h>

#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/parallel.h>
#include <pcl_als/common/point_types.h>
#include <pcl_als/registration/patch_alignment.h>

namespace pcl_als {

/** \brief Registers one airborne strip to another: ICPatch (Habib et al. 2011, section 2.3).
 *
 * Points of the source are compared with TIN patches of the target and vice versa, with modified
 * weights. A rigid motion and optionally a scale are estimated robustly and from coarse to fine;
 * see registerPatches(). The clouds need one height at a plan position, z up, in metres.
 *
 * Settings of pcl::Registration that apply: setMaxCorrespondenceDistance (largest distance of the
 * surfaces at the initial motion, metres; default 15), setMaximumIterations (of the fine stage;
 * default 50), setTransformationEpsilon (square of the largest movement of a point in the last
 * iteration, m^2; default 4e-10), setIndices (points of the source). Correspondence estimation,
 * rejectors, RANSAC settings and search trees are not used. hasConverged() is false if the overlap
 * is too small, if both clouds have too few smooth surfaces in common, or if the iteration does not
 * converge. getResult() gives the reason, and the determined parameters of the motion with their
 * covariance. UsageError (in align()) for settings out of range.
 *
 * getFinalTransformation() maps local source to local target coordinates, as does the guess of
 * align(). For strips with different LocalFrames set both frames: the motion in the result is then
 * in ground coordinates, and the identity as guess (default) means no motion in the ground frame.
 *
 * \code
 * pcl_als::IterativeClosestPatch<pcl_als::PointLidar, pcl_als::PointLidar> icpatch;
 * icpatch.setInputSource(strip1.cloud);
 * icpatch.setInputTarget(strip2.cloud);
 * icpatch.setFrames(strip1.frame, strip2.frame);
 * pcl::PointCloud<pcl_als::PointLidar> aligned;
 * icpatch.align(aligned);
 * if (icpatch.hasConverged()) use(icpatch.getResult().motion.shift);
 * \endcode
 */
template <typename PointSource, typename PointTarget, typename Scalar = float>
class IterativeClosestPatch : public pcl::Registration<PointSource, PointTarget, Scalar> {
 public:
  using Base = pcl::Registration<PointSource, PointTarget, Scalar>;
  using typename Base::Matrix4;
  using typename Base::PointCloudSource;
  using Ptr = pcl::shared_ptr<IterativeClosestPatch>;
  using ConstPtr = pcl::shared_ptr<const IterativeClosestPatch>;

  IterativeClosestPatch();

  /// Origins of the clouds; default: zero for both. The aligned cloud is in the target's frame.
  void setFrames(const LocalFrame& source, const LocalFrame& target);
  /// Also estimates a scale about the centroid of the overlap; default false.
  void setEstimateScale(bool estimate) { settings_.estimate_scale = estimate; }
  bool getEstimateScale() const { return settings_.estimate_scale; }
  /// Approximate number of triangulated points of each cloud, at least 100; default 700 000.
  void setMaximumPoints(std::size_t points) { settings_.points = points; }
  std::size_t getMaximumPoints() const { return settings_.points; }
  /// Approximate number of candidate points in each direction, at least 100; default 180 000.
  void setMaximumPairs(std::size_t pairs) { settings_.pairs = pairs; }
  std::size_t getMaximumPairs() const { return settings_.pairs; }
  /// Limit of the standard deviation of determined parameters, metres (rotations times the radius
  /// of the overlap); parameters above it are reported as not determined. Default 0.1.
  void setDeterminedStandardDeviation(double metres) { settings_.determined_std = metres; }
  double getDeterminedStandardDeviation() const { return settings_.determined_std; }
  /// Step of the plan coordinates, metres; default 0.001. See Tin.
  void setResolution(double metres) { settings_.resolution = metres; }
  double getResolution() const { return settings_.resolution; }
  /// Covariance of the coordinates of a point of each cloud (3 x 3) up to a common factor; default:
  /// identity.
  void setPointNoise(const Eigen::Matrix3d& source, const Eigen::Matrix3d& target);
  /// 0: all cores; the result does not depend on it. Default 0.
  void setNumberOfThreads(int threads) { settings_.threads = requiredThreads(threads); }
  int getNumberOfThreads() const { return settings_.threads; }

  /// Result of the last align().
  const PatchAlignmentResult& getResult() const { return result_; }
  /// From local source to local target coordinates, in double precision.
  Eigen::Affine3d getTransformation() const;

 protected:
  void computeTransformation(PointCloudSource& output, const Matrix4& guess) override;

 private:
  PatchAlignmentSettings settings_;
  Eigen::Vector3d source_origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d target_origin_ = Eigen::Vector3d::Zero();
  PatchAlignmentResult result_;
};

}  // namespace pcl_als

#include <pcl_als/registration/impl/iterative_closest_patch.hpp>

namespace pcl_als {

// Instantiated in the library; other registered point types with x, y, z where they are used.
extern template class IterativeClosestPatch<PointLidar, PointLidar, float>;
extern template class IterativeClosestPatch<PointLidar, PointLidar, double>;
extern template class IterativeClosestPatch<pcl::PointXYZ, pcl::PointXYZ, float>;
extern template class IterativeClosestPatch<pcl::PointXYZ, pcl::PointXYZ, double>;
extern template class IterativeClosestPatch<pcl::PointXYZI, pcl::PointXYZI, float>;
extern template class IterativeClosestPatch<pcl::PointXYZI, pcl::PointXYZI, double>;

}  // namespace pcl_als
