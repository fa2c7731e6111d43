// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/class_map.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

const std::vector<MapClass> kClasses = {{1, "tree", Color::rgb(0x0b6e3f)},
                                        {2, "grass", Color::rgb(0x9fd36b)},
                                        {3, "soil", Color::rgb(0xc8a465)},
                                        {4, "built-up", Color::rgb(0xd55e00)}};

/// Quarters of the four classes, a hole in the middle, at UTM-size coordinates.
ClassRaster quarters(int columns, int rows, double cell) {
  ClassRaster raster{columns, rows, cell, {699500.0, 5661000.0}, {}};
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const bool hole =
          std::hypot(column + 0.5 - 0.5 * columns, row + 0.5 - 0.5 * rows) < 0.1 * rows;
      const int code = 1 + (column >= columns / 2 ? 1 : 0) + (row >= rows / 2 ? 2 : 0);
      raster.codes.push_back(static_cast<std::uint8_t>(hole ? 0 : code));
    }
  }
  return raster;
}

TEST(ClassMap, OneMapIsTidyAndTrue) {
  ClassMapPicture picture;
  picture.setTitle("Land cover of a made-up block");
  picture.setClasses(kClasses);
  picture.addMap("corrected intensity", quarters(800, 1600, 0.5));
  const Canvas canvas = picture.draw(1600, 1000);
  canvas.write(pictureFile("class_map.png"));
  expectTidy(canvas);
  // A quarter less a quarter of the hole: the areas of the classes are those of the raster. The
  // room of 848 pixels for 800 m decides the scale: 1.06 pixels per metre.
  const double pixels_per_cell =
      std::sqrt(countOf(canvas, kClasses[0].color) / (400.0 * 800.0 - 0.25 * M_PI * 160.0 * 160.0));
  EXPECT_NEAR(pixels_per_cell, 0.525, 0.01);
  EXPECT_NEAR(countOf(canvas, kClasses[1].color), countOf(canvas, kClasses[0].color), 2500);
}

TEST(ClassMap, BeforeAndAfterAtOneScale) {
  ClassMapPicture picture;
  picture.setTitle("Before and after");
  picture.setClasses(kClasses);
  picture.addMap("raw intensity", quarters(400, 600, 1.0));
  picture.addMap("corrected intensity", quarters(400, 600, 1.0));
  const Canvas canvas = picture.draw(1600, 1000);
  canvas.write(pictureFile("class_maps.png"));
  expectTidy(canvas);
}

TEST(ClassMap, CoarseCellsStayWhole) {
  ClassMapPicture picture;
  picture.setClasses(kClasses);
  picture.addMap("two by two", quarters(2, 2, 10.0));
  const Canvas canvas = picture.draw(800, 600);
  expectTidy(canvas);
  // Four equal squares; the legend has one small one each (12 x 12 inside its frame).
  const int first = countOf(canvas, kClasses[0].color);
  for (const MapClass& c : kClasses) EXPECT_NEAR(countOf(canvas, c.color), first, 0.02 * first);
}

TEST(ClassMap, RefusesWhatCannotBeDrawn) {
  ClassMapPicture picture;
  EXPECT_THROW(picture.draw(800, 600), UsageError);
  EXPECT_THROW(picture.addMap("short", {3, 3, 1.0, {0.0, 0.0}, {1, 2}}), UsageError);
  EXPECT_THROW(picture.addMap("empty", {0, 0, 1.0, {0.0, 0.0}, {}}), UsageError);
  picture.setClasses(kClasses);
  picture.addMap("map", quarters(20, 20, 1.0));
  EXPECT_THROW(picture.draw(150, 100), UsageError);
}

}  // namespace
}  // namespace pcl_als
