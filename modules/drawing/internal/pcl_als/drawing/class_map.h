// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <pcl_als/drawing/canvas.h>
#include <pcl_als/drawing/map_furniture.h>

namespace pcl_als {

/// A raster of class codes, row by row from the north-west corner.
struct ClassRaster {
  int columns = 0, rows = 0;
  double cell = 1.0;                                     ///< metres
  Eigen::Vector2d north_west = Eigen::Vector2d::Zero();  ///< outer corner, metres, ground frame
  std::vector<std::uint8_t> codes;
};

/// Colour and name of a class.
struct MapClass {
  std::uint8_t code = 0;
  std::string name;
  Color color;
};

/** \brief Draws rasters of classes with legend, scale bar, north arrow and coordinates; several are
 * drawn side by side at one scale, as for before and after.
 *
 * A raster finer than the picture is reduced to the class that most cells under a pixel have (ties:
 * the class given first), a coarser one is enlarged by whole cells. Codes without a class are left
 * empty (paper colour).
 * \code
 * ClassMapPicture picture;
 * picture.setClasses({{1, "tree", Color::rgb(0x0b6e3f)}, …});
 * picture.addMap("corrected", raster);
 * picture.draw(1600, 1000).write("landcover.png");
 * \endcode
 */
class ClassMapPicture {
 public:
  void setTitle(std::string title) { title_ = std::move(title); }
  void setClasses(std::vector<MapClass> classes) { classes_ = std::move(classes); }
  void setLegendHeading(std::string heading) { heading_ = std::move(heading); }
  /// UsageError unless there is one code for each cell.
  void addMap(std::string caption, ClassRaster raster);

  /// UsageError without maps or classes, or where the picture is too small for them.
  Canvas draw(int width, int height) const;
  /// The height at which the maps fill a width, within limits.
  int heightFor(int width, int lowest = 420, int highest = 1400) const;

 private:
  struct Map {
    std::string caption;
    ClassRaster raster;
  };
  std::vector<LegendEntry> legend() const;
  double roomAcross(int width) const;
  Image imageOf(const ClassRaster& raster, double pixels_per_cell) const;
  void drawMap(Canvas& canvas, const Map& map, const Eigen::Vector2d& corner,
               double metres_per_pixel) const;

  std::string title_, heading_ = "Classes";
  std::vector<MapClass> classes_;
  std::vector<Map> maps_;
};

}  // namespace pcl_als
