// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/pixel_thinning.h>

namespace pcl_als {

/// Colours for the values of points: a scale, or a list of categories.
struct PointColoring {
  struct Category {
    float value;
    std::string name;
    Color color;
  };
  std::string heading;               ///< heading of the legend, with unit
  std::vector<Category> categories;  ///< empty: a scale
  ColorMap map = ColorMap::named("viridis");
  double low = 0.0, high = 1.0;       ///< values at the ends of the scale
  std::string no_value = "no value";  ///< meaning of NaN, for the legend
  Color no_value_color{0xb4, 0xb4, 0xb4};

  Color operator()(float value) const;
  /// Sets the scale to the quantiles p and 1 - p of the values shown, which excludes outliers;
  /// \a symmetric: to the quantile 1 - p of the absolute values on both sides of zero. If all
  /// values are equal, the scale has a width of 1.
  void fitScale(const PixelThinning& points, double p, bool symmetric);
  /// Removes the categories without a point in the picture.
  void keepShown(const PixelThinning& points);
};

enum class PointShade { none, eye_dome, hill };

/** \brief Draws a picture of points with title, legend, scale bar, north arrow and, in a top view,
 * coordinates.
 *
 * \code
 * pcl_als::PointPicture picture(1600, 1000);
 * pcl_als::OrthographicCamera camera(30.0, 45.0);  // azimuth, elevation, degrees
 * camera.frame(minimum, maximum, picture.mapWidth(), picture.mapHeight());
 * pcl_als::PixelThinning points(camera);
 * for (std::size_t i = 0; i < heights.size(); ++i) points.add(positions[i], heights[i]);
 * picture.draw(points, coloring).write("view.png");
 * \endcode
 */
class PointPicture {
 public:
  /// \param width,height pixels. UsageError if the picture is too small
  /// \param bare points only, over the whole picture
  PointPicture(int width, int height, bool bare = false);

  int mapWidth() const { return static_cast<int>(map_.width); }
  int mapHeight() const { return static_cast<int>(map_.height); }
  const PixelBox& map() const { return map_; }  ///< part of the picture that shows the points

  void setTitle(std::string title) { title_ = std::move(title); }
  void setSubtitle(std::string text) { subtitle_ = std::move(text); }
  void setShade(PointShade shade) { shade_ = shade; }
  /// Side of the points, pixels; 0 (default): closingPointSize().
  void setPointSize(double pixels) { point_size_ = pixels; }
  void setBackground(const Color& color) { background_ = color; }

  Canvas draw(const PixelThinning& points, const PointColoring& coloring) const;

 private:
  /// The points as squares, nearer ones above others.
  Image rasterise(const PixelThinning& points, const PointColoring& coloring) const;
  void drawPanel(Canvas& canvas, const PixelThinning& points, const PointColoring& coloring) const;

  int width_, height_;
  bool bare_;
  PixelBox map_;
  std::string title_, subtitle_;
  PointShade shade_ = PointShade::none;
  double point_size_ = 0.0;
  Color background_ = ink::white;
};

/// Point size at which points with the spacing in the picture form a closed surface, 1 to 5 pixels.
double closingPointSize(const PixelThinning& points);

}  // namespace pcl_als
