// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/pixel_thinning.h>

namespace pcl_als {

/// Colours of the values of points: a scale, or a list of categories.
struct PointColoring {
  struct Category {
    float value;
    std::string name;
    Color color;
  };
  std::string heading;               ///< of the legend, with unit
  std::vector<Category> categories;  ///< empty: a scale
  ColorMap map = ColorMap::named("viridis");
  double low = 0.0, high = 1.0;
  std::string no_value = "no value";  ///< meaning of NaN, for the legend
  Color no_value_color{0xb4, 0xb4, 0xb4};

  Color operator()(float value) const;
  /// Sets the scale to the quantiles p and 1 - p of the values shown, which excludes outliers; \a
  /// symmetric: the same on both sides of zero. Equal values: 1 around.
  void fitScale(const PixelThinning& points, double p, bool symmetric);
  /// Removes the categories without a point in the picture.
  void keepShown(const PixelThinning& points);
};

enum class PointShade { none, eye_dome, hill };

/** \brief Lays out a picture of points: title, points, legend, scale bar, north arrow, and in a top
 * view coordinates.
 *
 * \code
 * PointPicture picture(1600, 1000);
 * OrthographicCamera camera(30.0, 45.0);
 * camera.frame(minimum, maximum, picture.mapWidth(), picture.mapHeight());
 * PixelThinning points(camera);
 * for (…) points.add(position, value);
 * picture.draw(points, coloring).write("view.png");
 * \endcode
 */
class PointPicture {
 public:
  /// \param bare points only, over the whole picture. UsageError where the picture is too small.
  PointPicture(int width, int height, bool bare = false);

  int mapWidth() const { return static_cast<int>(map_.width); }
  int mapHeight() const { return static_cast<int>(map_.height); }
  const PixelBox& map() const { return map_; }  ///< position of the points in the picture

  void setTitle(std::string title) { title_ = std::move(title); }
  void setSubtitle(std::string text) { subtitle_ = std::move(text); }
  void setShade(PointShade shade) { shade_ = shade; }
  /// Pixels; 0: by the gaps between the points, 1 to 5.
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

/// Point size at which points with this spacing form a closed surface, 1 to 5 pixels.
double closingPointSize(const PixelThinning& points);

}  // namespace pcl_als
