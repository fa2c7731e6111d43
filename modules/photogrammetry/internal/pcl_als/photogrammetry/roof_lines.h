// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/common/photogrammetric_types.h>

namespace pcl_als {

/// Criteria of planar roof faces and of their lines.
struct RoofLineSettings {
  double noise = 0.0;         ///< metres, of points about planes; 0: estimated from the TIN
  double least_slope = 0.07;  ///< radians: less inclined faces are flat
  double steepest = 1.25;     ///< radians
  double least_area = 5.0;    ///< m^2 of a face
  int least_points = 10;      ///< of a face
  double least_angle = 0.14;  ///< radians between two faces of a line
  double least_length = 3.0;  ///< metres of a line
  double least_step = 1.0;    ///< metres from a face down to what lies beside it
  bool eaves = false;         ///< also the lower edges of faces
  double tile = 120.0;        ///< metres, side of the squares that are triangulated
  int threads = 0;            ///< 0: all cores; results do not depend on it

  void check() const;  ///< UsageError
};

/// A line that was found in one strip.
struct StripLine {
  ObjectLine line;     ///< covariance: of the planes, without errors of the strip
  double angle = 0.0;  ///< radians, between its faces
};

/** \brief Straight roof lines of one strip: intersections of planar faces.
 *
 * Faces grow on the TIN from smooth neighbourhoods: a triangle belongs to a face while its vertices
 * are within three standard deviations of the plane, which is fitted again as the face grows. Faces
 * of a roof end at a step down to the ground along a part of their border; terrain does not. Two
 * faces that meet along their intersection form a ridge (both fall away from it) or a valley. Its
 * ends are those of the part along which both faces have points.
 *
 * The covariance is that of the intersection of the fitted planes at both ends, across the line,
 * from the scatter of the points about them. Eaves are lower edges of faces: their place in plan is
 * known to the spacing of the points only, which their covariance states.
 *
 * \param points surface points of one strip, metres, any frame; one height at a plan position
 */
std::vector<StripLine> findRoofLines(const std::vector<Eigen::Vector3d>& points,
                                     const RoofLineSettings& settings = {});

/// Errors of strips that the differences of their lines show.
struct LineErrors {
  double plan = 0.0, height = 0.0;  ///< metres, standard deviation of a strip at a line
  std::size_t differences = 0;      ///< between strips, from which they were estimated
};

/** \brief Combines the lines of several strips: the same roof line seen in several strips becomes
 * one, with the weighted mean of its position and the covariance of planes and strip errors.
 *
 * Lines are the same where they are within \a distance (metres) across at both ends, parallel to 8
 * degrees, and overlap. The errors of strips are estimated from the differences beyond what the
 * planes explain; with fewer than ten differences they are as \a assumed.
 * They are common to both ends of a line and independent between strips.
 *
 * \param names of the strips \return lines named L1, L2, … from west to east
 */
std::vector<ObjectLine> combineLines(const std::vector<std::vector<StripLine>>& strips,
                                     const std::vector<std::string>& names, double distance,
                                     const LineErrors& assumed, LineErrors* found = nullptr);

}  // namespace pcl_als
