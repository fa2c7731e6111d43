// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>

#include <pcl_als/common/errors.h>
#include <pcl_als/io/applied_correction.h>

namespace pcl_als::detail {

/** \brief The record of corrections of an output: that of its input with one more correction.
 *
 * Removing and applying the same biases one after the other leaves neither in the record.
 * InputError where the same correction is recorded already, because it would be made twice; with
 * \a force a warning. An earlier correction of another kind or with other values is a warning
 * where both change the same property of the points.
 *
 * \param record of the input (PointFileInfo::corrections)
 * \param file for messages
 */
std::string recordWith(const std::string& record, const AppliedCorrection& correction,
                       const std::string& file, bool force, Warnings& warnings);

/// Whether all points of a file are of strips that the calibration held fixed, so that it changes
/// none. The file is read only if there are such strips.
bool isFixedSurface(const std::filesystem::path& file, const CalibrationResult& calibration);

}  // namespace pcl_als::detail
