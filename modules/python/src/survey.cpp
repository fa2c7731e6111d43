// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <map>
#include <optional>

#include <pybind11/eigen.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/excluded_points.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

std::optional<Rectangle> boundsOf(const PointWindow& window) {
  if (!window.bounds) return std::nullopt;
  const auto &low = window.bounds->min(), &high = window.bounds->max();
  return Rectangle{low.x(), low.y(), high.x(), high.y()};
}

void bindChoices(py::module_& m) {
  py::class_<PointWindow>(m, "PointWindow", "The part of point files that is read, and how.")
      .def(fromKeywords<PointWindow>())
      .def_property("bounds", &boundsOf, &setBounds,
                    "rectangle x_min, y_min, x_max, y_max in the ground frame, m; None: all points")
      .def_readwrite("resolution", &PointWindow::resolution,
                     "distance between points that suffices, m, of COPC files; 0: all points")
      .def_readwrite("keep_readable", &PointWindow::keep_readable,
                     "read what is intact of damaged LAS and LAZ files")
      .def_readwrite("channel_field", &PointWindow::channel_field,
                     "field with the channel of the scanner: 'user_data' or an extra field")
      .def_readwrite(
          "columns", &PointWindow::columns,
          "columns of .xyz files in their order, 'skip': not used; empty: by the header");
  py::class_<StripChoice>(m, "StripChoice",
                          "Choice of the strips that are used; a list of names does as well.")
      .def(fromKeywords<StripChoice>())
      .def(py::init([](const std::vector<std::string>& only) {
             StripChoice choice;
             choice.only = only;
             return choice;
           }),
           py::arg("only"))
      .def_readwrite("only", &StripChoice::only, "names of the strips that are used; empty: all")
      .def_readwrite("without", &StripChoice::without, "names of strips to exclude")
      .def_readwrite("split", &StripChoice::split,
                     "cut files without source ids into flight lines at gaps and turns")
      .def_readwrite("keep_timeless", &StripChoice::keep_timeless,
                     "keep points of GPS time 0 in files that have times")
      .def_readwrite("by_channel", &StripChoice::by_channel,
                     "the channels of the scanner are strips of their own: 3.ch0, 3.ch1");
  py::implicitly_convertible<py::sequence, StripChoice>();
}

void bindExcluded(py::module_& m) {
  Record<ExcludedPoints>(m, "LeftOutPoints", "Points of a strip that took no part, and why.")
      .field("strip", &ExcludedPoints::strip)
      .state(&ExcludedPoints::reason)
      .property(
          "reason", [](const ExcludedPoints& part) { return std::string(toString(part.reason)); },
          "'excluded', 'before_trajectory', 'too_few_points', ...")
      .field("points", &ExcludedPoints::points, "number of points that were excluded")
      .field("of", &ExcludedPoints::of, "points of the strip")
      .bind()
      .def("__str__", [](const ExcludedPoints& part) { return describe(part); });
  Record<SurveyArea>(m, "SurveyArea", "A square of ground in which strips are compared.")
      .field("minimum", &SurveyArea::minimum, "south-west corner, m, ground frame")
      .field("size", &SurveyArea::size, "side, m")
      .state(&SurveyArea::margin)
      .bind();
}

std::map<std::string, std::uint64_t> pointsByStrip(const Survey& survey) {
  std::map<std::string, std::uint64_t> points;
  const SurveyReader& reader = survey.reader;
  for (std::size_t i = 0; i < reader.strips().size(); ++i)
    points[reader.strips()[i]] = reader.pointsByStrip()[i];
  return points;
}

std::shared_ptr<Survey> openSurvey(const Files& files, const PointWindow& window, int threads) {
  return runJob({}, [&](const ProgressCallback&) {
    return std::make_shared<Survey>(files.texts(), window, threads);
  });
}

}  // namespace

void setBounds(PointWindow& window, const std::optional<Rectangle>& bounds) {
  window.bounds.reset();
  if (!bounds) return;
  const auto [west, south, east, north] = *bounds;
  // The negation also refuses NaN.
  if (!(west <= east && south <= north)) throw UsageError("bounds: not x_min, y_min, x_max, y_max");
  window.bounds.emplace(Eigen::Vector2d(west, south), Eigen::Vector2d(east, north));
}

void bindSurvey(py::module_& m) {
  bindChoices(m);
  bindExcluded(m);
  py::class_<Survey, std::shared_ptr<Survey>>(
      m, "Survey",
      "The points of a survey as strips, from files (.las, .laz, .pcd) that jobs read when they "
      "need them, in constant memory. One survey serves several jobs, one at a time.")
      .def(py::init(&openSurvey), py::arg("files"), py::kw_only(),
           py::arg_v("window", PointWindow(), "PointWindow()"), py::arg("threads") = 0,
           "Reads all files once (ids, times, extents). threads: 0: all cores; results do not "
           "depend on it. InputError for a file that cannot be read or does not belong to the "
           "others.")
      .def_property_readonly(
          "strips", [](const Survey& survey) { return survey.reader.strips(); },
          "names of the strips; after a job those that it used")
      .def_property_readonly("points_by_strip", &pointsByStrip, "number of points of each strip")
      .def_property_readonly(
          "crs", [](const Survey& survey) { return survey.reader.reference().crs; },
          "common coordinate reference system of the files (WKT or 'EPSG:...'); may be empty")
      .def_property_readonly(
          "remarks", [](const Survey& survey) { return survey.reader.reference().remarks; },
          "conversions of units, and assumptions")
      .def_property_readonly(
          "extent",
          [](const Survey& survey) {
            const Eigen::Vector2d low = survey.reader.corner(), high = survey.reader.farCorner();
            return Rectangle{low.x(), low.y(), high.x(), high.y()};
          },
          "x_min, y_min, x_max, y_max of all points, m, ground frame")
      .def("__len__", [](const Survey& survey) { return survey.reader.pointCount(); })
      .def(py::pickle(
          [](const Survey& survey) { return py::make_tuple(survey.paths, survey.window); },
          [](const py::tuple& state) {
            return openSurvey({state[0].cast<Paths>()}, state[1].cast<PointWindow>(), 0);
          }));
}

}  // namespace pcl_als::python
