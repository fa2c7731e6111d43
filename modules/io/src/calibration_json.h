// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/io/parameter_fields.h>

namespace pcl_als::detail {

inline constexpr const char* kCalibrationFormat = "pcl_als calibration";
/// Version 1 had no parts: all keys were those of one object.
inline constexpr int kCalibrationVersion = 2;

// The three parts of a calibration.json. Angles are in arc-seconds there.
const Fields<CalibrationResult>& instrumentFields();
const Fields<CalibrationResult>& flightFields();
const Fields<CalibrationResult>& reportFields();

/// Reads a calibration.json that was parsed.
CalibrationResult calibrationIn(const FieldNode& root, const std::string& name);

/// Reads the instrument part of a calibration.json or of another file that has one.
CalibrationResult instrumentIn(const FieldNode& part);

/// "prior", with its differences to the flight, and "held".
Field<CalibrationResult> priorField();
Field<CalibrationResult> heldField();
/// Names of system parameters; \a access returns a reference to a vector of them.
std::vector<SystemParameter> parametersNamed(const FieldNode& names);
const FieldNames<SystemParameter>& parameterNames();
const FieldNames<AttitudeSource>& attitudeNames();

}  // namespace pcl_als::detail
