// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include "point_array.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <sstream>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/local_frame.h>

namespace pcl_als::python {
namespace {

namespace py = pybind11;

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr const char* kCapsule = "pcl_als cloud";
constexpr double kLargestStep = 0.001;  ///< metres, of coordinates as floats

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
    {"user_data", "u1", offsetof(PointLidar, user_data)},
};

/// The types of numbers of extra bytes, and those of numpy.
struct NumberType {
  LasExtraType type;
  const char* name;
};
constexpr NumberType kNumberTypes[] = {{LasExtraType::u8, "u1"},  {LasExtraType::i8, "i1"},
                                       {LasExtraType::u16, "u2"}, {LasExtraType::i16, "i2"},
                                       {LasExtraType::u32, "u4"}, {LasExtraType::i32, "i4"},
                                       {LasExtraType::u64, "u8"}, {LasExtraType::i64, "i8"},
                                       {LasExtraType::f32, "f4"}, {LasExtraType::f64, "f8"}};

/// Undocumented for other values than numbers.
LasExtraType typeOf(const py::dtype& dtype) {
  if (dtype.kind() == 'b') return LasExtraType::u8;
  if (dtype.kind() == 'f') return dtype.itemsize() <= 4 ? LasExtraType::f32 : LasExtraType::f64;
  const std::string name = dtype.kind() + std::to_string(dtype.itemsize());
  for (const NumberType& type : kNumberTypes)
    if (name == type.name) return type.type;
  return LasExtraType::undocumented;
}

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

Doubles fieldOf(const py::array& points, const char* name) {
  const Doubles values = Doubles::ensure(points[py::str(name)]);
  if (!values) throw py::error_already_set();
  if (values.ndim() != 1)
    throw UsageError(std::string("points: field ") + name + " is no column of numbers");
  return values;
}

/// Whether one of x, y and z has a finer type than the floats of a cloud.
bool isFine(const py::array& points) {
  const py::object fields = points.dtype().attr("fields");
  for (const char* axis : {"x", "y", "z"}) {
    const py::dtype type = fields[py::str(axis)].cast<py::tuple>()[0].cast<py::dtype>();
    if (type.kind() != 'f' || type.itemsize() > 4) return true;
  }
  return false;
}

/// The middle of the finite values.
double middleOf(const Doubles& values) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (py::ssize_t i = 0; i < values.size(); ++i) {
    const double value = values.data()[i];
    if (!std::isfinite(value)) continue;
    low = std::min(low, value), high = std::max(high, value);
  }
  return low > high ? 0.0 : 0.5 * (low + high);
}

double farthestOf(const Doubles& values) {
  double farthest = 0.0;
  for (py::ssize_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values.data()[i])) farthest = std::max(farthest, std::abs(values.data()[i]));
  return farthest;
}

/// Copies x, y and z as they are, or relative to an origin that is chosen.
void copyCoordinates(const py::array& points, bool choose_origin, StripWithColumns& strip) {
  const Doubles x = fieldOf(points, "x"), y = fieldOf(points, "y"), z = fieldOf(points, "z");
  const double farthest = std::max({farthestOf(x), farthestOf(y), farthestOf(z)});
  if (choose_origin && farthest > LocalFrame::kMaximumExtent)
    strip.frame = LocalFrame::around({middleOf(x), middleOf(y), middleOf(z)}, strip.frame.crs);
  const Eigen::Vector3d shift =
      choose_origin ? strip.frame.origin : Eigen::Vector3d(Eigen::Vector3d::Zero());
  for (std::size_t i = 0; i < strip.cloud->size(); ++i) {
    const Eigen::Vector3d point(x.data()[i], y.data()[i], z.data()[i]);
    (*strip.cloud)[i].getVector3fMap() = (point - shift).cast<float>();
  }
}

/// Fills the strip with a copy of the fields of an array.
void copyPoints(const py::array& points, bool has_origin, StripWithColumns& strip) {
  const py::list names(points.dtype().attr("names"));
  for (const char* needed : {"x", "y", "z"}) {
    if (!names.contains(needed))
      throw UsageError(std::string("points: the array has no field ") + needed);
  }
  strip.cloud = std::make_shared<Cloud>();
  strip.cloud->resize(static_cast<std::size_t>(points.size()));
  py::array copy = viewOf(strip.cloud);
  if (points.dtype().equal(pointType())) {
    copy[py::ellipsis()] = points;
    return;
  }
  copyCoordinates(points, !has_origin && isFine(points), strip);
  for (const py::handle& each : names) {
    const auto name = each.cast<std::string>();
    if (name == "x" || name == "y" || name == "z") continue;
    const bool known = std::any_of(std::begin(kFields), std::end(kFields),
                                   [&](const Field& field) { return name == field.name; });
    if (known)
      copy[each] = points[py::str(name)];
    else
      strip.columns.push_back(columnOf(name, points[py::str(name)], strip.cloud->size()));
  }
}

/// UsageError where coordinates are so far from the origin that floats round them to steps above
/// kLargestStep.
void requireFineSteps(const Cloud& cloud) {
  Eigen::Array3f farthest = Eigen::Array3f::Zero();
  for (const PointLidar& point : cloud) {
    if (point.getArray3fMap().isFinite().all())
      farthest = farthest.max(point.getArray3fMap().abs());
  }
  const double largest = static_cast<double>(farthest.maxCoeff());
  const double step = std::ldexp(1.0, std::ilogb(std::max(largest, 1.0)) - 23);
  if (step <= kLargestStep) return;
  std::ostringstream text;
  text << "points: coordinates reach " << std::llround(largest)
       << " m from the origin, where 32-bit floats have steps of " << step
       << " m; give map coordinates as 64-bit floats without an origin, and a strip that is longer "
          "than 30 km in parts";
  throw UsageError(text.str());
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

void setPoints(const py::array& points, const std::optional<Eigen::Vector3d>& origin,
               StripWithColumns& strip) {
  if (points.ndim() != 1 || points.dtype().attr("names").is_none())
    throw UsageError("points: not a structured array of one dimension");
  if (origin) strip.frame.origin = *origin;
  strip.cloud = wholeCloud(points);
  if (!strip.cloud) copyPoints(points, origin.has_value(), strip);
  requireFineSteps(*strip.cloud);
}

PointColumn columnOf(const std::string& name, const py::array& values, std::size_t points) {
  for (const Field& field : kFields) {
    if (name == field.name) throw UsageError("extra: '" + name + "' is a field of points");
  }
  PointColumn column;
  column.field.name = name;
  column.field.type = typeOf(values.dtype());
  if (column.field.type == LasExtraType::undocumented)
    throw UsageError("extra: the values of '" + name + "' are no numbers");
  column.field.size = lasExtraSize(column.field);
  if (values.ndim() != 1 || static_cast<std::size_t>(values.size()) != points)
    throw UsageError("extra: '" + name + "' needs " + std::to_string(points) +
                     " values in one dimension");
  const Doubles doubles = Doubles::ensure(values);
  if (!doubles) throw py::error_already_set();
  column.values.assign(doubles.data(), doubles.data() + doubles.size());
  return column;
}

py::array valuesOf(const PointColumn& column) {
  const LasExtraField& field = column.field;
  py::array values = Doubles(static_cast<py::ssize_t>(column.values.size()), column.values.data());
  if (field.scale == 1.0 && field.offset == 0.0) {
    for (const NumberType& type : kNumberTypes)
      if (type.type == field.type) values = values.attr("astype")(type.name);
  }
  values.attr("setflags")(py::arg("write") = false);
  return values;
}

}  // namespace pcl_als::python
