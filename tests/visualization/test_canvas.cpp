// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/visualization/map_furniture.h>
#include <pcl_als/visualization/ticks.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

const Color kRed{200, 0, 0};

TEST(Canvas, FillsPartsOfPixelsByTheirShare) {
  Canvas canvas(10, 10, ink::white);
  canvas.fill({2.0, 3.5, 1.5, 1.0}, {0, 0, 0});
  EXPECT_EQ(canvas.image().at(2, 3), (Color{128, 128, 128}));  // half of the pixel's height
  EXPECT_EQ(canvas.image().at(3, 4), (Color{191, 191, 191}));  // a quarter: 255 * 3/4
  EXPECT_EQ(canvas.image().at(4, 3), ink::white);
  EXPECT_EQ(canvas.image().at(2, 5), ink::white);
}

TEST(Canvas, PolygonAndDiskHaveTheirArea) {
  Canvas canvas(100, 100, ink::white);
  canvas.polygon({{10, 10}, {90, 10}, {10, 90}}, {0, 0, 0});
  double area = 0.0;
  for (const Color& pixel : canvas.image().pixels) area += (255 - pixel.r) / 255.0;
  EXPECT_NEAR(area, 3200.0, 8.0);  // half of 80 x 80
  Canvas round(100, 100, ink::white);
  round.marker(Marker::disk, {50.0, 50.0}, 60.0, {0, 0, 0});
  area = 0.0;
  for (const Color& pixel : round.image().pixels) area += (255 - pixel.r) / 255.0;
  EXPECT_NEAR(area, M_PI * 900.0, 15.0);  // a rim of 188 pixels, each right to some percent
}

TEST(Canvas, StrokesDoNotDarkenWhereTheyMeet) {
  Canvas canvas(40, 40, ink::white);
  canvas.polyline({{5, 5}, {35, 35}, {5, 35}, {35, 5}}, 4.0, Color{0, 0, 0}.withAlpha(128));
  for (const Color& pixel : canvas.image().pixels) EXPECT_GE(pixel.r, 126);
  EXPECT_NEAR(canvas.image().at(20, 20).r, 127, 1);
}

TEST(Canvas, ClipKeepsToItsBox) {
  Canvas canvas(20, 20, ink::white);
  canvas.setClip({5, 5, 10, 10});
  canvas.fill({0, 0, 20, 20}, kRed);
  canvas.clearClip();
  EXPECT_EQ(canvas.image().at(4, 10), ink::white);
  EXPECT_EQ(canvas.image().at(5, 5), kRed);
  EXPECT_EQ(canvas.image().at(14, 14), kRed);
  EXPECT_EQ(canvas.image().at(15, 14), ink::white);
}

TEST(Canvas, TextCoversItsBoxAndNothingElse) {
  for (const bool upward : {false, true}) {
    Canvas canvas(200, 200, ink::white);
    TextStyle style;
    style.size = 20.0;
    style.upward = upward;
    style.horizontal = style.vertical = Align::center;
    const PixelBox box = canvas.text("σ ± 2°", {100.0, 100.0}, style);
    EXPECT_GT(upward ? box.height : box.width, 40.0);
    EXPECT_NEAR(box.x + 0.5 * box.width, 100.0, 1.0);
    EXPECT_NEAR(box.y + 0.5 * box.height, 100.0, 1.0);
    int inside = 0;
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) {
        if (canvas.image().at(x, y) == ink::white) continue;
        EXPECT_TRUE(box.contains({x + 0.5, y + 0.5, 0.0, 0.0}));
        ++inside;
      }
    }
    EXPECT_GT(inside, 100);
  }
}

TEST(Canvas, ReadingUpwardIsATurnToTheLeft) {
  TextStyle level, upward;
  level.vertical = upward.horizontal = Align::low;
  level.horizontal = upward.vertical = Align::low;
  upward.upward = true;
  Canvas a(120, 120, ink::white), b(120, 120, ink::white);
  const PixelBox from = a.text("Fg7", {10, 10}, level), to = b.text("Fg7", {10, 10}, upward);
  ASSERT_EQ(from.width, to.height);
  for (int x = 0; x < from.width; ++x) {
    for (int y = 0; y < from.height; ++y) {
      EXPECT_EQ(a.image().at(10 + x, 10 + y),
                b.image().at(10 + y, 10 + static_cast<int>(from.width) - 1 - x));
    }
  }
}

TEST(Canvas, PngComesBackAsItWas) {
  Canvas canvas(33, 21, Color::rgb(0x123456));
  canvas.fill({3, 4, 5, 6}, kRed);
  const auto path = pictureFile("round_trip.png");
  writePng(path, canvas.image());
  const Image read = readPng(path);
  ASSERT_EQ(read.width, 33);
  ASSERT_EQ(read.height, 21);
  EXPECT_TRUE(read.pixels == canvas.image().pixels);
  Image translucent(2, 1, {1, 2, 3, 255});
  translucent.at(1, 0) = {9, 8, 7, 40};
  writePng(path, translucent);
  EXPECT_EQ(readPng(path).at(1, 0), (Color{9, 8, 7, 40}));
}

TEST(Canvas, RefusesWhatCannotBe) {
  EXPECT_THROW(Canvas(0, 10), UsageError);
  EXPECT_THROW(Canvas(10, 30000), UsageError);
  EXPECT_THROW(writePng("/nowhere/at/all.png", Image(1, 1)), InputError);
  EXPECT_THROW(readPng("/nowhere/at/all.png"), InputError);
  EXPECT_THROW(ColorMap::named("rainbow"), UsageError);
}

