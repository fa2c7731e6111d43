// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>

#include <pcl_als/drawing/curve_panels.h>
#include <pcl_als/drawing/row_plots.h>
#include <pcl_als/report/quality_report.h>

namespace pcl_als {

/// RMSDz of the pairs against the limits of the quality levels.
BeforeAfterPlot heightPlot(const QualityReport& report);

/// Quantities against which offsets are plotted.
enum class OffsetAgainst { distance, scan_angle, time };
/// Height offsets of the pairs, one panel each; no panel where nothing was measured.
CurvePanels offsetPanels(const QualityReport& report, OffsetAgainst against);

/// Height offsets of all pairs together; empty without samples.
std::optional<HistogramPlot> offsetHistogram(const QualityReport& report);

/// Swath separation, before and after side by side; empty where there is none.
std::optional<Canvas> separationMap(const QualityReport& report, int width);

}  // namespace pcl_als
