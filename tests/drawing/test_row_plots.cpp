// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/curve_panels.h>
#include <pcl_als/drawing/row_plots.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

constexpr PictureSize kSizes[] = {{1600, 1000}, {1000, 700}, {2400, 1400}};

double middleX(const PixelBox& box) {
  return box.x + 0.5 * box.width;
}
double middleY(const PixelBox& box) {
  return box.y + 0.5 * box.height;
}

/// Columns in which a row of pixels has a colour: the first and the last.
std::pair<int, int> spanOf(const Canvas& canvas, int y, const Color& color) {
  int low = canvas.width(), high = -1;
  const Image image = canvas.image();
  for (int x = 0; x < canvas.width(); ++x) {
    if (image.at(x, y) != color) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  return {low, high};
}

BeforeAfterPlot twoPairs() {
  BeforeAfterPlot plot{"Pairs", "RMSDz, m", {{"1 : 2", 0.20, 0.05}, {"1 : 3", NAN, 0.10}}, {}};
  plot.limits = {{"QL0", 0.04}, {"QL1, QL2", 0.08}, {"QL3", 0.16}};
  return plot;
}

TEST(BeforeAfterPlot, MarkersStandAtTheirValues) {
  const Canvas canvas = drawBeforeAfter(twoPairs(), {1200, 500});
  const double zero = middleX(placeOf(canvas, "0.00")), end = middleX(placeOf(canvas, "0.20"));
  const auto pixelOf = [&](double value) { return zero + (end - zero) * value / 0.2; };
  const int first = static_cast<int>(middleY(placeOf(canvas, "1 : 2")));
  const auto after = spanOf(canvas, first, ink::after), before = spanOf(canvas, first, ink::before);
  EXPECT_NEAR(0.5 * (after.first + after.second), pixelOf(0.05), 1.5);
  EXPECT_NEAR(0.5 * (before.first + before.second), pixelOf(0.20), 1.5);
  // Nothing is drawn for what is not known.
  const int second = static_cast<int>(middleY(placeOf(canvas, "1 : 3")));
  EXPECT_EQ(spanOf(canvas, second, ink::before).second, -1);
  EXPECT_NEAR(spanOf(canvas, second, ink::after).first + 6.0, pixelOf(0.10), 2.0);
}

TEST(BeforeAfterPlot, IsTidyWithFewAndManyRows) {
  BeforeAfterPlot many = twoPairs();
  for (int i = 0; i < 100; ++i)
    many.rows.push_back({"flight_2026_line_" + std::to_string(i) + " : x", 0.3, 0.001 * i});
  many.keepLargest(40);
  ASSERT_EQ(many.rows.size(), 40U);
  EXPECT_EQ(many.rows.back().name, "flight_2026_line_99 : x");  // the largest, in their order
  EXPECT_EQ(many.rows.front().name, "1 : 3");                   // 0.10; 1 : 2 has 0.05
  expectTidy(drawBeforeAfter(many, {1400, heightForRows(40)}));
  for (const PictureSize size : kSizes) {
    expectTidy(drawBeforeAfter(twoPairs(), size));
  }
  drawBeforeAfter(many, {1400, 1780}).write(pictureFile("before_after.png"));
  EXPECT_THROW(drawBeforeAfter({}), UsageError);
}

TEST(IntervalPlot, IntervalsReachNinetyFivePercent) {
  IntervalPlot plot{
      "Gains", "factor", 1.0, {{"a", 1.0, 0.1, "1.0 ± 0.1"}, {"b", 1.1, NAN, "fixed"}}};
  const Canvas canvas = drawIntervals(plot, {1200, 500});
  expectTidy(canvas);
  const double per_unit =
      (middleX(placeOf(canvas, "1.20")) - middleX(placeOf(canvas, "0.80"))) / 0.4;
  const auto [low, high] =
      spanOf(canvas, static_cast<int>(middleY(placeOf(canvas, "a"))), ink::after);
  EXPECT_NEAR(high - low, 2.0 * 1.96 * 0.1 * per_unit, 3.0);
  EXPECT_EQ(spanOf(canvas, static_cast<int>(middleY(placeOf(canvas, "b"))), ink::after).second, -1);
  placeOf(canvas, "fixed");
  EXPECT_THROW(drawIntervals({}), UsageError);
}

CurvePanels panelsOf(int count) {
  CurvePanels plot{"Offsets", "scan angle, degrees", "offset, m", {}, true};
  for (int i = 0; i < count; ++i) {
    CurvePanels::Panel panel{"pair " + std::to_string(i), {}};
    panel.series.push_back({"before", {-20, 0, 20}, {-0.1 * i, 0.0, 0.1 * i}, {0.01, 0.01, 0.01}});
    panel.series.push_back({"after", {-20, 0, 20}, {0.001, NAN, 0.001}, {}});
    plot.panels.push_back(std::move(panel));
  }
  return plot;
}

TEST(CurvePanels, AreTidyInAnyNumber) {
  for (const int count : {1, 2, 5, 10, 16}) {
    for (const PictureSize size : kSizes) expectTidy(drawCurvePanels(panelsOf(count), size));
  }
  drawCurvePanels(panelsOf(10)).write(pictureFile("curve_panels.png"));
}

TEST(CurvePanels, ShareTheHeightAxis) {
  CurvePanels plot = panelsOf(0);
  plot.panels = {{"low", {{"after", {0, 1}, {0.1, 0.1}, {}}}},
                 {"high", {{"after", {0, 1}, {0.4, 0.4}, {}}}}};
  const Canvas canvas = drawCurvePanels(plot, {1200, 500});
  // Level lines at 0.1 and 0.4: marks of 0.1 and 0.4 are as high in both panels.
  std::vector<double> marks_low, marks_high;
  for (const auto& text : canvas.texts()) {
    if (text.text == "0.10") marks_low.push_back(middleY(text.box));
    if (text.text == "0.40") marks_high.push_back(middleY(text.box));
  }
  ASSERT_EQ(marks_low.size(), 2U);
  ASSERT_EQ(marks_high.size(), 2U);
  EXPECT_EQ(marks_low[0], marks_low[1]);
  const int split = static_cast<int>(placeOf(canvas, "high").x);
  for (const auto& [mark, left] :
       {std::pair{marks_low[0], true}, std::pair{marks_high[0], false}}) {
    const auto [low, high] = spanOf(canvas, static_cast<int>(mark), ink::after);
    EXPECT_EQ(low < split, left);
    EXPECT_GT(high - low, 200);
    EXPECT_EQ(high < split, left);
  }
}

TEST(CurvePanels, KeepsTheLargestAndRefusesNothing) {
  CurvePanels plot = panelsOf(20);
  plot.keepLargest();
  ASSERT_EQ(plot.panels.size(), CurvePanels::kMaximumPanels);
  EXPECT_EQ(plot.panels.front().title, "pair 4");
  EXPECT_THROW(drawCurvePanels({}), UsageError);
  EXPECT_THROW(drawCurvePanels(panelsOf(16), {300, 200}), UsageError);
  plot.panels[0].series[0].y.pop_back();
  EXPECT_THROW(drawCurvePanels(plot), UsageError);
}

}  // namespace
}  // namespace pcl_als
