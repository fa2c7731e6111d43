// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/photogrammetry/image_block.h>

namespace pcl_als {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Condition by which a place measured on the image of a line refers to the line of the ground.
enum class LineFormulation {
  /// The image ray lies in the plane of the perspective centre and the object line.
  coplanarity,
  /// The place is the image of an end of the line whose covariance is expanded along the line.
  expanded_covariance,
};

struct BundleSettings {
  LineFormulation formulation = LineFormulation::coplanarity;
  bool robust = true;  ///< reject observations beyond kRejectionLimit standard deviations
  /// A shift, rotation or scale of the block that moves its border by more than this standard
  /// deviation is not determined, metres.
  double determined_std = 2.0;
};

/// An image after the adjustment.
struct OrientedImage {
  ImageOrientation orientation;
  Matrix6d covariance = Matrix6d::Zero();  ///< position (m), then angles (rad)
  std::size_t points = 0, lines = 0;       ///< measurements in use
  double rms = 0.0;                        ///< of their residuals, mm
};

/// A tie or check point after the adjustment.
struct GroundPoint {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();    ///< metres
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< m^2
  std::size_t rays = 0;                                  ///< in use
};

/// A control line after the adjustment.
struct AdjustedLine {
  ObjectLine line;                                  ///< adjusted, with its covariance
  Eigen::Vector4d shift = Eigen::Vector4d::Zero();  ///< adjusted - given: ends, left and up, m
  double redundancy = 0.0;                          ///< of the four coordinates of control
  double misfit = 0.0;     ///< sqrt(v' Q_vv^-1 v / 4), about 1; of a rejected line as well
  std::size_t places = 0;  ///< measurements in use
  bool used = true;
};

/// Residual of one measurement.
struct ImageResidual {
  std::size_t measurement = 0;                         ///< index in ImageBlock::measurements
  Eigen::Vector2d residual = Eigen::Vector2d::Zero();  ///< measured - adjusted, mm; lines: across,
                                                       ///< to the right of the line in x
  double redundancy = 0.0;                             ///< number, 0 to 2 (points) or 1 (lines)
  double standardised = 0.0;                           ///< sqrt(v' Q_vv^-1 v / rank), about 1
  bool used = true;
};

/// An observation that contradicts the others.
struct Blunder {
  std::string image, feature;  ///< image: empty for a control line
  double standardised = 0.0;   ///< residual over its standard deviation
  bool line = false;
  bool localised = true;  ///< false: one of the observations of this feature is wrong
};

struct BundleResult {
  enum class Status { converged, not_converged, not_determined };
  Status status = Status::not_converged;
  std::string message;  ///< the reason where it has not converged or is not determined
  double sigma0 = 0.0;  ///< standard deviation of unit weight, of image coordinates and control
  double redundancy = 0.0;
  /// Shift, rotation or scale of the whole block that the control determines worst, and its
  /// standard deviation at the border of the block (m), of a block that is otherwise rigid.
  std::string weakest;
  double weakest_std = 0.0;
  std::size_t unknowns = 0, observations = 0;
  int iterations = 0;
  std::vector<OrientedImage> images;
  std::vector<GroundPoint> points;
  std::vector<AdjustedLine> lines;
  std::vector<ImageResidual> residuals;  ///< by measurement of points and known lines
  std::vector<Blunder> blunders;
  /// Corrections of focal length and principal point (mm) that the residuals indicate, and their
  /// standard deviations: a test of the camera, not applied.
  Eigen::Vector3d interior = Eigen::Vector3d::Zero(), interior_std = Eigen::Vector3d::Zero();
  std::vector<std::string> warnings;

  bool reliable() const { return status == Status::converged; }
};

/** \brief Bundle block adjustment with lines as control.
 *
 * Unknowns are the exterior orientation of each image, the position of each point, and the offsets
 * of the ends of each object line. Points: collinearity. Places on lines: with the perspective
 * centre C, the rotation R of the image, the reduced image vector p = (x, y, -f) and the ends P1,
 * P2 of the object line, (R p) . ((P1 - C) x (P2 - C)) = 0, divided so that the residual is the
 * distance of the place from the image of the line; or collinearity with an end of the line, which
 * need not be the place that was measured: the weight matrix in the image and on the ground is
 * reduced to the direction across the line, P' = M' diag(0, P_v) M (Habib et al. 2011, Eqs.
 * (31)-(34)). Control is the offset of the ends across the line, with the covariance of ObjectLine.
 *
 * Estimation: least squares with Ceres Solver (Schur complement, Levenberg-Marquardt); first with
 * Cauchy's loss, then without observations whose standardised residual (data snooping, Baarda 1968)
 * exceeds kRejectionLimit, until the same are rejected. Covariances are those of the a priori
 * standard deviations times max(1, sigma0)^2. The result does not depend on the number of threads
 * (there is one).
 *
 * InputError for a block of less than two images, measurements of an image without orientation,
 * measurements without a line that is known, and orientations by which most of these lines are
 * more than 30 degrees from where they were measured.
 *
 * \code
 * ImageBlock block{readCamera("camera.json"), readImages("images.csv"), {},
 * readLines("lines.csv")}; block.measurements = readMeasurements("measurements.csv", block.camera,
 * 0.5); const BundleResult result = adjustBundle(block); \endcode
 */
BundleResult adjustBundle(const ImageBlock& block, const BundleSettings& settings = {});

}  // namespace pcl_als
