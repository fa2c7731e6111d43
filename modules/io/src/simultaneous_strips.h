// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <pcl_als/common/time_alignment.h>

namespace pcl_als::detail {

/** \brief For every strip another one that was recorded at the same times, if any.
 *
 * A strip is recorded with others where at least half of its seconds with points are those of other
 * strips; the strip with most of these seconds is returned. Strips of less than
 * two seconds and GPS times of zero are ignored.
 *
 * \param times ranges with points of each strip, seconds
 */
std::vector<std::optional<std::size_t>> simultaneousStrips(
    const std::vector<std::vector<TimeRange>>& times);

}  // namespace pcl_als::detail
