// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/parameter_text.h>
#include <pcl_als/drawing/block_map.h>
#include <pcl_als/drawing/calibration_plots.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

CalibrationResult sample() {
  CalibrationResult result;
  result.converged = true;
  const auto set = [&](SystemParameter p, double bias, double std) {
    ParameterEstimate& e = result[p];
    e.bias = bias * infoOf(p).internal_per_unit;
    e.std = std * infoOf(p).internal_per_unit;
    e.status = ParameterStatus::estimated;
    result.correlation_order.push_back(p);
  };
  set(SystemParameter::lever_arm_x, 0.05, 0.001);
  set(SystemParameter::boresight_pitch, -30.0, 1.0);
  set(SystemParameter::boresight_roll, -90.13, 0.28);
  set(SystemParameter::range_bias, 0.1194, 0.0022);
  result[SystemParameter::boresight_heading].status = ParameterStatus::not_estimable;
  result[SystemParameter::boresight_heading].reason =
      "needs two parallel lines flown in the same direction with a small overlap";
  result.correlation = Eigen::MatrixXd::Identity(4, 4);
  result.correlation(0, 1) = result.correlation(1, 0) = -0.94;
  result.correlation(2, 3) = result.correlation(3, 2) = 0.5;
  result.iterations = {{1000, 0.9, 0.6}, {1000, 0.8, 0.02}, {1000, 0.8, 1e-5}};
  result.pairs = {{"1", "2", 1000, 0.27, 0.024, 0, 0},
                  {"strip_0007_north", "3", 500, 0.1, 0.02, 0, 0}};
  result.residuals = {{-0.2, -0.1, 0.0, 0.1, 0.2}, {10, 40, 30, 20}, {0, 50, 50, 0}};
  result.strip_errors = {
      {"1", {{100.0, {1e-3, 2e-3, 0.0}, {1e-6, 0, 0}}, {110.0, {0, 0, 0}, {0, 0, 0}}}, {}}};
  return result;
}

TEST(CalibrationPlots, AreTidyInThreeSizes) {
  const CalibrationResult result = sample();
  for (const PictureSize size : {PictureSize{1600, 1000}, {1000, 700}, {2400, 1400}}) {
    expectTidy(drawParameters(result, size));
    expectTidy(drawCorrelation(result, size));
    expectTidy(drawConvergence(result, size));
    expectTidy(drawPairs(result, size));
    expectTidy(drawResiduals(result, size));
    expectTidy(drawStripErrors(result, size));
  }
  drawParameters(result).write(pictureFile("parameters.png"));
}

TEST(CalibrationPlots, AreTidyWithManyStrips) {
  CalibrationResult result = sample();
  const StripErrors strip = result.strip_errors[0];
  CurvePlot curves{"Many", "x", "y", {}};
  for (int i = 0; i < 80; ++i) {
    result.strip_errors.push_back(strip);
    result.strip_errors.back().id = "line_" + std::to_string(i);
    result.pairs.push_back({"line_" + std::to_string(i), "x", 10, 0.1, 0.01, 0, 0});
    curves.series.push_back({"line_" + std::to_string(i), {0, 1}, {0.0, 1.0 * i}, {}});
  }
  expectTidy(drawPairs(result, {1400, 1780}));
  expectTidy(drawCurves(curves));
  int named = 0, more = 0;
  const Canvas errors = drawStripErrors(result, {1400, 760});
  expectTidy(errors);
  for (const auto& text : errors.texts()) {
    named += text.text.rfind("line_", 0) == 0 || text.text == "1" ? 1 : 0;
    if (text.text.rfind("and ", 0) == 0) more = std::stoi(text.text.substr(4));
  }
  EXPECT_GT(more, 40);
  EXPECT_GE(named + more, 81);  // "1" is a mark of an axis, too
}

TEST(CalibrationPlots, SayTheNumbers) {
  const CalibrationResult result = sample();
  EXPECT_EQ(estimateText(SystemParameter::boresight_roll, result[SystemParameter::boresight_roll]),
            "−90.13 ± 0.28 arcsec");
  EXPECT_EQ(
      estimateText(SystemParameter::boresight_pitch, result[SystemParameter::boresight_pitch]),
      "−30.0 ± 1.0 arcsec");
  EXPECT_EQ(estimateText(SystemParameter::lever_arm_y, result[SystemParameter::lever_arm_y]),
            "not estimated");
  placeOf(drawParameters(result), "0.1194 ± 0.0022 m");
  const Canvas canvas = drawCorrelation(result);
  int shown = 0;
  for (const auto& text : canvas.texts()) shown += text.text == "−0.94" ? 1 : 0;
  EXPECT_EQ(shown, 2);
}

