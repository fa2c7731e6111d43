// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <pcl_als/processing/file_batch.h>
#include <pcl_als/processing/file_correction.h>

namespace pcl_als {

/// What the correction of one of many files found.
struct CorrectedFile {
  std::uint64_t points = 0;
  std::string attitude_remark;            ///< as FileCorrectionResult
  std::string uncovered;                  ///< points that were left as they are; empty: none
  std::vector<std::string> copy_remarks;  ///< as FileCorrectionResult, also the next ones
  std::vector<std::string> remarks;
  bool kept = false;  ///< complete from an earlier run (BatchOptions::resume)
};

/** \brief Applies a calibration to many files by correctPointFile(), divided among processes.
 *
 * Each file is corrected by one process, so that the outputs do not depend on their number.
 * FileCorrectionOptions::deviation_cell is refused (UsageError): there is no raster of many files.
 */
std::vector<CorrectedFile> correctPointFiles(const std::vector<std::string>& inputs,
                                             const std::vector<std::string>& outputs,
                                             const CalibrationResult& calibration,
                                             const std::shared_ptr<const Trajectory>& flight,
                                             const FileCorrectionOptions& options = {},
                                             const BatchOptions& batch = {},
                                             const ProgressCallback& progress = {});

}  // namespace pcl_als
