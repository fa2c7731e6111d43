// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl/registration/registration.h>

#include <pcl_als/registration/correspondence_estimation_point_to_patch.h>
#include <pcl_als/registration/correspondence_rejection_patch.h>
#include <pcl_als/registration/transformation_estimation_patch.h>

namespace pcl_als {

/// The components that usePointToPatch() sets in a registration; their settings may be changed.
template <typename PointSource, typename PointTarget, typename Scalar = float>
struct PointToPatch {
  pcl::shared_ptr<CorrespondenceEstimationPointToPatch<PointSource, PointTarget, Scalar>>
      correspondences;
  pcl::shared_ptr<CorrespondenceRejectorPatch> rejector;
  pcl::shared_ptr<TransformationEstimationPatch<PointSource, PointTarget, Scalar>> transformation;
};

/** \brief Makes a registration of PCL use point-to-patch primitives (Habib et al. 2011, section
 * 2.3).
 *
 * Sets the correspondence estimation, adds the rejector of patches that are not suitable for
 * measurement and sets the transformation estimation, so that all three use the same patches.
 * Other rejectors remain. Iterations, thresholds and clouds are set as in any pcl::Registration;
 * the 10 iterations that pcl::IterativeClosestPoint makes by default are too few for displacements
 * of some decimetres. This function is for programs that use a registration of PCL;
 * IterativeClosestPatch is a complete registration, from coarse to fine, robust, in both directions
 * and with a covariance.
 *
 * \code
 * pcl::IterativeClosestPoint<pcl_als::PointLidar, pcl_als::PointLidar> icp;
 * pcl_als::usePointToPatch(icp).correspondences->setMaximumNormalDistance(2.0);  // metres
 * icp.setInputSource(strip1.cloud);
 * icp.setInputTarget(strip2.cloud);
 * icp.setMaximumIterations(40);
 * icp.align(aligned);
 * \endcode
 */
template <typename PointSource, typename PointTarget, typename Scalar>
PointToPatch<PointSource, PointTarget, Scalar> usePointToPatch(
    pcl::Registration<PointSource, PointTarget, Scalar>& registration) {
  PointToPatch<PointSource, PointTarget, Scalar> parts;
  using Parts = decltype(parts);
  parts.correspondences.reset(new typename decltype(Parts::correspondences)::element_type);
  parts.rejector.reset(new CorrespondenceRejectorPatch);
  parts.transformation.reset(new typename decltype(Parts::transformation)::element_type);
  parts.rejector->setMatchProvider(parts.correspondences);
  parts.transformation->setMatchProvider(parts.correspondences);
  registration.setCorrespondenceEstimation(parts.correspondences);
  registration.addCorrespondenceRejector(parts.rejector);
  registration.setTransformationEstimation(parts.transformation);
  return parts;
}

}  // namespace pcl_als
