// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>
#include <fstream>
#include <iterator>

#include <cairo.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/map_furniture.h>
#include <pcl_als/drawing/ticks.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

const Color kRed{200, 0, 0};

TEST(Canvas, FillsPartsOfPixelsByTheirShare) {
  Canvas canvas(10, 10, ink::white);
  canvas.fill({2.0, 3.5, 1.5, 1.0}, {0, 0, 0});
  const Image image = canvas.image();
  EXPECT_EQ(image.at(2, 3), (Color{127, 127, 127}));  // half of the pixel's height: 127.5
  EXPECT_EQ(image.at(3, 4), (Color{191, 191, 191}));  // a quarter: 255 * 3/4
  EXPECT_EQ(image.at(4, 3), ink::white);
  EXPECT_EQ(image.at(2, 5), ink::white);
}

TEST(Canvas, PolygonAndDiskHaveTheirArea) {
  Canvas canvas(100, 100, ink::white);
  canvas.polygon({{10, 10}, {90, 10}, {10, 90}}, {0, 0, 0});
  double area = 0.0;
  const Image triangle = canvas.image();
  for (const Color& pixel : triangle.pixels) area += (255 - pixel.r) / 255.0;
  EXPECT_NEAR(area, 3200.0, 8.0);  // half of 80 x 80
  Canvas round(100, 100, ink::white);
  round.marker(Marker::disk, {50.0, 50.0}, 60.0, {0, 0, 0});
  area = 0.0;
  const Image disk = round.image();
  for (const Color& pixel : disk.pixels) area += (255 - pixel.r) / 255.0;
  EXPECT_NEAR(area, M_PI * 900.0, 15.0);  // a rim of 188 pixels, each right to some percent
}

TEST(Canvas, StrokesDoNotDarkenWhereTheyMeet) {
  Canvas canvas(40, 40, ink::white);
  canvas.polyline({{5, 5}, {35, 35}, {5, 35}, {35, 5}}, 4.0, Color{0, 0, 0}.withAlpha(128));
  const Image image = canvas.image();
  for (const Color& pixel : image.pixels) EXPECT_GE(pixel.r, 126);
  EXPECT_NEAR(image.at(20, 20).r, 127, 1);
}

TEST(Canvas, ClipKeepsToItsBox) {
  Canvas canvas(20, 20, ink::white);
  canvas.setClip({5, 5, 10, 10});
  canvas.fill({0, 0, 20, 20}, kRed);
  canvas.clearClip();
  const Image image = canvas.image();
  EXPECT_EQ(image.at(4, 10), ink::white);
  EXPECT_EQ(image.at(5, 5), kRed);
  EXPECT_EQ(image.at(14, 14), kRed);
  EXPECT_EQ(image.at(15, 14), ink::white);
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
    const Image image = canvas.image();
    for (int y = 0; y < 200; ++y) {
      for (int x = 0; x < 200; ++x) {
        if (image.at(x, y) == ink::white) continue;
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
  const Image level_image = a.image(), upward_image = b.image();
  for (int x = 0; x < from.width; ++x) {
    for (int y = 0; y < from.height; ++y) {
      EXPECT_NEAR(level_image.at(10 + x, 10 + y).r,
                  upward_image.at(10 + y, 10 + static_cast<int>(from.width) - 1 - x).r, 3);
    }
  }
}

/// A PNG as Cairo reads it: pixels 0xAARRGGBB, colours multiplied by alpha.
std::vector<std::uint32_t> pixelsOf(const std::filesystem::path& path, int width, int height) {
  cairo_surface_t* surface = cairo_image_surface_create_from_png(path.c_str());
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  EXPECT_EQ(cairo_image_surface_get_width(surface), width);
  EXPECT_EQ(cairo_image_surface_get_height(surface), height);
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(
        cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface));
    pixels.insert(pixels.end(), row, row + width);
  }
  cairo_surface_destroy(surface);
  return pixels;
}

