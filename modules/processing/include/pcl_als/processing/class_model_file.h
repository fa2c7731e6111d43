// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/classification/gaussian_classifier.h>

namespace pcl_als {

/// Writes and reads the statistics of classes: bands, and per class name, prior, samples,
/// shrinkage, mean and covariance. Numbers keep all their digits.
void writeClassModel(const std::filesystem::path& path, const GaussianModel& model,
                     const std::vector<std::string>& remarks);
/// InputError naming the file and what is wrong with it.
GaussianModel readClassModel(const std::filesystem::path& path);

}  // namespace pcl_als
