// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <cmath>

#include <pcl_als/common/errors.h>
#include <pcl_als/drawing/waveform_plot.h>

#include "picture_checks.h"

namespace pcl_als {
namespace {

/// Echoes of 100 counts at 10 ns and of 60 counts at 21 ns, which the scanner did not return.
WaveformPlot::Panel panelNamed(const std::string& title) {
  WaveformPlot::Panel panel;
  panel.title = title;
  panel.spacing = 0.5;
  panel.baseline = 20.0;
  panel.noise = 1.5;
  const auto value = [](double t) {
    return 20.0 + 100.0 * std::exp(-0.5 * std::pow((t - 10.0) / 1.5, 2)) +
           60.0 * std::exp(-0.5 * std::pow((t - 21.0) / 1.5, 2));
  };
  for (int i = 0; i < 60; ++i) {
    panel.residuals.push_back(0.5 * ((i * 7) % 5 - 2));
    panel.samples.push_back(value(0.5 * i) + panel.residuals.back());
  }
  for (int i = 0; i < 237; ++i) panel.model.push_back(value(0.125 * i));
  panel.echoes = {{10.0, 100.0, false}, {21.0, 60.0, true}};
  panel.returns = {10.05};
  return panel;
}

WaveformPlot plotOf(int panels) {
  WaveformPlot plot{"Waveforms", {}};
  for (int i = 0; i < panels; ++i)
    plot.panels.push_back(panelNamed("point " + std::to_string(100 + i)));
  return plot;
}

TEST(WaveformPlot, IsTidyWithAnyNumberOfPanels) {
  for (const int panels : {1, 3, 12, 16}) {
    for (const PictureSize size : {PictureSize{1600, 1000}, {2400, 1400}})
      expectTidy(drawWaveforms(plotOf(panels), size));
  }
  drawWaveforms(plotOf(12)).write(pictureFile("waveforms.png"));
}

// The marks of both echoes are above their maxima, in colours of their own.
TEST(WaveformPlot, MarksReturnedAndNewEchoes) {
  WaveformPlot plot = plotOf(1);
  plot.panels[0].echoes.pop_back();
  const Canvas one = drawWaveforms(plot), both = drawWaveforms(plotOf(1));
  EXPECT_GT(countOf(both, categoryColor(1)), countOf(one, categoryColor(1)) + 20);
  EXPECT_EQ(both.elements().size(), one.elements().size() + 1);
}

TEST(WaveformPlot, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(drawWaveforms({"none", {}}), UsageError);
  EXPECT_THROW(drawWaveforms(plotOf(16), {600, 400}), UsageError);
  WaveformPlot empty = plotOf(1);
  empty.panels[0].samples.clear();
  EXPECT_THROW(drawWaveforms(empty), UsageError);
}

}  // namespace
}  // namespace pcl_als
