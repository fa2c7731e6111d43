// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <vector>

#include <Eigen/Core>

#include <pcl_als/simulation/backscatter.h>
#include <pcl_als/simulation/scene.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

/// Echo from one range of a pulse.
struct Echo {
  double range = 0.0;        ///< metres along the beam's axis
  double share = 0.0;        ///< of the pulse's energy
  double signal = 0.0;       ///< sum of share * reflectance * cos(incidence)
  double spread = 0.0;       ///< standard deviation of the ranges in it, weighted by signal, metres
  double reflectance = 0.0;  ///< weighted by share
  double tangent = 0.0;      ///< of the incidence on surfaces (leaves: 0), weighted by signal
  LandCover cover = LandCover::grass;  ///< of the largest part of the signal
};

/// Tangent of the incidence from its cosine, at most 3: of walls it would be without limit.
double tangentOfIncidence(double cosine);
/// Energy returned by a surface over that at normal incidence.
double returnedShare(double cosine, double exponent);
/// Appends what the surfaces along a ray with this share of the pulse's energy send back.
void appendBackscatter(const std::vector<SurfaceHit>& hits, const Eigen::Vector3d& direction,
                       double energy, double incidence_exponent, std::vector<Backscatter>& parts);

/// Sum of two echoes; the range is the signal's mean, the cover that of the stronger one.
Echo joinedEchoes(const Echo& a, const Echo& b);
/// A part as an echo without spread.
Echo echoOf(const Backscatter& part);

/** \brief Turns the surfaces under a pulse into returns.
 *
 * Along the axis: an echo begins at a surface of the axis ray and takes what follows within the
 * separation; its range is exactly that first surface's. Over the footprint: the same with seven
 * rays, one on the axis (half the energy) and six on the 1/e^2 circle (a twelfth each), which is
 * the rule that integrates polynomials to degree five over a Gaussian beam; an echo's range is the
 * mean of its parts, weighted by signal, and echoes closer than the separation become one.
 */
class PulseTracer {
 public:
  PulseTracer(const Scene& scene, const ScannerOptions& scanner, bool footprint)
      : scene_(scene), scanner_(scanner), footprint_(footprint) {}

  /// At most max_returns echoes above the threshold, near to far; empty where the scene is missed.
  const std::vector<Echo>& trace(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);

 private:
  void addParts(const Eigen::Vector3d& direction, double energy);
  void addRing(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
  bool formOpenGroundEcho(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction);
  void formEchoes();
  void mergeCloseEchoes();

  const Scene& scene_;
  const ScannerOptions& scanner_;
  bool footprint_;
  std::vector<SurfaceHit> hits_;
  std::vector<Backscatter> parts_;
  std::vector<Echo> echoes_;
};

}  // namespace pcl_als::simulation
