// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/drawing/result_plots.h>

namespace pcl_als {

/// Estimated biases with their 95 % intervals, one row each, and why others are not estimated.
Canvas drawParameters(const CalibrationResult& result, PictureSize size = {});

/// Correlations of the estimated parameters as a heat map with numbers. UsageError when there is
/// none.
Canvas drawCorrelation(const CalibrationResult& result, PictureSize size = {});

/// sigma0 and the largest update over the iterations. UsageError when there is none.
Canvas drawConvergence(const CalibrationResult& result, PictureSize size = {});

/// RMS of the normal distances of each pair of strips before and after. UsageError without pairs.
Canvas drawPairs(const CalibrationResult& result, PictureSize size = {});

/// Normal distances of the pairs before and after as histograms. UsageError where the result has
/// none.
Canvas drawResiduals(const CalibrationResult& result, PictureSize size = {});

/// Errors of the scan angle over the scan angle, with their standard deviations. UsageError without
/// such a curve.
Canvas drawScanAngleCurve(const CalibrationResult& result, PictureSize size = {});

/// Estimated trajectory errors of each strip over time: position and angles.
/// UsageError without strip corrections.
Canvas drawStripErrors(const CalibrationResult& result, PictureSize size = {});

}  // namespace pcl_als
