// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <string>
#include <vector>

#include <pcl_als/common/survey_types.h>

namespace pcl_als::detail {

/// Throws InputError for a time or position that is not finite.
void refuseUnusable(const std::vector<TrajectorySample>& samples);

/// Sorts samples by time and merges those of equal time; adds a line to \a repairs for each kind of
/// repair. Throws InputError for samples of one time more than 1 m apart, or fewer than two
/// distinct times.
void sortAndMerge(std::vector<TrajectorySample>& samples, std::vector<std::string>& repairs);

/// The threshold to use: itself when positive, else max(1 s, 5 median steps) of the sorted samples.
double gapThreshold(const std::vector<TrajectorySample>& samples, double requested);
/// max(1 s, 5 median steps)
double gapThreshold(std::vector<double> steps);

/// Drops samples with a gap (or an end) on both sides: no line goes through one sample.
void dropIsolated(std::vector<TrajectorySample>& samples, double gap_threshold,
                  std::vector<std::string>& repairs);

}  // namespace pcl_als::detail
