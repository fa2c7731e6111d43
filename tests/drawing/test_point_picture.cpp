// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/point_picture.h>
#include <pcl_als/drawing/result_plots.h>
#include <pcl_als/drawing/voxel_thinning.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

const Eigen::Vector3d kOrigin(699000.0, 5660000.0, 1000.0);

TEST(OrthographicCamera, ProjectsByHand) {
  OrthographicCamera top;
  top.frame(kOrigin, kOrigin + Eigen::Vector3d(100.0, 50.0, 10.0), 200, 100);
  EXPECT_NEAR(top.metresPerPixel(), 0.5, 3e-4);
  const Eigen::Vector3d corner = top.project(kOrigin + Eigen::Vector3d(100.0, 50.0, 10.0));
  EXPECT_NEAR(corner.x(), 200.0, 0.03);  // east is right
  EXPECT_NEAR(corner.y(), 0.0, 0.03);    // north is up
  EXPECT_NEAR(corner.z(), 5.0, 1e-6);
  // Level, looking east: north is on the left, heights go up, west is nearer.
  OrthographicCamera east(90.0, 0.0);
  east.frame(kOrigin, kOrigin + Eigen::Vector3d(100.0, 50.0, 25.0), 100, 50);
  EXPECT_NEAR(east.metresPerPixel(), 0.5, 3e-4);
  const Eigen::Vector3d north = east.project(kOrigin + Eigen::Vector3d(0.0, 50.0, 25.0));
  EXPECT_NEAR(north.x(), 0.0, 0.03);
  EXPECT_NEAR(north.y(), 0.0, 0.03);
  EXPECT_NEAR(north.z(), 50.0, 1e-6);
  // 30 degrees above the horizon: a metre of height takes cos 30 degrees of the picture.
  OrthographicCamera slanting(0.0, 30.0);
  slanting.frame(kOrigin, kOrigin, 10, 10);
  const double low = slanting.project(kOrigin).y();
  const double high = slanting.project(kOrigin + Eigen::Vector3d(0.0, 0.0, 1.0)).y();
  EXPECT_NEAR((low - high) * slanting.metresPerPixel(), std::sqrt(0.75), 1e-9);
}

TEST(OrthographicCamera, RefusesTheImpossible) {
  EXPECT_THROW(OrthographicCamera(0.0, 91.0), UsageError);
  EXPECT_THROW(OrthographicCamera(0.0, -1.0), UsageError);
  EXPECT_THROW(OrthographicCamera(NAN, 45.0), UsageError);
  OrthographicCamera camera;
  EXPECT_THROW(camera.frame(kOrigin, kOrigin, 10, 10, 0.0), UsageError);
  EXPECT_THROW(camera.frame(kOrigin, kOrigin, 0, 10), UsageError);
  EXPECT_THROW(camera.frame(ViewExtent(), 10, 10), UsageError);
}

OrthographicCamera smallCamera() {
  OrthographicCamera camera;
  camera.frame(kOrigin, kOrigin + Eigen::Vector3d(10.0, 10.0, 0.0), 10, 10);
  return camera;
}

TEST(PixelThinning, KeepsTheNearestAndOfEqualsTheFirst) {
  PixelThinning points(smallCamera());
  points.add(kOrigin + Eigen::Vector3d(3.2, 7.3, 1.0), 1.0F);
  points.add(kOrigin + Eigen::Vector3d(3.7, 7.6, 5.0), 2.0F);  // the same pixel, higher
  points.add(kOrigin + Eigen::Vector3d(3.4, 7.1, 5.0), 3.0F);  // as high, later
  points.add(kOrigin + Eigen::Vector3d(-0.5, 7.1, 5.0), 4.0F);
  points.add(kOrigin + Eigen::Vector3d(1.0, NAN, 5.0), 5.0F);
  points.add({INFINITY, 0.0, 0.0}, 6.0F);
  EXPECT_EQ(points.seen(), 3U);
  EXPECT_EQ(points.shown(), 1U);
  EXPECT_EQ(points.outside(), 1U);
  EXPECT_EQ(points.invalid(), 2U);
  EXPECT_EQ(points.pixels()[2 * 10 + 3].value, 2.0F);  // 7.6 m north: the third row from above
}

