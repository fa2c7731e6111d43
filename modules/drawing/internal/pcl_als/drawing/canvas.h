// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/color.h>

namespace pcl_als {

/// Colours row by row from the upper left corner.
struct Image {
  int width = 0, height = 0;
  std::vector<Color> pixels;

  Image() = default;
  Image(int w, int h, const Color& color = {0, 0, 0, 0})
      : width(w),
        height(h),
        pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), color) {}

  Color& at(int x, int y) { return pixels[index(x, y)]; }
  const Color& at(int x, int y) const { return pixels[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
};

/// The bytes of a PNG file: RGB, or RGBA where a pixel is not opaque.
std::vector<std::uint8_t> encodePng(const Image& image);
/// Writes a PNG through AtomicFile; InputError where it cannot be written.
void writePng(const std::filesystem::path& path, const Image& image);

/// A rectangle in pixels; y runs down.
struct PixelBox {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;

  double right() const { return x + width; }
  double bottom() const { return y + height; }
  bool contains(const PixelBox& other) const {
    return other.x >= x && other.y >= y && other.right() <= right() && other.bottom() <= bottom();
  }
  bool operator!=(const PixelBox& o) const {
    return x != o.x || y != o.y || width != o.width || height != o.height;
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

/** \brief A drawing of lines, areas, markers, text and images, written as PNG, SVG or PDF.
 *
 * Coordinates are pixels, real-valued, from the upper left corner; the pixel (i, j) covers
 * [i, i + 1) x [j, j + 1). What is drawn is kept as a list of elements and rendered on request: in
 * pixels and as PDF by Cairo, as SVG with text that can be selected. No display is needed. Parts
 * outside the picture are cut off; texts() lists the position of every text, so that a layout can
 * be checked.
 */
class Canvas {
 public:
  Canvas(int width, int height, const Color& background = ink::white);

  int width() const { return width_; }
  int height() const { return height_; }

  void setClip(const PixelBox& box);  ///< limits further drawing to a box
  void clearClip();

  void fill(const PixelBox& box, const Color& color);
  void frame(const PixelBox& box, double width, const Color& color);
  void polygon(const std::vector<Eigen::Vector2d>& corners, const Color& color);
  void line(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double width,
            const Color& color);
  /// Drawn as one stroke: a translucent colour is not darker where it crosses itself. A point that
  /// is not finite interrupts it.
  void polyline(const std::vector<Eigen::Vector2d>& points, double width, const Color& color);
  void marker(Marker shape, const Eigen::Vector2d& at, double diameter, const Color& color);
  /// An image over a box, without interpolation.
  void draw(const Image& image, const PixelBox& box);

  /// Draws one line of UTF-8 text at a point; returns the box it covers.
  PixelBox text(const std::string& utf8, const Eigen::Vector2d& at, const TextStyle& style = {});
  /// Width and height of a text in its own direction of reading, pixels.
  static Eigen::Vector2d textSize(const std::string& utf8, const TextStyle& style = {});

  struct PlacedText {
    std::string text;
    PixelBox box;
  };
  const std::vector<PlacedText>& texts() const { return texts_; }

  /// The drawing in pixels.
  Image image() const;
  /// The bytes of a PNG file of these pixels.
  std::vector<std::uint8_t> png() const;
  /** \brief The drawing as an SVG element of an HTML page, whose style sheet is themeStyle().
   *
   * Text remains text, as wide as it was laid out in whatever font. \param description what readers
   * hear who do not see the picture.
   */
  std::string svg(const std::string& description = {}) const;
  /// The style sheet of the colours of namespace ink, which follow the reader's light or dark theme
  /// on a screen: classes fill-NAME and stroke-NAME, and custom properties --NAME for a page.
  static std::string themeStyle();
  /// The bytes of a PDF document of one page, a pixel of 0.75 points (1/96 inch).
  std::string pdf() const;
  /// Writes the drawing through AtomicFile: .png, .svg or .pdf, by the name's ending. UsageError
  /// for any other; InputError where it cannot be written.
  void write(const std::filesystem::path& path) const;

  /// What was drawn, in order.
  struct Element {
    static constexpr double kRingWidth = 1.5;  ///< pixels, within the diameter of a ring
    enum class Kind { area, stroke, disk, ring, image, text };
    Kind kind;
    Color color;
    /// Corners, points of a stroke, centre, or the first point of a text's baseline.
    std::vector<Eigen::Vector2d> points;
    double size = 0.0;                   ///< width of a stroke, diameter, or size of a font; pixels
    PixelBox box;                        ///< of an image
    std::shared_ptr<const Image> image;  ///< null where it is none
    std::string text;
    double length = 0.0;  ///< of the text, pixels
    bool bold = false, upward = false;
    PixelBox clip;
  };
  const std::vector<Element>& elements() const { return elements_; }

 private:
  std::string svgElement(const std::string& attributes, const std::string& head) const;
  Element& add(Element::Kind kind, const Color& color, std::vector<Eigen::Vector2d> points = {},
               double size = 0.0);

  int width_, height_;
  PixelBox clip_;
  std::vector<Element> elements_;
  std::vector<PlacedText> texts_;
};

}  // namespace pcl_als
