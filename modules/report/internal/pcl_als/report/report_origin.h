// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als {

/// Provenance of a report, and its destination.
struct ReportOrigin {
  std::filesystem::path folder;     ///< folder of the report
  std::string program;              ///< "pcl_als_check 0.2.0"
  std::vector<std::string> inputs;  ///< files besides the points: trajectory, control, …
  std::vector<std::pair<std::string, std::string>> settings;  ///< names and values
  std::vector<ControlPoint> control;                          ///< for the map; may be empty
  std::string title;                                          ///< empty: by the content

  std::string titleOr(const std::string& usual) const { return title.empty() ? usual : title; }
};

}  // namespace pcl_als
