// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <pcl/point_cloud.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <pcl_als/common/point_types.h>

namespace pcl_als::python {

using Cloud = pcl::PointCloud<PointLidar>;

/// The layout of PointLidar as a structured dtype of 48 bytes.
pybind11::dtype pointType();

/// The points of a cloud as a structured array on the memory of the cloud, without a copy. The base
/// of the array keeps the cloud alive.
pybind11::array viewOf(const std::shared_ptr<Cloud>& cloud);

/// The cloud whose points an array of viewOf() is, unchanged in shape; otherwise a new cloud with a
/// copy of the fields that the array and PointLidar have in common. UsageError for an array that
/// has more than one dimension or lacks x, y or z.
std::shared_ptr<Cloud> cloudOf(const pybind11::array& points);

}  // namespace pcl_als::python
