// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <pcl_als/las/las_rewriter.h>
#include <pcl_als/processing/intensity_run.h>

namespace pcl_als {

inline constexpr double kLargestIntensity = 65535.0;  ///< that a LAS record can hold

/// Content of the output besides corrected intensities.
struct IntensityOutput {
  double scale = 1.0;         ///< on corrected intensities in the 16-bit field
  bool keep_original = true;  ///< as extra field original_intensity
  bool extra_fields = true;   ///< range, incidence_angle, and reflectance where it is known
};

/// Statistics of the output, for the report.
struct IntensityOutcome {
  explicit IntensityOutcome(std::size_t strips) : statistics(strips), histograms(strips) {}
  std::vector<IntensityCounts> counts;  ///< by file
  /// Of the files: what was wrong, and what was copied besides (LasRewriteResult); with their
  /// names.
  std::vector<std::string> remarks;
  IntensityStatistics statistics;
  std::vector<IntensityHistogram> histograms;
  /// Called with every point, one at a time; may be empty.
  std::function<void(int strip, const Eigen::Vector3d& place)> seen;

  void addRemarks(const std::filesystem::path& path, const std::vector<std::string>& written);
};

/** \brief Writes a file of the job with corrected intensities.
 *
 * LAS: all other fields are kept; extra bytes are appended. PCD: the same as fields. InputError
 * where points have no trajectory (unless they may stay unchanged) or most are above the sensor;
 * the output appears only when it is complete.
 */
void writeCorrected(const IntensityRun& run, std::size_t file, const std::filesystem::path& path,
                    const IntensityOutput& output, const std::function<void(double)>& progress,
                    IntensityOutcome& outcome);

}  // namespace pcl_als
