// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pcl/point_cloud.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <pcl_als/common/point_types.h>
#include <pcl_als/io/strip_loader.h>

namespace pcl_als::python {

using Cloud = pcl::PointCloud<PointLidar>;

/// The layout of PointLidar as a structured dtype of 48 bytes.
pybind11::dtype pointType();

/// The points of a cloud as a structured array on the memory of the cloud, without a copy. The base
/// of the array keeps the cloud alive.
pybind11::array viewOf(const std::shared_ptr<Cloud>& cloud);

/** \brief The points of a structured array, with its further fields as columns.
 *
 * The whole array of viewOf() gives its own cloud; of any other one the fields are copied. x, y and
 * z are relative to \a origin. Without an origin they are coordinates of the ground frame if they
 * are not 32-bit floats, and get a frame around their centre where they reach further than
 * LocalFrame::kMaximumExtent; otherwise the origin is zero.
 *
 * UsageError for an array that has more than one dimension, lacks x, y or z or has a field of
 * another kind than numbers, and for coordinates that 32-bit floats relative to the origin would
 * round to steps of more than 1 mm.
 */
void setPoints(const pybind11::array& points, const std::optional<Eigen::Vector3d>& origin,
               StripWithColumns& strip);

/// A column of values; the type in files is that of the array. UsageError for other values than
/// numbers, for another number of them than \a points, and for the name of a field of PointLidar.
PointColumn columnOf(const std::string& name, const pybind11::array& values, std::size_t points);

/// The values of a column in the type that they have in files, or as doubles where they are scaled:
/// a new array that cannot be written to.
pybind11::array valuesOf(const PointColumn& column);

}  // namespace pcl_als::python
