// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/backscatter.h>
#include <pcl_als/simulation/scanner_options.h>

namespace pcl_als::simulation {

/** \brief Traces a pulse by sub-rays of equal energy over its footprint.
 *
 * The irradiance is Gaussian; half of the divergence is two standard deviations. Ring k of n has
 * 6 k - 3 sub-rays, evenly spaced, so that 3 n² sub-rays have equal shares of the energy. The
 * square of the radius of a ring is its mean over the part of the beam that the ring represents:
 * the second moments of the sub-rays are those of the beam.
 */
class FootprintTracer {
 public:
  FootprintTracer(const Scene& scene, const ScannerOptions& scanner, int rings);

  /// Directions of the sub-rays about the axis, standard deviations of the beam.
  const std::vector<Eigen::Vector2d>& subRays() const { return sub_rays_; }
  /// Near to far; empty if the axis misses the scene.
  const std::vector<Backscatter>& trace(const Eigen::Vector3d& origin,
                                        const Eigen::Vector3d& direction);

 private:
  const Scene& scene_;
  const ScannerOptions& scanner_;
  std::vector<Eigen::Vector2d> sub_rays_;
  std::vector<SurfaceHit> hits_;
  std::vector<Backscatter> parts_;
};

}  // namespace pcl_als::simulation
