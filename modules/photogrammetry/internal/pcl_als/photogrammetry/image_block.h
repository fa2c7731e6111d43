// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/photogrammetric_types.h>

namespace pcl_als {

/// Images with their measurements, and the lines that control them. Ground frame, metres.
struct ImageBlock {
  FrameCamera camera;
  std::vector<ImageOrientation> images;  ///< approximate, or with standard deviations
  std::vector<ImageMeasurement> measurements;
  std::vector<ObjectLine> lines;  ///< those that are measured are found by their id
};

/// A line of the images and the object line that it was assigned to.
struct LineAssignment {
  std::string image_line, object_line;
  double distance = 0.0;  ///< RMS, metres on the ground
};

/** \brief Assigns lines of the images to object lines by position, by the approximate
 * orientations.
 *
 * An object line is projected into all images in which a line is measured. The line is assigned to
 * the object line whose images are nearest to its places: RMS distance below \a distance (metres on
 * the ground; beyond the ends too), and below half of that of any other. Ambiguous lines stay
 * without. Lines with an id of an object line are left as they are. The measurements are renamed.
 */
std::vector<LineAssignment> assignLines(ImageBlock& block, double distance);

}  // namespace pcl_als
