// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <functional>
#include <random>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/section_search.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

constexpr double kEast = 699000.0, kNorth = 5660000.0;

TEST(PlaneGrid, FitsAPlaneAndItsNoise) {
  PlaneGrid grid({kEast, kNorth}, {kEast + 20.0, kNorth + 20.0}, 4.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 20.0);
  std::normal_distribution<double> noise(0.0, 0.03);
  for (int i = 0; i < 20000; ++i) {
    const double x = place(random), y = place(random);
    grid.add({kEast + x, kNorth + y, 100.0 + 0.5 * x - 0.25 * y + noise(random)});
  }
  const auto plane = grid.planeAt(kEast + 10.0, kNorth + 10.0);
  ASSERT_TRUE(plane);
  // 800 points: heights to 0.03 / sqrt(800) = 1 mm, slopes to that over 4 / sqrt(12) m.
  EXPECT_NEAR(plane->heightAt(kEast + 10.0, kNorth + 10.0), 102.5, 0.005);
  EXPECT_NEAR(plane->slope_x, 0.5, 0.005);
  EXPECT_NEAR(plane->slope_y, -0.25, 0.005);
  EXPECT_NEAR(plane->rms, 0.03, 0.003);
  EXPECT_FALSE(grid.planeAt(kEast - 1.0, kNorth));
}

TEST(PlaneGrid, NeedsPointsThatSpanIt) {
  PlaneGrid grid({0.0, 0.0}, {10.0, 10.0}, 10.0);
  for (int i = 0; i < 5; ++i) grid.add({1.0 + i, 2.0 + i % 2, 3.0});
  EXPECT_FALSE(grid.plane(0, 0)) << "five points";
  PlaneGrid line({0.0, 0.0}, {10.0, 10.0}, 10.0);
  for (int i = 0; i < 50; ++i) line.add({0.1 * i, 0.1 * i, 3.0});
  EXPECT_FALSE(line.plane(0, 0)) << "points in a line";
  EXPECT_THROW(PlaneGrid({0.0, 0.0}, {10.0, 10.0}, 0.0), UsageError);
  EXPECT_LE(PlaneGrid({0.0, 0.0}, {1e6, 1e6}, 0.1).columns(), 3000);
}

TEST(SectionPoints, TakesWhatLiesInTheStripOfGround) {
  SectionPoints section({{kEast, kNorth}, {kEast + 10.0, kNorth + 10.0}, 1.0});
  const double d = std::sqrt(0.5);
  section.add({kEast + 5.0, kNorth + 5.0, 120.0}, 3);                      // on the line
  section.add({kEast + 5.0 - 0.9 * d, kNorth + 5.0 + 0.9 * d, 121.0}, 3);  // 0.9 m aside
  section.add({kEast + 5.0 - 1.1 * d, kNorth + 5.0 + 1.1 * d, 122.0}, 3);  // 1.1 m aside
  section.add({kEast - 0.1, kNorth - 0.1, 120.0}, 3);                      // before the start
  section.add({kEast + 5.0, kNorth + 5.0, NAN}, 3);
  ASSERT_EQ(section.points().size(), 2U);
  EXPECT_NEAR(section.points()[0].along, std::sqrt(50.0), 1e-6);
  EXPECT_NEAR(section.baseHeight() + section.points()[1].height, 121.0, 1e-5);
  EXPECT_THROW(SectionPoints({{1.0, 1.0}, {1.0, 1.0}, 1.0}), UsageError);
  EXPECT_THROW(SectionPoints({{1.0, 1.0}, {2.0, 1.0}, 0.0}), UsageError);
}

TEST(SectionPoints, ThinsEvenly) {
  SectionPoints section({{0.0, 0.0}, {1000.0, 0.0}, 1.0}, 100);
  for (int i = 0; i < 1000; ++i) section.add({static_cast<double>(i), 0.0, 0.0}, 0);
  EXPECT_EQ(section.seen(), 1000U);
  ASSERT_LE(section.points().size(), 100U);
  ASSERT_GE(section.points().size(), 50U);
  const float step = section.points()[1].along - section.points()[0].along;
  for (std::size_t i = 1; i < section.points().size(); ++i) {
    EXPECT_EQ(section.points()[i].along - section.points()[i - 1].along, step);
  }
}

