// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include <Eigen/Core>

#include <pcl_als/registration/rigid_motion.h>

namespace pcl_als {

/// Signed distances of the source from the target (positive: above it) over the final pairs,
/// metres.
struct DistanceSummary {
  double mean = 0.0;
  double rms = 0.0;
};

/** \brief What an alignment of two strips found: the motion of the source onto the target, how well
 * it is known, and how well they fit.
 *
 * Order of parameters everywhere: XT, YT, ZT (metres), omega, phi, kappa (radians). Use estimates
 * only where status is converged, and only those that are determined.
 */
struct PatchAlignmentResult {
  enum class Status {
    converged,
    not_converged,  ///< no convergence in the last iteration, or the initial motion is too far away
    too_few_pairs,  ///< hardly any patches in common
    no_overlap      ///< the clouds do not overlap, or have no surface
  };
  static constexpr int kParameters = 6;
  using Matrix6d = Eigen::Matrix<double, kParameters, kParameters>;

  struct Parameter {
    bool determined = false;
    std::string reason;  ///< why it is not determined; else empty
  };

  Status status = Status::no_overlap;
  std::string message;  ///< one line, empty when converged and everything is determined
  RigidMotion motion;   ///< about the overlap's centroid; includes the initial motion
  std::array<Parameter, kParameters> parameters;

  /// m^2, m rad, rad^2. The formal one, sigma0^2 N^-1 (Habib et al. 2011, Eq. (26)), with each
  /// standard deviation raised to those of the jackknife over areas (neighbouring points may share
  /// errors) and of errors that vary slowly over the ground (strips deform along time), and by
  /// surface_std and convergence_std. Rows of what is not determined are zero.
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d covariance_formal = Matrix6d::Zero();
  Matrix6d covariance_jackknife = Matrix6d::Zero();  ///< zero with fewer than ten groups of pairs
  std::size_t jackknife_groups = 0;
  Matrix6d covariance_correlated = Matrix6d::Zero();  ///< CorrelatedErrors; zero with too few cells
  /// Metres, radians: by how much more than by chance an estimate from all surfaces, rough ones and
  /// edges too, differs from that of the smooth ones. Part of covariance. Where ranging depends on
  /// the surface, no rigid motion is the whole truth, and no scatter inside the smooth ones shows
  /// it.
  Eigen::Matrix<double, kParameters, 1> surface_std = Eigen::Matrix<double, kParameters, 1>::Zero();
  /// Metres, radians: what the pairs still ask for where the iteration went round in a cycle and
  /// was damped; zero where it converged without damping. Part of covariance.
  Eigen::Matrix<double, kParameters, 1> convergence_std =
      Eigen::Matrix<double, kParameters, 1>::Zero();
  double scale_std = 0.0;  ///< of motion.scale; 0 where the scale is not estimated

  double sigma0 = 0.0;  ///< metres: of one point's coordinate along a normal, as the pairs scatter
  std::size_t redundancy = 0;     ///< pairs - estimated unknowns
  std::size_t pairs = 0;          ///< of the last iteration, both directions
  std::size_t source_points = 0;  ///< of these, points of the source in target patches
  int iterations = 0;             ///< of the fine stage
  int coarse_iterations = 0;
  double overlap_area = 0.0;  ///< m^2 that both clouds cover
  double radius = 0.0;        ///< metres: RMS plan distance of the pairs from the centroid

  /// Along the normals, of the final pairs: as the clouds were given (after the guess), and moved.
  DistanceSummary normal_before, normal_after;
  /// Vertically, of those on patches under 10 degrees.
  DistanceSummary vertical_before, vertical_after;
  std::size_t vertical_pairs = 0;

  bool hasConverged() const { return status == Status::converged; }
  bool allDetermined() const {
    for (const Parameter& parameter : parameters)
      if (!parameter.determined) return false;
    return true;
  }
  /// Standard deviation of a parameter (metres or radians); 0 where it is not determined.
  double standardDeviation(int parameter) const;
  double formalStandardDeviation(int parameter) const;
  static const char* name(int parameter);  ///< "XT", …, "kappa"
};

}  // namespace pcl_als