// The interval of the roll reaches 1.96 sigma to both sides of its dot, on the scale of the ticks.
TEST(CalibrationPlots, IntervalsHaveTheirLength) {
  CalibrationResult result;
  ParameterEstimate& roll = result[SystemParameter::boresight_roll];
  roll.status = ParameterStatus::estimated;
  roll.bias = 0.0;
  roll.std = 10.0 * kRadiansPerArcsec;
  const Canvas canvas = drawParameters(result, {1600, 1000});
  const PixelBox from = placeOf(canvas, "−20"), to = placeOf(canvas, "20");
  const double per_arcsec = (to.x + 0.5 * to.width - from.x - 0.5 * from.width) / 40.0;
  const PixelBox name = placeOf(canvas, "boresight roll");
  const int y = static_cast<int>(name.y + 0.5 * name.height);
  int low = 1600, high = 0;
  const Image image = canvas.image();
  for (int x = 0; x < 1600; ++x) {
    if (image.at(x, y) != ink::after) continue;
    low = std::min(low, x);
    high = std::max(high, x);
  }
  EXPECT_NEAR(high - low, 2.0 * 19.6 * per_arcsec, 4.0);  // caps are 2 pixels wide
}

TEST(CalibrationPlots, HeatMapCellsHaveTheirColour) {
  const Canvas canvas = drawCorrelation(sample(), {1600, 1000});
  const ColorMap map = ColorMap::named("diverging");
  // Four ones on the diagonal, cells of 130 pixels, less the number and the rim.
  EXPECT_GT(countOf(canvas, map(1.0)), 4 * 128 * 128 * 9 / 10);
  EXPECT_GT(countOf(canvas, map(0.5 * (1.0 - 0.94))), 2 * 128 * 128 * 9 / 10);
}

TEST(CalibrationPlots, RefuseWhatTheResultLacks) {
  const CalibrationResult nothing;
  EXPECT_THROW(drawCorrelation(nothing), UsageError);
  EXPECT_THROW(drawConvergence(nothing), UsageError);
  EXPECT_THROW(drawPairs(nothing), UsageError);
  EXPECT_THROW(drawResiduals(nothing), UsageError);
  EXPECT_THROW(drawStripErrors(nothing), UsageError);
  expectTidy(drawParameters(nothing));
}

TEST(ResultPlots, HistogramBarsHaveTheirHeights) {
  HistogramPlot plot{"Bars", "m", {0.0, 1.0, 2.0}, {{"after", {25.0, 75.0}}}};
  const Canvas canvas = drawHistogram(plot, {800, 600});
  const Image image = canvas.image();
  expectTidy(canvas);
  const PixelBox zero = placeOf(canvas, "0"), fifty = placeOf(canvas, "50");
  const double per_percent = (zero.y - fifty.y) / 50.0;
  // Height of the outline above the middle of each bar.
  const PixelBox left = placeOf(canvas, "0.0"), right = placeOf(canvas, "2.0");
  const double x0 = left.x + 0.5 * left.width, x2 = right.x + 0.5 * right.width;
  for (const auto& [share, percent] : {std::pair{0.25, 25.0}, std::pair{0.75, 75.0}}) {
    const int x = static_cast<int>(x0 + share * (x2 - x0));
    int top = 0;
    while (top < 599 && image.at(x, top) != ink::after) ++top;
    EXPECT_NEAR(zero.y + 0.5 * zero.height - top, percent * per_percent, 2.5);
  }
}

TEST(ResultPlots, CurvesAreTidyAndGapsStayGaps) {
  CurvePlot plot{"Offset against scan angle", "scan angle, degrees", "offset, m", {}};
  plot.series.push_back({"1 : 2 before",
                         {-20, -10, 0, 10, 20},
                         {-0.2, -0.1, NAN, 0.1, 0.2},
                         {0.01, 0.01, NAN, 0.01, 0.01}});
  plot.series.push_back({"1 : 2 after", {-20, 0, 20}, {0.0, 0.001, 0.0}, {}});
  const Canvas canvas = drawCurves(plot);
  canvas.write(pictureFile("curves.png"));
  expectTidy(canvas);
  EXPECT_GT(countOf(canvas, ink::before), 500);
  EXPECT_GT(countOf(canvas, ink::after), 500);
  plot.series[0].y.pop_back();
  EXPECT_THROW(drawCurves(plot), UsageError);
  EXPECT_THROW(drawCurves({"t", "x", "y", {{"s", {NAN}, {1.0}, {}}}}), UsageError);
}