/// A house with a gable of 45 degrees, ridge along north, 12 m wide, on flat ground; strip 1 lies
/// \a shift east of strip 0.
void addHouse(SectionSearch& search, double shift) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(0.0, 60.0);
  for (std::size_t strip = 0; strip < 2; ++strip) {
    for (int i = 0; i < 40000; ++i) {
      const double x = place(random), y = place(random);
      const bool roof = std::abs(x - 30.0) < 6.0 && std::abs(y - 30.0) < 10.0;
      const double z = roof ? 8.0 - std::abs(x - 30.0) : 0.0;
      search.add({kEast + x + (strip == 1 ? shift : 0.0), kNorth + y, 50.0 + z}, strip);
    }
  }
}

TEST(SectionSearch, FindsTheGableAndItsDirection) {
  SectionSearch search({kEast, kNorth}, {kEast + 60.0, kNorth + 60.0}, 1.5, 2);
  addHouse(search, 0.3);
  const auto places = search.find(3);
  ASSERT_GE(places.size(), 1U);
  EXPECT_EQ(places[0].kind, SectionSearch::Place::Kind::gable);
  EXPECT_EQ(places[0].strips, 2U);
  const Eigen::Vector2d middle = 0.5 * (places[0].line.from + places[0].line.to);
  // Cells are 1.5 m: the ridge is met to one of them.
  EXPECT_NEAR(middle.x(), kEast + 30.15, 1.5);
  EXPECT_NEAR(middle.y(), kNorth + 30.0, 10.0);
  const Eigen::Vector2d along = (places[0].line.to - places[0].line.from).normalized();
  EXPECT_NEAR(along.x(), 1.0, 0.02);  // across the ridge, from west to east
  // A shift of 0.3 m on a slope of 45 degrees is a height of 0.3 m.
  EXPECT_NEAR(places[0].difference, 0.3, 0.03);
}

/// Ground of two strips, heights by a function of the place relative to (kEast, kNorth).
void addGround(SectionSearch& search, const std::function<double(double, double)>& height) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(0.0, 60.0);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (std::size_t strip = 0; strip < 2; ++strip) {
    for (int i = 0; i < 40000; ++i) {
      const double x = place(random), y = place(random);
      search.add({kEast + x, kNorth + y, height(x, y) + noise(random)}, strip);
    }
  }
}

TEST(SectionSearch, CallsWavesOfTheGroundNoGable) {
  // Waves of the ground of 1.6 m from crest to trough, as forest floor: slopes of 22 degrees.
  SectionSearch waves({kEast, kNorth}, {kEast + 60.0, kNorth + 60.0}, 1.5, 2);
  addGround(waves, [](double x, double /*y*/) { return 0.8 * std::sin(0.5 * x); });
  const auto places = waves.find(5);
  ASSERT_FALSE(places.empty());
  for (const SectionSearch::Place& place : places)
    EXPECT_NE(place.kind, SectionSearch::Place::Kind::gable);
}

TEST(SectionSearch, FindsNothingOnFlatGroundOrInOneStrip) {
  SectionSearch flat({0.0, 0.0}, {30.0, 30.0}, 2.0, 2);
  SectionSearch one({kEast, kNorth}, {kEast + 60.0, kNorth + 60.0}, 1.5, 1);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0.0, 30.0);
  for (int i = 0; i < 20000; ++i) {
    flat.add({place(random), place(random), 5.0}, static_cast<std::size_t>(i % 2));
    one.add({kEast + place(random), kNorth + place(random), place(random)}, 0);
  }
  EXPECT_TRUE(flat.find(5).empty());
  EXPECT_TRUE(one.find(5).empty());
}

