// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/excluded_points.h>
#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/io/trajectory_io.h>
#include <pcl_als/processing/flight_assessment.h>

namespace pcl_als {

class FieldTable;

/// The inventory as text. \param excluded points that belong to none of its strips
std::string inventoryText(const DatasetInventory& survey,
                          const std::vector<ExcludedPoints>& excluded);

/// Files of a flight that are listed beside the points.
struct ListedTrajectory {
  std::vector<std::pair<std::string, TrajectoryFacts>> trajectories;  ///< path and facts
  std::string accuracy_path;
  std::vector<TrajectoryAccuracy> accuracy;  ///< empty: no file of accuracies
  FlightAssessment assessment;               ///< of points and trajectory together; may be empty
};

/// The inventory as JSON, and the table of its fields.
const FieldTable& inventoryFields();
std::string inventoryJson(const DatasetInventory& survey,
                          const std::vector<ExcludedPoints>& excluded,
                          const ListedTrajectory& flight = {});

/// The facts of trajectory files as text: format, frame and datum, times, attitude against the
/// course, standard deviations.
std::string flightText(const ListedTrajectory& flight);
/// What the trajectory and the points show together: scanners, and what does not agree.
std::string assessmentText(const FlightAssessment& assessment);

std::string timeKindName(TimeKind kind);

}  // namespace pcl_als