// Table 6 of Habib et al. 2011.
TEST(ResultPlots, ConfusionShowsCounts) {
  ConfusionPlot plot{"Confusion matrix",
                     {"tree", "built-up", "grass", "soil"},
                     {{130, 40, 20, 18}, {119, 386, 12, 16}, {34, 26, 59, 43}, {20, 16, 10, 61}}};
  const Canvas canvas = drawConfusion(plot);
  canvas.write(pictureFile("confusion.png"));
  expectTidy(canvas);
  placeOf(canvas, "386");
  placeOf(canvas, "classified as");
  EXPECT_GT(countOf(canvas, ColorMap::named("cividis")(386.0 / 533.0)), 10000);
  plot.matrix.pop_back();
  EXPECT_THROW(drawConfusion(plot), UsageError);
}

TEST(BlockMap, ShowsOverlapsWhereTheyAre) {
  StripCoverage coverage({0.0, 0.0}, {1000.0, 500.0}, 2);
  for (double x = 1.0; x < 1000.0; x += 2.0) {
    for (double y = 1.0; y < 500.0; y += 2.0) {
      if (y < 300.0) coverage.add({x, y, 0.0}, 0);
      if (y > 200.0) coverage.add({x, y, 0.0}, 1);
    }
  }
  EXPECT_TRUE(coverage.covers(0, 10, 10));
  EXPECT_FALSE(coverage.covers(1, 10, 10));
  BlockMap map;
  map.setTitle("Block");
  map.setAreas({{{100.0, 100.0}, {150.0, 150.0}}});
  map.setControl({{500.0, 250.0}});
  const Canvas canvas = map.draw(coverage, {"1", "2"});
  canvas.write(pictureFile("block_map.png"));
  expectTidy(canvas);
  // 200 and 100 of 500 m are seen by one strip (each) and by both.
  const double one = countOf(canvas, Color::rgb(0xe9eef2)),
               two = countOf(canvas, Color::rgb(0xc3d7e6));
  EXPECT_NEAR(one / two, 400.0 / 100.0, 0.4);
  EXPECT_THROW(map.draw(coverage, {"1"}), UsageError);
  // As high as the legend of many strips needs, and with scale and arrow.
  StripCoverage flat({0.0, 0.0}, {4000.0, 100.0}, 40);
  flat.add({10.0, 10.0, 0.0}, 39);
  std::vector<std::string> names;
  for (int i = 0; i < 40; ++i) names.push_back("line_" + std::to_string(i));
  const Canvas low = map.draw(flat, names, {1400, BlockMap::heightFor(flat, 1400)});
  expectTidy(low);
  placeOf(low, "N");
  placeOf(low, "and 24 more");
}

/// Marks stand at their places, two at the same place with one label, and the legend names them.
TEST(BlockMap, MarksPartsOfFlightPaths) {
  StripCoverage coverage({0.0, 0.0}, {1000.0, 500.0}, 1);
  for (double x = 1.0; x < 1000.0; x += 2.0)
    for (double y = 1.0; y < 500.0; y += 2.0) coverage.add({x, y, 0.0}, 0);
  BlockMap map;
  const Canvas plain = map.draw(coverage, {"1"});
  map.setMarks({{{200.0, 100.0}, {300.0, 100.0}, "1"},
                {{205.0, 100.0}, {295.0, 100.0}, "2"},
                {{800.0, 400.0}, {800.0, 450.0}, "7"}},
               "large errors");
  const Canvas canvas = map.draw(coverage, {"1"});
  expectTidy(canvas);
  placeOf(canvas, "large errors");
  const auto both = placeOf(canvas, "1, 2"), third = placeOf(canvas, "7");
  EXPECT_LT(both.x, third.x);
  EXPECT_GT(both.y, third.y);  // further south
  EXPECT_EQ(countOf(plain, Color::rgb(0xcc0033)), 0);
  EXPECT_GT(countOf(canvas, Color::rgb(0xcc0033)), 300);
}

}  // namespace
}  // namespace pcl_als
