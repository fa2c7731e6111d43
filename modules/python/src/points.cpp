// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <optional>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/local_frame.h>

#include "arguments.h"
#include "bindings.h"
#include "point_array.h"

namespace pcl_als::python {
namespace {

/// A mapping with types of its keys and values, for signatures.
class ExtraFields : public pybind11::object {
  PYBIND11_OBJECT(ExtraFields, object, isMapping)

  static bool isMapping(PyObject* object) {
    return PyMapping_Check(object) != 0 && PyObject_HasAttrString(object, "items") != 0;
  }
};

}  // namespace
}  // namespace pcl_als::python

template <>
struct pybind11::detail::handle_type_name<pcl_als::python::ExtraFields> {
  static constexpr auto name = const_name("Mapping[str, numpy.ndarray]");
};

namespace pcl_als::python {
namespace {

namespace py = pybind11;

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

LidarStrip makeStrip(const py::array& points, const std::string& id,
                     const std::optional<Eigen::Vector3d>& origin, const std::string& crs) {
  LidarStrip strip;
  strip.id = id;
  strip.frame.crs = crs;
  setPoints(points, origin, strip);
  return strip;
}

ExtraFields extraOf(const LidarStrip& strip) {
  py::dict fields;
  for (const PointColumn& column : strip.columns)
    fields[py::str(column.field.name)] = valuesOf(column);
  return py::module_::import("types").attr("MappingProxyType")(fields);
}

/// A field of a type that the strip has already keeps its description, and its steps in files.
void setExtra(LidarStrip& strip, const ExtraFields& fields) {
  std::vector<PointColumn> columns;
  const py::object asarray = py::module_::import("numpy").attr("asarray");
  for (const py::handle& item : py::list(fields.attr("items")())) {
    const auto [key, values] = item.cast<std::pair<py::object, py::object>>();
    if (!py::isinstance<py::str>(key)) throw py::type_error("extra: names must be str");
    const py::array array = asarray(values);
    PointColumn column = columnOf(key.cast<std::string>(), array, strip.cloud->size());
    for (const PointColumn& before : strip.columns)
      if (before.field.name == column.field.name && valuesOf(before).dtype().equal(array.dtype()))
        column.field = before.field;
    columns.push_back(std::move(column));
  }
  strip.columns = std::move(columns);
}

py::tuple stateOf(const LidarStrip& strip) {
  py::list columns;
  for (const PointColumn& column : strip.columns) {
    const LasExtraField& field = column.field;
    columns.append(py::make_tuple(field.name, field.description, static_cast<int>(field.type),
                                  field.scale, field.offset, py::cast(column.values)));
  }
  return py::make_tuple(viewOf(strip.cloud), strip.id, Eigen::Vector3d(strip.frame.origin),
                        strip.frame.crs, columns);
}

LidarStrip stripOf(const py::tuple& state) {
  LidarStrip strip = makeStrip(state[0], state[1].cast<std::string>(),
                               state[2].cast<Eigen::Vector3d>(), state[3].cast<std::string>());
  for (const py::handle& each : state[4]) {
    const auto values = each.cast<py::tuple>();
    PointColumn column;
    column.field.name = values[0].cast<std::string>();
    column.field.description = values[1].cast<std::string>();
    column.field.type = static_cast<LasExtraType>(values[2].cast<int>());
    column.field.scale = values[3].cast<double>(), column.field.offset = values[4].cast<double>();
    column.field.size = lasExtraSize(column.field);
    column.values = values[5].cast<std::vector<double>>();
    strip.columns.push_back(std::move(column));
  }
  return strip;
}

std::string describe(const LidarStrip& strip) {
  std::string fields;
  for (const PointColumn& column : strip.columns)
    fields += (fields.empty() ? " with " : ", ") + column.field.name;
  return "<pcl_als.Strip '" + strip.id + "' of " + std::to_string(strip.cloud->size()) + " points" +
         fields + ">";
}

void bindStrip(py::module_& m) {
  py::class_<LidarStrip, std::shared_ptr<LidarStrip>>(
      m, "Strip",
      "One flight line in memory. Points are a structured array of dtype POINT (48 bytes): x, y, z "
      "in metres relative to origin (float32), gps_time in s, intensity as digital number, "
      "scan_angle in degrees, point_source_id, return_number, number_of_returns, classification "
      "(ASPRS code), flags (bits: synthetic, key point, withheld, overlap; scanner channel), "
      "user_data.")
      .def(py::init(&makeStrip), py::arg("points"), py::arg("id") = "1",
           py::arg("origin") = py::none(), py::arg("crs") = "",
           "A strip of a structured array. An array of empty_points() or of Strip.points, as a "
           "whole, is used without a copy; any other array is copied by the names of its fields, "
           "of which x, y and z (metres) are needed; fields that POINT lacks become extra. x, y "
           "and z are relative to origin. Without an origin, coordinates that are not float32 are "
           "those of the ground frame, and where they reach further than 4 km the origin is the "
           "multiple of 10 m at the middle of the strip; else it is zero. UsageError for an array "
           "without x, y and z, and where float32 would round them by more than 1 mm.")
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
      .def_property(
          "extra", &extraOf, &setExtra,
          "Further fields of the points by name: red, green, blue, nir (16 bits) and extra "
          "bytes. They are read with read_strips(..., extra=True) and written by "
          "write_points(). New arrays that cannot be written to; to change fields, assign "
          "a new mapping.")
      .def("ground", &groundOf,
           "Coordinates in the ground frame (easting, northing, height; m): a new array, n x 3.")
      .def("__len__", [](const LidarStrip& strip) { return strip.cloud->size(); })
      .def("__repr__", &describe)
      .def(py::pickle(&stateOf, &stripOf));
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
  bindStrip(m);
}

}  // namespace pcl_als::python