TEST(Ticks, AreRoundAndInside) {
  const Ticks ticks = niceTicks(-0.37, 1.02, 6);
  EXPECT_DOUBLE_EQ(ticks.step, 0.5);
  ASSERT_EQ(ticks.values.size(), 3U);
  EXPECT_EQ(ticks.label(ticks.values[0]), "0.0");
  EXPECT_EQ(niceTicks(84800.0, 85100.0, 4).label(84900.0), "84900");
  EXPECT_EQ(niceTicks(-1.0, 1.0, 5).label(-0.5), "−0.5");
  for (const double span : {1e-9, 0.03, 1.0, 7.0, 99.0, 12345.0, 1e12}) {
    for (const int most : {2, 3, 5, 10}) {
      const Ticks each = niceTicks(3.0 * span, 4.0 * span, most);
      EXPECT_LE(each.values.size(), static_cast<std::size_t>(std::max(2, most)));
      for (const double value : each.values) {
        EXPECT_GE(value, 3.0 * span * (1 - 1e-9));
        EXPECT_LE(value, 4.0 * span * (1 + 1e-9));
      }
    }
  }
  EXPECT_THROW(niceTicks(1.0, 1.0, 5), UsageError);
  EXPECT_THROW(niceTicks(0.0, INFINITY, 5), UsageError);
}

TEST(Ticks, NumbersInWords) {
  EXPECT_EQ(numberText(-0.004, 2), "0.00");
  EXPECT_EQ(numberText(-1.5, 1), "−1.5");
  EXPECT_EQ(numberText(NAN, 1), "–");
  EXPECT_EQ(significantText(0.01234, 2), "0.012");
  EXPECT_EQ(significantText(1234.0, 2), "1234");
  EXPECT_EQ(countText(1234567), "1 234 567");
  EXPECT_EQ(lengthText(0.5), "0.5 m");
  EXPECT_EQ(lengthText(200.0), "200 m");
  EXPECT_EQ(lengthText(2000.0), "2 km");
  EXPECT_DOUBLE_EQ(roundDown125(499.0), 200.0);
  EXPECT_DOUBLE_EQ(roundDown125(500.0), 500.0);
}

TEST(ColorMap, EndsAndMiddle) {
  const ColorMap viridis = ColorMap::named("viridis");
  EXPECT_EQ(viridis(0.0), Color::rgb(0x440154));
  EXPECT_EQ(viridis(1.0), Color::rgb(0xfde725));
  EXPECT_EQ(viridis(-3.0), viridis(0.0));
  const Color middle = ColorMap::named("diverging")(0.5);
  EXPECT_EQ(middle, Color::rgb(0xf2f2f2));
  EXPECT_EQ(ColorMap::named("gray")(NAN), (Color{0x99, 0x99, 0x99}));
}

// Lightness as anyone sees it orders viridis, cividis and gray: nobody needs hue to read them.
TEST(ColorMap, RisesInLightness) {
  const auto lightness = [](const Color& c) {
    return 0.2126 * std::pow(c.r / 255.0, 2.2) + 0.7152 * std::pow(c.g / 255.0, 2.2) +
           0.0722 * std::pow(c.b / 255.0, 2.2);
  };
  for (const char* name : {"viridis", "cividis", "gray"}) {
    const ColorMap map = ColorMap::named(name);
    for (int i = 1; i <= 100; ++i) {
      EXPECT_GT(lightness(map(i / 100.0)), lightness(map((i - 1) / 100.0)) - 1e-3) << name << i;
    }
  }
}

// Colours as a reader without green cones (deuteranopia; matrix of Viénot, Brettel, Mollon 1999 in
// linear RGB) sees them: the categories that a picture begins with stay apart.
TEST(Categories, StayApartForColourBlindReaders) {
  const auto seen = [](const Color& c) {
    const Eigen::Vector3d linear(std::pow(c.r / 255.0, 2.2), std::pow(c.g / 255.0, 2.2),
                                 std::pow(c.b / 255.0, 2.2));
    Eigen::Matrix3d blind;
    blind << 0.29275, 0.70725, 0.0, 0.29275, 0.70725, 0.0, -0.02234, 0.02234, 1.0;
    return Eigen::Vector3d((blind * linear).cwiseMax(0.0).array().pow(1.0 / 2.2));
  };
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT((seen(categoryColor(i)) - seen(categoryColor(j))).norm(), 0.1) << i << ' ' << j;
    }
  }
}

TEST(ScaleBar, IsAsLongAsItSays) {
  Canvas canvas(400, 100);
  const PixelBox bar = drawScaleBar(canvas, 0.25, 150.0, {20.0, 80.0});
  EXPECT_DOUBLE_EQ(bar.width, 80.0);  // 20 m at 4 pixels per metre; 50 m would be 200 pixels
  placeOf(canvas, "20 m");
  EXPECT_EQ(canvas.image().at(20, 76), ink::black);
  EXPECT_EQ(canvas.image().at(99, 76), ink::black);
  EXPECT_EQ(canvas.image().at(100, 76), ink::white);
  expectTidy(canvas);
}

}  // namespace
}  // namespace pcl_als
