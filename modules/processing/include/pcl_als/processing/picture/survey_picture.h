// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <pcl_als/common/progress.h>
#include <pcl_als/common/survey_types.h>
#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/point_picture.h>
#include <pcl_als/io/point_window.h>

namespace pcl_als {

class OrthographicCamera;

struct SurveyPictureOptions {
  int width = 1600, height = 1000;      ///< pixels
  std::string attribute = "elevation";  ///< that points are coloured by, see PointAttribute
  std::string reference;  ///< for attribute "difference": the strip to which heights refer
  /// metres, cell size of the planes of the reference strip; 0: by density
  double difference_cell = 0.0;
  StripChoice strips;
  PointWindow window;                      ///< the part of the files that is read
  double azimuth = 0.0, elevation = 90.0;  ///< of the camera, degrees, see OrthographicCamera
  double zoom = 1.0;
  std::optional<Eigen::AlignedBox2d> extent;  ///< metres: draw this part only
  std::string color_map;                      ///< empty: by attribute
  /// of the colours; default: from the points drawn
  std::optional<std::pair<double, double>> range;
  PointShade shade = PointShade::none;
  double point_size = 0.0;  ///< pixels; 0: as large as the gaps between points
  std::string title;
  bool bare = false;  ///< points only, without title, legend and scale
};

/// Points with a colour each, relative to the centre of a camera, metres.
struct ColoredPoints {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Color> colors;
};

/** \brief A picture of the points of files, from above or obliquely.
 *
 * Reads the files two or three times; memory depends on the pixels and not on the points.
 * \code
 * const pcl_als::SurveyPicture picture({"strip1.las", "strip2.las"}, {});
 * picture.draw().write("strips.png");
 * \endcode
 */
class SurveyPicture {
 public:
  /// UsageError for unknown strips, attributes or colour maps; InputError where there is nothing to
  /// draw; Cancelled.
  SurveyPicture(const std::vector<std::string>& files, const SurveyPictureOptions& options,
                const ProgressCallback& progress = {});

  SurveyPicture(const SurveyPicture&) = delete;
  SurveyPicture& operator=(const SurveyPicture&) = delete;
  ~SurveyPicture();

  const OrthographicCamera& camera() const;
  std::uint64_t shownPoints() const;  ///< points that are not hidden by others
  Canvas draw() const;
  /// The points of the picture, evenly thinned to at most six million, for a view from all sides.
  ColoredPoints thinned() const;

 private:
  class Drawing;
  std::unique_ptr<const Drawing> drawing_;
};

/// "x 84940.1 to 85203.9, y 447385.2 to 447614.0"
std::string extentText(const Eigen::Vector3d& minimum, const Eigen::Vector3d& maximum);

}  // namespace pcl_als
