// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <pcl_als/io/dataset_inventory.h>
#include <pcl_als/processing/trajectory_loading.h>
#include <pcl_als/survey/strip_assignment.h>

namespace pcl_als {

/// Which points of which files are listed, and how.
struct InventoryRequest {
  std::vector<std::filesystem::path> files;
  double cell = 0.0;  ///< metres, as for takeInventory()
  StripChoice strips;
  PointWindow window;
  /// Files of the trajectory; if empty, strips are divided by the points alone.
  std::vector<std::filesystem::path> trajectory;
  TrajectoryReading reading;  ///< with an empty crs: that of the points
  int threads = 0;            ///< 0: all cores
};

struct StripInventoryResult {
  DatasetInventory inventory;
  std::vector<ExcludedPoints> excluded;
  std::vector<std::string> notes;  ///< how strips were divided and times reconciled
};

/** \brief takeInventory() of files with their points arranged into strips with their trajectory, as
 * by the jobs that use one.
 *
 * Points that the trajectory does not cover are listed too. Where points or trajectory are unusable
 * or do not belong together, strips are those of the points alone, and a note gives the reason.
 */
StripInventoryResult takeInventory(const InventoryRequest& request,
                                   const std::function<void(double)>& progress = {});

}  // namespace pcl_als
