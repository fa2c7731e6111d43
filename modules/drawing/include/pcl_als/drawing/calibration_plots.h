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

/// "lever arm x"
std::string plainName(SystemParameter parameter);

/// Decimals that show two significant digits of a standard deviation, in its unit; six where it is
/// unknown.
int decimalsOfStd(double std);

/// An estimate with its standard deviation to two digits, "−90.13 ± 0.28 arcsec", or why there is
/// none: as written in pictures and reports.
std::string estimateText(SystemParameter parameter, const ParameterEstimate& estimate);

/// Errors of the scan angle over the scan angle, with their standard deviations. UsageError without
/// such a curve.
Canvas drawScanAngleCurve(const CalibrationResult& result, PictureSize size = {});

/// Estimated trajectory errors of each strip over time: position and angles.
/// UsageError without strip corrections.
Canvas drawStripErrors(const CalibrationResult& result, PictureSize size = {});

}  // namespace pcl_als
