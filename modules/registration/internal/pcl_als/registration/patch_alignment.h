// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <pcl_als/registration/rigid_motion.h>

namespace pcl_als {

struct PointView;

/// Signed distances of the source from the target (positive: above it) over the final pairs,
/// metres.
struct DistanceSummary {
  double mean = 0.0;
  double rms = 0.0;
};

/** \brief Result of an alignment of two strips: the motion of the source onto the target, its
 * uncertainty, and the fit of the strips.
 *
 * Order of parameters everywhere: XT, YT, ZT (metres), omega, phi, kappa (radians). Use estimates
 * only where status is converged, and only those that are determined.
 */
struct PatchAlignmentResult {
  enum class Status {
    converged,
    not_converged,  ///< no convergence in the last iteration, or the initial motion is too far away
    too_few_pairs,  ///< too few patches in common
    no_overlap      ///< the clouds do not overlap, or have no surface
  };
  static constexpr int kParameters = 6;
  using Matrix6d = Eigen::Matrix<double, kParameters, kParameters>;

  struct Parameter {
    bool determined = false;
    std::string reason;  ///< why it is not determined; otherwise empty
  };

  Status status = Status::no_overlap;
  std::string message;  ///< one line, empty when converged and everything is determined
  RigidMotion motion;   ///< about the overlap's centroid; includes the initial motion
  std::array<Parameter, kParameters> parameters;

  /// m^2, m rad, rad^2. The formal one, sigma0^2 N^-1 (Habib et al. 2011, Eq. (26)), with each
  /// standard deviation raised to those of the jackknife over areas (neighbouring points may share
  /// errors) and of errors that vary slowly over the ground (strips deform along time), and by
  /// surface_std, convergence_std and deformation_std. Rows of what is not determined are zero.
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d covariance_formal = Matrix6d::Zero();
  Matrix6d covariance_jackknife = Matrix6d::Zero();  ///< zero with fewer than ten groups of pairs
  std::size_t jackknife_groups = 0;
  Matrix6d covariance_correlated = Matrix6d::Zero();  ///< CorrelatedErrors; zero with too few cells
  /// Metres, radians: the part of the difference between this estimate and one from all surfaces,
  /// including rough ones and edges, that exceeds chance; included in covariance. Where ranging
  /// depends on the surface, no rigid motion fits all surfaces, and the scatter within the smooth
  /// ones does not show it.
  Eigen::Matrix<double, kParameters, 1> surface_std = Eigen::Matrix<double, kParameters, 1>::Zero();
  /// Metres, radians: the remaining update where the iteration entered a cycle and was damped; zero
  /// where it converged without damping. Included in covariance.
  Eigen::Matrix<double, kParameters, 1> convergence_std =
      Eigen::Matrix<double, kParameters, 1>::Zero();
  /// Metres, radians: by how much the motion varies over the overlap where the clouds are bent or
  /// strained against each other. Part of covariance.
  Eigen::Matrix<double, kParameters, 1> deformation_std =
      Eigen::Matrix<double, kParameters, 1>::Zero();
  double scale_std = 0.0;  ///< of motion.scale; 0 where the scale is not estimated

  /// metres: standard deviation of a coordinate along a normal, from the scatter of the pairs
  double sigma0 = 0.0;
  std::size_t redundancy = 0;  ///< pairs - estimated unknowns
  std::size_t pairs = 0;       ///< of the last iteration, both directions
  /// number of these with a point of the source and a patch of the target
  std::size_t source_points = 0;
  int iterations = 0;  ///< of the fine stage
  int coarse_iterations = 0;
  double overlap_area = 0.0;  ///< m^2 that both clouds cover
  double radius = 0.0;        ///< metres: RMS plan distance of the pairs from the centroid

  /// Along the normals, of the final pairs: with the initial motion, and with the estimated one.
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

const char* toString(PatchAlignmentResult::Status status);

/// Settings of PatchAlignment; metres and radians.
struct PatchAlignmentSettings {
  double search_distance = 15.0;  ///< > 0: largest distance of the surfaces at the initial motion
  bool estimate_scale = false;    ///< a seventh unknown
  std::size_t points = 700'000;   ///< triangulated points of each cloud, approximately
  std::size_t pairs = 180'000;    ///< candidates in each direction, approximately
  int maximum_iterations = 50;    ///< of the fine stage
  double convergence = 2e-5;      ///< metres: no point moves further in an iteration
  double determined_std = 0.1;    ///< metres at the overlap's radius: above, not determined
  double resolution = 0.001;      ///< metres, of plan coordinates; see Tin
  int threads = 0;                ///< 0: all cores; the result does not depend on it
  /// Covariance of one point's coordinates, up to a factor (sigma0 is estimated): 3 x 3, ground
  /// frame.
  Eigen::Matrix3d source_noise = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d target_noise = Eigen::Matrix3d::Identity();
};

/** \brief Registers one strip to another: points against TIN patches, modified weights, both
 * directions (Habib et al. 2011, section 2.3; ICPatch). The engine of IterativeClosestPatch, for
 * clouds of any type and in any two local frames.
 *
 * 1. Coarse: the lowest points of successively smaller plan cells, within search_distance.
 * 2. Areas are chosen in the overlap, evenly and by relief, and triangulated in both clouds.
 * 3. Points on smooth surfaces, evenly over slopes and aspects, are paired with the closest patch
 * of the other cloud. A pair is one equation along the normal n of the patches' neighbourhoods,
 *      n'(t + theta x (p - c) + ds (p - c)) = -d,   weight 1 / n'(Sigma_s + Sigma_t) n,
 *    the modified weight of Eqs. (31)-(34) for a scalar: displacements in the plane have no cost.
 * Huber weights, zero beyond 4.5 standard deviations.
 * 4. Directions that the patches do not determine are found from eigenvalues, keep their initial
 * value, and are reported.
 *
 * Exchanging source and target gives the inverse motion. Memory: about 250 bytes for each
 * triangulated point, 16 for each cell of some five points.
 */
PatchAlignmentResult registerPatches(const PointView& source, const PointView& target,
                                     const PatchAlignmentSettings& settings = {},
                                     const Eigen::Affine3d& guess = Eigen::Affine3d::Identity());

}  // namespace pcl_als
