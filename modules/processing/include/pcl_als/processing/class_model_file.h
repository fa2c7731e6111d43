// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <pcl_als/classification/gaussian_classifier.h>

namespace pcl_als {

/// Writes the statistics of classes as JSON: the bands, and the name, prior, samples, shrinkage,
/// mean and covariance of each class. readClassModel() reads back the same numbers. InputError if
/// the file cannot be written.
void writeClassModel(const std::filesystem::path& path, const GaussianModel& model,
                     const std::vector<std::string>& remarks);
/// Reads such a file. InputError names the file and the fault.
GaussianModel readClassModel(const std::filesystem::path& path);

}  // namespace pcl_als
