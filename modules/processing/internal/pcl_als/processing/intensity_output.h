// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>

#include <pcl_als/processing/intensity_job.h>

namespace pcl_als {

class IntensityRun;

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