TEST(PixelThinning, ShadesAStepAndNothingFlat) {
  PixelThinning flat(smallCamera()), step(smallCamera());
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 10; ++y) {
      flat.add(kOrigin + Eigen::Vector3d(x + 0.5, y + 0.5, 0.0), 0.0F);
      step.add(kOrigin + Eigen::Vector3d(x + 0.5, y + 0.5, x < 5 ? 6.0 : 0.0), 0.0F);
    }
  }
  for (const float shade : eyeDomeShade(flat, 2)) EXPECT_EQ(shade, 1.0F);
  const auto shades = eyeDomeShade(step, 2);
  EXPECT_LT(shades[5 * 10 + 5], 0.8F);  // at the foot of the wall
  EXPECT_EQ(shades[5 * 10 + 4], 1.0F);  // on its top
  EXPECT_EQ(shades[5 * 10 + 9], 1.0F);
  // Hillshade, light from the upper left: a slope down to the east is darker than flat ground.
  const auto hill = hillShade(step, 1);
  EXPECT_LT(hill[5 * 10 + 5], hillShade(flat, 1)[55]);
}

TEST(VoxelThinning, IsEvenBoundedAndDeterministic) {
  VoxelThinning voxels(kOrigin, {100.0, 100.0, 1.0}, 2000);
  for (int i = 0; i < 100; ++i) {
    for (int k = 0; k < 100; ++k) voxels.add(kOrigin + Eigen::Vector3d(i, k, 0.0), 0.0F);
  }
  EXPECT_LE(voxels.positions().size(), 2000U);
  EXPECT_GE(voxels.positions().size(), 500U);
  int west = 0;
  for (const auto& position : voxels.positions()) west += position.x() < 50.0F ? 1 : 0;
  const auto half = static_cast<double>(voxels.positions().size()) / 2.0;
  EXPECT_NEAR(west, half, 0.1 * half);
}

TEST(PointPicture, PointsHaveTheirPixelsAndColours) {
  PointPicture picture(40, 30, true);
  OrthographicCamera camera;
  camera.frame(kOrigin, kOrigin + Eigen::Vector3d(40.0, 30.0, 200.0), 40, 30);
  PixelThinning points(camera);
  // Above and below the middle of the heights, and one that another hides.
  points.add(kOrigin + Eigen::Vector3d(5.5, 24.5, 200.0), 0.0F);
  points.add(kOrigin + Eigen::Vector3d(30.5, 2.5, 0.0), 1.0F);
  points.add(kOrigin + Eigen::Vector3d(20.5, 15.5, 10.0), 0.0F);
  points.add(kOrigin + Eigen::Vector3d(20.5, 15.5, 60.0), 1.0F);
  points.add(kOrigin + Eigen::Vector3d(35.5, 20.5, 60.0), NAN);
  PointColoring coloring;
  coloring.categories = {{0.0F, "a", Color::rgb(0xd55e00)}, {1.0F, "b", Color::rgb(0x0072b2)}};
  picture.setPointSize(1.0);
  const Canvas canvas = picture.draw(points, coloring);
  const Image image = canvas.image();
  ASSERT_EQ(image.width, 40);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      Color expected = ink::white;
      if (x == 5 && y == 5) expected = Color::rgb(0xd55e00);
      if (x == 30 && y == 27) expected = Color::rgb(0x0072b2);
      if (x == 20 && y == 14) expected = Color::rgb(0x0072b2);
      if (x == 35 && y == 9) expected = coloring.no_value_color;
      EXPECT_EQ(image.at(x, y), expected) << x << ' ' << y;
    }
  }
}

TEST(PointPicture, SlantingViewsAgreeWithTheCamera) {
  PointPicture picture(60, 60, true);
  picture.setPointSize(1.0);
  OrthographicCamera camera(35.0, 40.0);
  camera.frame(kOrigin, kOrigin + Eigen::Vector3d(20.0, 20.0, 20.0), 60, 60);
  PixelThinning points(camera);
  for (int i = 0; i < 8; ++i) {
    points.add(kOrigin + 20.0 * Eigen::Vector3d(i & 1, i >> 1 & 1, i >> 2 & 1), 0.0F);
  }
  PointColoring coloring;
  coloring.categories = {{0.0F, "a", {0, 0, 0}}};
  const Canvas canvas = picture.draw(points, coloring);
  const Image image = canvas.image();
  for (std::size_t i = 0; i < points.pixels().size(); ++i) {
    EXPECT_EQ(image.pixels[i] == (Color{0, 0, 0}), points.pixels()[i].used()) << i;
  }
}

