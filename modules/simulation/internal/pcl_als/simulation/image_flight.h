// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_als/common/photogrammetric_types.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/simulation/scene.h>
#include <pcl_als/simulation/simulation_options.h>

namespace pcl_als::simulation {

/// A flight with a frame camera over the block, and the errors of its measurements.
struct ImageFlightOptions {
  FrameCamera camera = standardCamera();
  double height = 1000.0;        ///< metres above the mean terrain
  double forward_overlap = 0.6;  ///< share of an image, along the flight
  double side_overlap = 0.3;     ///< between lines
  double tie_spacing = 70.0;     ///< metres between tie points on the ground
  double noise = 0.3;            ///< pixels, each coordinate of a point; 0: exact
  double line_noise = 0.4;       ///< pixels, each coordinate of a place on a line
  double position_error = 0.5;   ///< metres per axis, of the approximate orientations
  double angle_error = 0.02 * kRadiansPerDegree;  ///< radians, of the approximate orientations
  int places_per_line = 4;  ///< measured in each image, anywhere along the visible part

  /// 100.5 mm, 9000 x 6732 pixels of 6 micrometres, distortion up to 60 micrometres.
  static FrameCamera standardCamera();
};

/// Images of a block with their truth. Ground frame, metres.
struct SimulatedImages {
  FrameCamera camera;
  std::vector<ImageOrientation> truth, approximate;
  /// Points T… (tie) and those of the check points, places on the lines of ridges.
  std::vector<ImageMeasurement> measurements;
  std::vector<ControlPoint> check_points;  ///< in the images; with the errors of a survey
  std::vector<ControlPoint> true_points;   ///< tie and check points, without errors
  std::vector<ObjectLine> ridges;          ///< of all gable roofs, named R1 …; without covariance
};

/** \brief Photographs a scene.
 *
 * The aircraft flies lines from south to north and back over the rectangle of the scene, with the
 * attitude motion of the options. A ray from the perspective centre is traced through the scene:
 * what is behind a roof, a wall, the terrain or leaves is not measured. The distortion is inverted
 * by iteration, for it is defined on measured coordinates.
 *
 * \param check_points surveyed points on the ground, ground frame
 */
SimulatedImages simulateImages(const Scene& scene, const SimulationOptions& options,
                               const ImageFlightOptions& flight,
                               const std::vector<ControlPoint>& check_points);

/// The ridges of the gable roofs of a scene, ground frame.
std::vector<ObjectLine> ridgesOf(const Scene& scene, const Eigen::Vector3d& origin);

}  // namespace pcl_als::simulation
