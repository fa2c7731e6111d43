// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/calibration_result.h>

namespace pcl_als {

class FieldTable;
template <typename S>
class Fields;

/// The text of a calibration.json, as writeCalibration() writes it. UsageError for a bias that is
/// not finite.
std::string calibrationJson(const CalibrationResult& result);

/// Reads such a text back, as readCalibration() does. InputError names \a name and what is wrong.
CalibrationResult parseCalibration(const std::string& text, const std::string& name);

/// The description of calibration.json.
const FieldTable& calibrationFields();
/// The description of its part "instrument", which history.json has as well.
const Fields<CalibrationResult>& calibrationInstrumentFields();
/// The description of the entries of "left_out" in result files.
const Fields<ExcludedPoints>& excludedFields();

}  // namespace pcl_als