TEST(SectionPicture, PointsStandWhereTheAxesSay) {
  const SectionLine line{{kEast, kNorth}, {kEast + 20.0, kNorth}, 1.0};
  SectionPoints before(line), after(line);
  before.add({kEast, kNorth, 100.0}, 0);
  before.add({kEast + 20.0, kNorth, 110.0}, 1);
  after.add({kEast + 10.0, kNorth, 105.0}, 0);
  SectionPicture picture;
  picture.setTitle("Roof");
  picture.setStrips({"57138", "57139"});
  picture.addPanel("Before", before);
  picture.addPanel("After", after);
  const Canvas canvas = picture.draw({1600, 1000});
  canvas.write(pictureFile("section.png"));
  expectTidy(canvas);
  // The point half way stands in the middle of the lower panel: 105 m is the middle of the heights.
  const PixelBox tick = placeOf(canvas, "distance along the section, m");
  const double x = tick.x + 0.5 * tick.width;
  Eigen::Vector2d sum(0.0, 0.0);
  int count = 0;
  const Image image = canvas.image();
  for (int y = 530; y < 960; ++y) {
    for (int c = 110; c < 1420; ++c) {
      const Color& pixel = image.at(c, y);
      if (pixel.b < 150 || pixel.r > 60) continue;  // blue of the first category
      sum += Eigen::Vector2d(c + 0.5, y + 0.5);
      ++count;
    }
  }
  ASSERT_GT(count, 15);
  EXPECT_NEAR(sum.x() / count, x, 1.5);
  // Length 20 m over 1330 pixels against 10.8 m over the panel's height: the factor is round and
  // the largest that fits.
  EXPECT_DOUBLE_EQ(picture.exaggeration({1600, 1000}), 0.5);
  placeOf(canvas,
          "from (" + std::string("699000.0, 5660000.0) to (699020.0, 5660000.0), width 2.0 m, "
                                 "vertical exaggeration 0.50×"));
  EXPECT_THROW(SectionPicture().draw(), UsageError);
  SectionPoints other({{0.0, 0.0}, {1.0, 0.0}, 1.0});
  EXPECT_THROW(picture.addPanel("x", other), UsageError);
  SectionPicture nothing;
  nothing.addPanel("x", other);
  EXPECT_THROW(nothing.draw(), UsageError);
}

/// Points on a line 10 m up, every 5 cm, of two strips 5 cm apart in height.
SectionPoints flatSection(const SectionLine& line) {
  SectionPoints points(line);
  for (int i = 0; i < 400; ++i)
    points.add({kEast + 0.05 * i, kNorth, 10.0 + 0.05 * (i % 2)}, i % 2);
  return points;
}

TEST(SectionPicture, OutliersAreMarkedAtTheEdgeAndDoNotCompressTheAxis) {
  const SectionLine line{{kEast, kNorth}, {kEast + 20.0, kNorth}, 1.0};
  SectionPoints clean = flatSection(line), outliers = flatSection(line);
  outliers.add({kEast + 5.0, kNorth, -60.0}, 0);
  outliers.add({kEast + 6.0, kNorth, -58.0}, 1);
  SectionPicture expected, picture;
  expected.addPanel("", clean);
  picture.addPanel("", outliers);
  // With the outliers' 70 m on the axis it would be 0.15 times; alone the points have 100 times.
  EXPECT_GT(expected.exaggeration({1600, 1000}), 50.0);
  EXPECT_GT(picture.exaggeration({1600, 1000}), 50.0);
  const Canvas canvas = picture.draw({1600, 1000});
  canvas.write(pictureFile("section_outliers.png"));
  expectTidy(canvas);
  bool said = false;
  for (const auto& text : canvas.texts())
    said = said || text.text.find("2 points below") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST(SectionPicture, ARoofAndItsGroundAreShownWhole) {
  const SectionLine line{{kEast, kNorth}, {kEast + 20.0, kNorth}, 1.0};
  SectionPoints points(line);
  for (int i = 0; i < 400; ++i) {
    const double x = 0.05 * i, roof = 12.0 - std::abs(x - 10.0);
    points.add({kEast + x, kNorth, std::abs(x - 10.0) < 8.0 ? roof : 0.0}, 0);
  }
  SectionPicture picture;
  picture.addPanel("", points);
  // 12 m of height over the panel: a narrower axis would show them larger.
  EXPECT_LT(picture.exaggeration({1600, 1000}), 1.0);
}

}  // namespace
}  // namespace pcl_als
