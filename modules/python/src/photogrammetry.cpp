// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/io/image_block_io.h>
#include <pcl_als/processing/line_extraction.h>
#if PCL_ALS_WITH_CERES
#include <pcl_als/processing/image_orientation.h>
#include <pcl_als/report/orientation_report.h>
#endif

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "record.h"
#include "words.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

constexpr Word<ObjectLine::Kind> kKinds[] = {{"ridge", ObjectLine::Kind::ridge},
                                             {"valley", ObjectLine::Kind::valley},
                                             {"eave", ObjectLine::Kind::eave},
                                             {"unknown", ObjectLine::Kind::unknown}};

void bindLines(py::module_& m) {
  Record<ObjectLine>(m, "RoofLine", "A straight line of a roof, ground frame.")
      .field("id", &ObjectLine::id)
      .state(&ObjectLine::kind)
      .property(
          "kind", [](const ObjectLine& l) { return nameOf(kKinds, l.kind); },
          "'ridge', 'valley', 'eave' or 'unknown'")
      .field("start", &ObjectLine::start, "m")
      .field("end", &ObjectLine::end, "m")
      .field("covariance", &ObjectLine::covariance,
             "of the offsets of start to the left and upwards, then of end; m^2")
      .field("strips", &ObjectLine::strips, "in which it was seen")
      .bind();
  py::class_<RoofLineSettings>(m, "RoofLineSettings", "Settings of the extraction of roof lines.")
      .def(fromKeywords<RoofLineSettings>())
      .def_readwrite("noise", &RoofLineSettings::noise, "of points about planes, m; 0: estimated")
      .def_readwrite("least_area", &RoofLineSettings::least_area, "of a face, m^2")
      .def_readwrite("least_angle", &RoofLineSettings::least_angle,
                     "between the faces of a line, rad")
      .def_readwrite("least_length", &RoofLineSettings::least_length, "m")
      .def_readwrite("eaves", &RoofLineSettings::eaves, "also the lower edges of faces")
      .def_readwrite("threads", &RoofLineSettings::threads);
  m.def(
      "extract_lines",
      [](const Files& files, const RoofLineSettings& settings, const StripChoice& strips,
         const std::optional<std::filesystem::path>& output, const PythonProgress& progress) {
        LineExtractionOptions options;
        options.settings = settings, options.strips = strips;
        return runJob(progress, [&](const ProgressCallback& report) {
          const ExtractedLines found = extractLines(files.paths, options, report);
          if (output) writeLines(*output, found.lines, found.crs);
          return found.lines;
        });
      },
      py::arg("files"), py::kw_only(),
      py::arg_v("settings", RoofLineSettings(), "RoofLineSettings()"),
      py::arg_v("strips", StripChoice(), "StripChoice()"), py::arg("output") = py::none(),
      py::arg("progress") = py::none(),
      "Finds roof lines in the strips of files and combines them, as pcl_als_lines does. output: "
      ".csv or .geojson to write as well.");
}

#if PCL_ALS_WITH_CERES
/// What an orientation found.
struct Orientation {
  bool reliable = false;
  std::string reason, json, text;
  double sigma0 = 0.0;
};

std::shared_ptr<Orientation> resultOf(const ImageOrientationResult& result) {
  auto orientation = std::make_shared<Orientation>();
  orientation->reliable = result.bundle.reliable(), orientation->reason = result.bundle.message;
  orientation->sigma0 = result.bundle.sigma0;
  orientation->json = orientationJson(result), orientation->text = orientationText(result);
  return orientation;
}

void bindOrientation(py::module_& m) {
  Record<Orientation>(m, "Orientation", "The result of orient().")
      .field("reliable", &Orientation::reliable)
      .field("reason", &Orientation::reason)
      .field("sigma0", &Orientation::sigma0)
      .state(&Orientation::json)
      .state(&Orientation::text)
      .bind()
      .def(
          "to_dict", [](const Orientation& o) { return parsedJson(o.json); },
          "The content of orientation.json as dictionaries and lists.")
      .def("__str__", [](const Orientation& o) { return o.text; });
  m.def(
      "orient",
      [](const std::filesystem::path& images, const std::filesystem::path& lines,
         const std::filesystem::path& camera,
         const std::optional<std::filesystem::path>& measurements,
         const std::optional<std::filesystem::path>& checkpoints, double assign_distance,
         double image_sigma, const PythonProgress& progress) {
        ImageBlockFiles files;
        files.images = images, files.lines = lines, files.camera = camera;
        files.measurements = measurements.value_or(ImageBlockFiles::besideImages(images));
        files.check_points = checkpoints;
        ImageOrientationOptions options;
        options.assign_distance = assign_distance, options.image_sigma = image_sigma;
        return runJob(progress, [&](const ProgressCallback& report) {
          return resultOf(orientImages(files, options, report));
        });
      },
      py::arg("images"), py::arg("lines"), py::arg("camera"), py::kw_only(),
      py::arg("measurements") = py::none(), py::arg("checkpoints") = py::none(),
      py::arg("assign_distance") = 0.0, py::arg("image_sigma") = 0.5,
      py::arg("progress") = py::none(),
      "Orients an image block by a bundle adjustment with roof lines as control, as pcl_als_orient "
      "does; measurements: default measurements.csv beside the images; assign_distance: lines of "
      "other names are assigned by position up to this distance, m; image_sigma: standard "
      "deviation of image coordinates without one, their unit.");
}
#endif

}  // namespace

void bindPhotogrammetry(py::module_& m) {
  bindLines(m);
#if PCL_ALS_WITH_CERES
  bindOrientation(m);
#endif
}

}  // namespace pcl_als::python
