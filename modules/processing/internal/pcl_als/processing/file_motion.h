// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/registration/rigid_motion.h>

namespace pcl_als {

struct MovedFile {
  std::uint64_t points = 0;
  /// What of the input was wrong, and what was copied besides (LasRewriteResult).
  std::vector<std::string> remarks;
};

/** \brief Writes a copy of a point file with moved points: .las and .laz on the raw integers,
 * everything else byte for byte, in constant memory; .pcd with all fields.
 *
 * UsageError for files of different kinds, InputError for a point beyond the range of the
 * coordinates of the file.
 */
MovedFile movePointFile(const std::filesystem::path& input, const std::filesystem::path& output,
                        const RigidMotion& motion, int threads);

/// UsageError where movePointFile() does not support the kinds of input and output.
void checkMovable(const std::filesystem::path& input, const std::filesystem::path& output);

}  // namespace pcl_als
