// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_als::fuzz {

/** \brief A reader that is given arbitrary bytes, with inputs to begin from.
 *
 * run() reads the bytes as a file of that kind; a pcl_als::Error is a right answer, anything else
 * (another exception, a crash, a sanitizer's report) is a bug.
 */
struct Target {
  const char* name;
  bool (*run)(const std::uint8_t* data, std::size_t size);  ///< false: refused by an Error
  std::vector<std::string> (*seeds)();
};

/// las, laz, damaged_laz, copc, pcd, trajectory_csv, sbet, control, calibration; geojson, class_sites,
/// confusion_matrix, checked_sites, class_model, geotiff
const std::vector<Target>& targets();
const Target& targetNamed(const std::string& name);

}  // namespace pcl_als::fuzz
