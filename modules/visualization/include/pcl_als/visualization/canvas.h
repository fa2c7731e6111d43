// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/visualization/color.h>
#include <pcl_als/visualization/image.h>

namespace pcl_als {

/// A rectangle in pixels; y runs down.
struct PixelBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  bool contains(const PixelBox& other) const {
    return other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom();
  }
  bool overlaps(const PixelBox& other) const {
    return other.x < right() && x < other.right() && other.y < bottom() && y < other.bottom();
  }
};

enum class Align { low, center, high };  ///< left / top, middle, right / bottom

struct TextStyle {
  double size = 14.0;  ///< pixels of the font's em square
  Color color = ink::black;
  bool bold = false;
  bool upward = false;  ///< turned by 90 degrees, read from below
  Align horizontal = Align::low, vertical = Align::center;
};

enum class Marker { disk, square, diamond, triangle, ring };

/** \brief A picture that is drawn on with antialiased lines, areas, text and images, in memory.
 *
 * Coordinates are pixels, real-valued, from the upper left corner; the pixel (i, j) covers
 * [i, i + 1) x [j, j + 1). Drawing needs no display and gives the same bytes everywhere (text: with
 * the same fonts). Parts outside the picture are cut off; texts() lists the position of every text,
 * so that a layout can be checked.
 */
class Canvas {
 public:
  Canvas(int width, int height, const Color& background = ink::white);

  int width() const { return image_.width; }
  int height() const { return image_.height; }
  const Image& image() const { return image_; }

  void setClip(const PixelBox& box);  ///< limits further drawing to a box
  void clearClip();

  void fill(const PixelBox& box, const Color& color);
  void frame(const PixelBox& box, double width, const Color& color);
  void polygon(const std::vector<Eigen::Vector2d>& corners, const Color& color);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
            const Color& color);
  /// Drawn as one stroke: a translucent colour is not darker where it crosses itself.
  void polyline(const std::vector<Eigen::Vector2d>& points, double width, const Color& color);
  void marker(Marker shape, const Eigen::Vector2d& at, double diameter, const Color& color);
  /// An image with its upper left pixel at (x, y), every pixel \a scale times as large.
  void draw(const Image& image, int x, int y, int scale = 1);

  /// Draws one line of UTF-8 text at a point; returns the box it covers.
  PixelBox text(const std::string& utf8, const Eigen::Vector2d& at, const TextStyle& style = {});
  /// Width and height of a text in its own direction of reading.
  static Eigen::Vector2d textSize(const std::string& utf8, const TextStyle& style = {});

  struct PlacedText {
    std::string text;
    PixelBox box;
  };
  const std::vector<PlacedText>& texts() const { return texts_; }

 private:
  void blend(int x, int y, const Color& color, double coverage);
  void strokeCoverage(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width);
  void paintCoverage(const Color& color);

  Image image_;
  int clip_left_ = 0, clip_top_ = 0, clip_right_ = 0, clip_bottom_ = 0;
  std::vector<float> coverage_;  ///< of the stroke being drawn, over the whole picture
  int dirty_left_ = 0, dirty_top_ = 0, dirty_right_ = 0, dirty_bottom_ = 0;
  std::vector<PlacedText> texts_;
};

}  // namespace pcl_als
