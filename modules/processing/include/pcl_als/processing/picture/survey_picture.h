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

/// Options of SurveyPicture.
struct SurveyPictureOptions {
  int width = 1600, height = 1000;      ///< pixels
  std::string attribute = "elevation";  ///< attribute that is shown by colour, see PointAttribute
  std::string reference;  ///< for the attribute "difference": strip to which heights refer
  /// Cell size of the planes of the reference strip, metres; 0: by the density of its points.
  double difference_cell = 0.0;
  StripChoice strips;                      ///< strips that are drawn; default: all
  PointWindow window;                      ///< the part of the files that is read
  double azimuth = 0.0, elevation = 90.0;  ///< of the camera, degrees, see OrthographicCamera
  double zoom = 1.0;
  std::optional<Eigen::AlignedBox2d> extent;  ///< the part that is drawn, metres; default: all
  std::string color_map;                      ///< ColorMap::named(); empty: by attribute
  /// Values at the ends of the colour scale; default: from the points that are drawn.
  std::optional<std::pair<double, double>> range;
  PointShade shade = PointShade::none;
  double point_size = 0.0;  ///< pixels; 0: closingPointSize()
  std::string title;
  bool bare = false;  ///< points only, without title, legend and scale
};

/// Coloured points relative to the centre of a camera, metres.
struct ColoredPoints {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Color> colors;
};

/** \brief A picture of the points of files, from above or obliquely.
 *
 * The constructor reads the files three times, four times for a difference; thinned() reads them
 * once more. Memory depends on the number of pixels and not on that of the points.
 * \code
 * const pcl_als::SurveyPicture picture({"strip1.las", "strip2.las"}, {});
 * picture.draw().write("strips.png");
 * \endcode
 */
class SurveyPicture {
 public:
  /// UsageError for unknown strips, attributes or colour maps; InputError if there is no point to
  /// draw; Cancelled.
  SurveyPicture(const std::vector<std::string>& files, const SurveyPictureOptions& options,
                const ProgressCallback& progress = {});

  SurveyPicture(const SurveyPicture&) = delete;
  SurveyPicture& operator=(const SurveyPicture&) = delete;
  ~SurveyPicture();

  const OrthographicCamera& camera() const;
  std::uint64_t shownPoints() const;  ///< points that are not hidden by others
  Canvas draw() const;
  /// The points of the picture, evenly thinned to at most six million, for views from all sides.
  ColoredPoints thinned() const;

 private:
  class Drawing;
  std::unique_ptr<const Drawing> drawing_;
};

/// An extent in plan as text: "x 84940.1 to 85203.9, y 447385.2 to 447614.0".
std::string extentText(const Eigen::Vector3d& minimum, const Eigen::Vector3d& maximum);

}  // namespace pcl_als