TEST(PointPicture, LargePointsAreSquaresAndTheNearerOneIsInFront) {
  PointPicture picture(40, 30, true);
  OrthographicCamera camera;
  camera.frame(kOrigin, kOrigin + Eigen::Vector3d(40.0, 30.0, 0.0), 40, 30);
  PixelThinning points(camera);
  points.add(kOrigin + Eigen::Vector3d(11.5, 19.5, 2.0), 1.0F);  // pixel 11, 10: nearer, read first
  points.add(kOrigin + Eigen::Vector3d(10.5, 19.5, 1.0), 0.0F);
  points.add(kOrigin + Eigen::Vector3d(0.5, 29.5, 1.0), 0.0F);  // in the corner
  PointColoring coloring;
  coloring.categories = {{0.0F, "a", Color::rgb(0xd55e00)}, {1.0F, "b", Color::rgb(0x0072b2)}};
  for (const auto& [size, covered] : {std::pair{1.0, 1}, {2.0, 4}, {3.0, 9}}) {
    picture.setPointSize(size);
    const Image image = picture.draw(points, coloring).image();
    int near = 0, far = 0;
    for (int x = 5; x < 40; ++x) {
      for (int y = 5; y < 30; ++y) {
        near += image.at(x, y) == Color::rgb(0x0072b2) ? 1 : 0;
        far += image.at(x, y) == Color::rgb(0xd55e00) ? 1 : 0;
      }
    }
    EXPECT_EQ(near, covered);
    EXPECT_EQ(far, static_cast<int>(size));  // the column that the nearer point leaves
    EXPECT_EQ(image.at(11, 10), Color::rgb(0x0072b2));
    EXPECT_EQ(image.at(0, 0), Color::rgb(0xd55e00));
  }
}

TEST(PointPicture, LaidOutPictureIsTidyWithATrueScaleBar) {
  PointPicture picture(1600, 1000);
  picture.setTitle("strip1.las");
  OrthographicCamera camera;
  camera.frame(kOrigin, kOrigin + Eigen::Vector3d(1000.0, 600.0, 50.0), picture.mapWidth(),
               picture.mapHeight());
  PixelThinning points(camera);
  for (int i = 0; i < 1000; ++i) {
    points.add(kOrigin + Eigen::Vector3d(i, 0.6 * i, 0.05 * i), static_cast<float>(0.05 * i));
  }
  PointColoring coloring;
  coloring.heading = "elevation, m";
  coloring.fitScale(points, 0.0, false);
  EXPECT_NEAR(coloring.high, 49.95, 0.03);
  const Canvas canvas = picture.draw(points, coloring);
  canvas.write(pictureFile("view.png"));
  expectTidy(canvas);
  placeOf(canvas, "100 m");  // 170 pixels at 0.84 m: 142 m
  const PixelBox west = placeOf(canvas, "699200"), east = placeOf(canvas, "699800");
  EXPECT_NEAR((east.x + 0.5 * east.width) - (west.x + 0.5 * west.width),
              600.0 / camera.metresPerPixel(), 2.0);
}

TEST(PointPicture, SmallPicturesAreTidy) {
  for (const bool categories : {false, true}) {
    for (const PictureSize size : {PictureSize{480, 320}, {640, 420}, {800, 600}}) {
      PointPicture picture(size.width, size.height);
      picture.setTitle(std::string(3000, 'W'));
      OrthographicCamera camera;
      camera.frame(kOrigin, kOrigin + Eigen::Vector3d(1000.0, 600.0, 50.0), picture.mapWidth(),
                   picture.mapHeight());
      PixelThinning points(camera);
      points.add(kOrigin, 1.0F);
      points.add(kOrigin + Eigen::Vector3d(1000.0, 600.0, 50.0), NAN);
      PointColoring coloring;
      coloring.heading = "elevation, m";
      if (categories) coloring.categories = {{1.0F, "ground", {0, 0, 0}}};
      coloring.fitScale(points, 0.0, false);
      expectTidy(picture.draw(points, coloring));
    }
  }
}

TEST(PointColoring, EqualValuesGetAScaleAllTheSame) {
  PixelThinning points(smallCamera());
  points.add(kOrigin + Eigen::Vector3d(1.0, 1.0, 0.0), 7.0F);
  PointColoring coloring;
  coloring.fitScale(points, 0.01, false);
  EXPECT_DOUBLE_EQ(coloring.low, 6.5);
  EXPECT_DOUBLE_EQ(coloring.high, 7.5);
  EXPECT_THROW(PointPicture(100, 100), UsageError);
}

}  // namespace
}  // namespace pcl_als