TEST(Canvas, PngHasThePixelsOfTheImage) {
  Canvas canvas(33, 21, Color::rgb(0x123456));
  canvas.fill({3, 4, 5, 6}, kRed);
  const auto path = pictureFile("round_trip.png");
  canvas.write(path);
  const Image image = canvas.image();
  const std::vector<std::uint32_t> pixels = pixelsOf(path, 33, 21);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Color& color = image.pixels[i];
    ASSERT_EQ(pixels[i] & 0xffffffU, (color.r << 16U | color.g << 8U | color.b)) << i;
  }
  Image translucent(2, 1, {1, 2, 3, 255});
  translucent.at(1, 0) = {255, 0, 51, 51};
  writePng(path, translucent);
  EXPECT_EQ(pixelsOf(path, 2, 1)[0], 0xff010203U);
  EXPECT_EQ(pixelsOf(path, 2, 1)[1], 0x3333000aU);  // 51 / 255 = 1/5
}

TEST(Canvas, ImagesAreDrawnWithoutInterpolation) {
  Canvas canvas(10, 6, ink::white);
  Image image(2, 1, {0, 0, 0, 0});
  image.at(0, 0) = kRed;
  canvas.draw(image, {2, 1, 6, 4});
  const Image drawn = canvas.image();
  EXPECT_EQ(drawn.at(2, 1), kRed);
  EXPECT_EQ(drawn.at(4, 4), kRed);
  EXPECT_EQ(drawn.at(5, 4), ink::white);  // transparent
  EXPECT_EQ(drawn.at(1, 1), ink::white);
}

TEST(Canvas, SvgHasTextThatCanBeSelectedAndColoursOfTheTheme) {
  Canvas canvas(100, 50, ink::white);
  canvas.setClip({10, 10, 50, 30});
  canvas.polyline({{0, 0}, {20.25, 20}, {NAN, 0}, {30, 30}, {40, 40}}, 2.0, ink::black);
  canvas.clearClip();
  TextStyle style;
  style.upward = true;
  canvas.text("σ < 2° & more", {80.0, 45.0}, style);
  const auto path = pictureFile("drawing.svg");
  canvas.write(path);
  std::ifstream stream(path);
  const std::string svg{std::istreambuf_iterator<char>(stream), {}};
  const auto has = [&](const std::string& part) {
    EXPECT_NE(svg.find(part), std::string::npos) << part << " is not in " << svg;
  };
  has("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"50\"");
  has("<svg x=\"10\" y=\"10\" width=\"50\" height=\"30\" viewBox=\"10 10 50 30\">");
  has("d=\"M0 0L20.2 20M30 30L40 40\" fill=\"none\" stroke-width=\"2.0\" class=\"stroke-black\"");
  has(">σ &lt; 2° &amp; more</text>");
  has("class=\"fill-black\"");
  has("rotate(-90 ");
  has(".stroke-black{stroke:#1a1a1a}");
  has("prefers-color-scheme:dark");
  EXPECT_EQ(canvas.svg("a < b").find("<title>a &lt; b</title>"),
            canvas.svg("a < b").find("<title>"));
}

TEST(Canvas, PdfIsADocument) {
  Canvas canvas(200, 100);
  canvas.text("strip", {20.0, 50.0});
  const std::string pdf = canvas.pdf();
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_NE(pdf.find("%%EOF"), std::string::npos);
  EXPECT_THROW(canvas.write(pictureFile("drawing.jpg")), UsageError);
}

TEST(Canvas, RefusesWhatCannotBe) {
  EXPECT_THROW(Canvas(0, 10), UsageError);
  EXPECT_THROW(Canvas(10, 30000), UsageError);
  EXPECT_THROW(writePng("/nowhere/at/all.png", Image(1, 1)), InputError);
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
  EXPECT_EQ(grouped(1234567), "1 234 567");
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
  const Image image = canvas.image();
  EXPECT_EQ(image.at(20, 76), ink::black);
  EXPECT_EQ(image.at(99, 76), ink::black);
  EXPECT_EQ(image.at(100, 76), ink::white);
  expectTidy(canvas);
}

}  // namespace
}  // namespace pcl_als
