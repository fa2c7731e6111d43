// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/local_frame.h>
#include <pcl_als/common/strip.h>

#include "bindings.h"
#include "point_array.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using LidarStrip = Strip<PointLidar>;

/// Coordinates in the ground frame, n x 3.
py::array_t<double> groundOf(const LidarStrip& strip) {
  py::array_t<double> ground({static_cast<py::ssize_t>(strip.cloud->size()), py::ssize_t{3}});
  double* out = ground.mutable_data();
  const py::gil_scoped_release released;
  for (const PointLidar& point : *strip.cloud) {
    Eigen::Map<Eigen::Vector3d> row(out);
    row = strip.frame.toGround(point.getVector3fMap());
    out += 3;
  }
  return ground;
}

LidarStrip makeStrip(const py::array& points, const std::string& id, const Eigen::Vector3d& origin,
                     const std::string& crs) {
  LidarStrip strip;
  strip.id = id;
  strip.frame.origin = origin;
  strip.frame.crs = crs;
  strip.cloud = cloudOf(points);
  return strip;
}

}  // namespace

void bindPoints(py::module_& m) {
  m.attr("POINT") = pointType();
  m.def(
      "empty_points",
      [](std::size_t count) {
        auto cloud = std::make_shared<Cloud>();
        cloud->resize(count);
        return viewOf(cloud);
      },
      py::arg("count"),
      "An array of that many points of dtype POINT, all at the origin, to be filled. A Strip takes "
      "it as it is, without a copy.");
  m.def(
      "local_origin",
      [](const Eigen::Vector3d& ground) { return LocalFrame::around(ground).origin; },
      py::arg("ground"),
      "An origin for the floats of a Strip around a ground point (m): multiples of 10 m, which PCD "
      "files keep exactly.");
  py::class_<LidarStrip, std::shared_ptr<LidarStrip>>(
      m, "Strip",
      "One flight line in memory. Points are a structured array of dtype POINT (48 bytes): x, y, z "
      "in metres relative to origin (float32), gps_time in s, intensity as digital number, "
      "scan_angle in degrees, point_source_id, return_number, number_of_returns, classification "
      "(ASPRS code), flags (bits: synthetic, key point, withheld, overlap; scanner channel).")
      .def(py::init(&makeStrip), py::arg("points"), py::arg("id") = "1",
           py::arg("origin") = Eigen::Vector3d(Eigen::Vector3d::Zero()), py::arg("crs") = "",
           "A strip of a structured array. An array of empty_points() or of Strip.points, as a "
           "whole, is used without a copy; any other array is copied by the names of its fields, "
           "of which x, y and z (metres relative to origin) are needed. UsageError for an array "
           "without them.")
      .def_readwrite("id", &LidarStrip::id, "name in pairs and results")
      .def_property_readonly(
          "points", [](const LidarStrip& strip) { return viewOf(strip.cloud); },
          "The points as an array of dtype POINT on the memory of the strip, without a copy: "
          "changes of the array change the strip. It stays valid without the strip.")
      .def_property(
          "origin", [](const LidarStrip& strip) { return Eigen::Vector3d(strip.frame.origin); },
          [](LidarStrip& strip, const Eigen::Vector3d& origin) { strip.frame.origin = origin; },
          "origin of the coordinates: easting, northing, height in the ground frame, m")
      .def_property(
          "crs", [](const LidarStrip& strip) { return strip.frame.crs; },
          [](LidarStrip& strip, const std::string& crs) { strip.frame.crs = crs; },
          "coordinate reference system: WKT or 'EPSG:...'; empty when unknown")
      .def("ground", &groundOf,
           "Coordinates in the ground frame (easting, northing, height; m): a new array, n x 3.")
      .def("__len__", [](const LidarStrip& strip) { return strip.cloud->size(); })
      .def("__repr__", [](const LidarStrip& strip) {
        return "<pcl_als.Strip '" + strip.id + "' of " + std::to_string(strip.cloud->size()) +
               " points>";
      });
}

}  // namespace pcl_als::python
