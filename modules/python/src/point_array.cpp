// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "point_array.h"

#include <cstddef>
#include <cstring>

#include <pcl_als/common/errors.h>

namespace pcl_als::python {
namespace {

namespace py = pybind11;

constexpr const char* kCapsule = "pcl_als cloud";

struct Field {
  const char* name;
  const char* format;
  std::size_t offset;
};
constexpr Field kFields[] = {
    {"x", "<f4", offsetof(PointLidar, x)},
    {"y", "<f4", offsetof(PointLidar, y)},
    {"z", "<f4", offsetof(PointLidar, z)},
    {"gps_time", "<f8", offsetof(PointLidar, gps_time)},
    {"intensity", "<f4", offsetof(PointLidar, intensity)},
    {"scan_angle", "<f4", offsetof(PointLidar, scan_angle)},
    {"point_source_id", "<u2", offsetof(PointLidar, point_source_id)},
    {"return_number", "u1", offsetof(PointLidar, return_number)},
    {"number_of_returns", "u1", offsetof(PointLidar, number_of_returns)},
    {"classification", "u1", offsetof(PointLidar, classification)},
    {"flags", "u1", offsetof(PointLidar, flags)},
};

/// The cloud that an array is a view of, as a whole; null where it is not.
std::shared_ptr<Cloud> wholeCloud(const py::array& points) {
  py::object base = points.base();
  while (base && py::isinstance<py::array>(base)) base = py::object(base.cast<py::array>().base());
  if (!base || !PyCapsule_IsValid(base.ptr(), kCapsule)) return nullptr;
  auto cloud = *static_cast<std::shared_ptr<Cloud>*>(PyCapsule_GetPointer(base.ptr(), kCapsule));
  const bool whole = points.data() == static_cast<const void*>(cloud->data()) &&
                     static_cast<std::size_t>(points.size()) == cloud->size() &&
                     points.strides(0) == static_cast<py::ssize_t>(sizeof(PointLidar)) &&
                     points.dtype().equal(pointType());
  return whole ? cloud : nullptr;
}

}  // namespace

py::dtype pointType() {
  py::list names, formats, offsets;
  for (const Field& field : kFields) {
    names.append(field.name);
    formats.append(field.format);
    offsets.append(field.offset);
  }
  return {names, formats, offsets, static_cast<py::ssize_t>(sizeof(PointLidar))};
}

py::array viewOf(const std::shared_ptr<Cloud>& cloud) {
  auto* kept = new std::shared_ptr<Cloud>(cloud);
  const py::capsule base(kept, kCapsule, [](PyObject* capsule) {
    delete static_cast<std::shared_ptr<Cloud>*>(PyCapsule_GetPointer(capsule, kCapsule));
  });
  return py::array(pointType(), {cloud->size()}, {sizeof(PointLidar)}, cloud->data(), base);
}

std::shared_ptr<Cloud> cloudOf(const py::array& points) {
  if (points.ndim() != 1 || points.dtype().attr("names").is_none())
    throw UsageError("points: not a structured array of one dimension");
  if (std::shared_ptr<Cloud> cloud = wholeCloud(points)) return cloud;
  const py::list names(points.dtype().attr("names"));
  for (const char* needed : {"x", "y", "z"}) {
    if (!names.contains(needed))
      throw UsageError(std::string("points: the array has no field ") + needed);
  }
  auto cloud = std::make_shared<Cloud>();
  cloud->resize(static_cast<std::size_t>(points.size()));
  py::array copy = viewOf(cloud);
  if (points.dtype().equal(pointType())) {
    copy[py::ellipsis()] = points;
    return cloud;
  }
  for (const Field& field : kFields) {
    if (names.contains(field.name)) copy[py::str(field.name)] = points[py::str(field.name)];
  }
  return cloud;
}

}  // namespace pcl_als::python
