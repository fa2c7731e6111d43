// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/common/system_parameters.h>

namespace pcl_als {

// Texts of system parameters and their values, which are given in internal units (m, rad, 1) unless
// stated otherwise and shown in interface units (m, arcsec, 1).

/// "lever arm x"
std::string plainName(SystemParameter parameter);

/// "m" or "arcsec"; empty for a parameter without unit.
std::string unitText(SystemParameter parameter);
/// The same behind a value: " arcsec".
std::string unitSuffix(SystemParameter parameter);

/// Decimals in tables of fixed width: 0.1 mm, 0.01 arcsec, 1e-7.
int tableDecimals(SystemParameter parameter);
/// Decimals that show two significant digits of a standard deviation in the unit that it is given
/// in; those of 1e-6 where it is unknown.
int decimalsOfStd(double std);

/// Three significant digits, without the unit: "12.3".
std::string shortValue(SystemParameter parameter, double value);
/// The same with the unit: "12.3 arcsec".
std::string inUnit(SystemParameter parameter, double value);

/// A value with its standard deviation to two digits: "−90.13 ± 0.28 arcsec".
std::string valueText(SystemParameter parameter, double value, double std);
/// The same of an estimate, or why there is none: as written in pictures and reports.
std::string estimateText(SystemParameter parameter, const ParameterEstimate& estimate);

}  // namespace pcl_als
