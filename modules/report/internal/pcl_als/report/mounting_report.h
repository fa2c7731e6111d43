// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/trajectory/mounting_correction.h>

namespace pcl_als {

class FieldTable;

/// What is known of the mounting with which the points of a calibration were computed.
struct MountingInput {
  MountingConvention convention;
  Eigen::Vector3d angles = Eigen::Vector3d::Zero();  ///< in the unit and order of the convention
  std::optional<Eigen::Vector3d> lever_arm;          ///< metres; none: not known
  std::string system;     ///< of a calibration with several; empty: it has one
  double range = 1000.0;  ///< metres, at which differences of angles are stated
};

/// The content of mounting.json: the mounting to be typed into a program.
struct MountingReport {
  MountingInput input;
  MountingCorrection correction;
  std::vector<ParameterEstimate> parameters;  ///< indexed by SystemParameter
  double range_correction = 0.0;              ///< metres, to be added to measured ranges
  double scan_angle_factor = 1.0;             ///< by which measured scan angles are multiplied
  std::string calibration;                    ///< its file
  std::vector<std::string> remarks;
};

/// Composes the mounting with the corrections of a calibration. UsageError for a system that the
/// calibration does not have or, where it has several, for none (the names are listed), and for
/// values that are refused by correctedMounting().
MountingReport reportMounting(const CalibrationResult& calibration, const std::string& file,
                              const MountingInput& input);

/// The tables that the tool prints.
std::string mountingText(const MountingReport& report);
/// One line for each documented convention.
std::string conventionsText();
/// The text of mounting.json, and its description.
std::string mountingJson(const MountingReport& report);
const FieldTable& mountingReportFields();

}  // namespace pcl_als
