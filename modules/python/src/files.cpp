// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <vector>

#include <pcl_als/io/pcd_io.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/processing/point_conversion.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"

namespace pcl_als::python {
namespace py = pybind11;

void bindFiles(py::module_& m) {
  m.def(
      "read_strips",
      [](const std::vector<std::filesystem::path>& files) {
        std::vector<std::shared_ptr<LidarStrip>> strips;
        runInThread({}, [&](const ProgressCallback&) {
          for (LidarStrip& strip : loadStrips(files))
            strips.push_back(std::make_shared<LidarStrip>(std::move(strip)));
        });
        return strips;
      },
      py::arg("files"),
      "Reads .las, .laz and .pcd files whole, as strips: 48 bytes a point. A strip that reaches "
      "further than 4 km from its centre comes in parts of the same id. InputError for files that "
      "cannot be read or that do not belong together.");
  m.def(
      "write_pcd",
      [](const std::filesystem::path& path, const LidarStrip& strip) {
        const py::gil_scoped_release released;
        savePcd(path, strip);
      },
      py::arg("path"), py::arg("strip"),
      "Writes a strip as a binary PCD with every field; the file appears when it is complete.");
  py::class_<PointConversionResult::Output>(m, "ConvertedFile", "A file of convert().")
      .def_readonly("path", &PointConversionResult::Output::path)
      .def_readonly("points", &PointConversionResult::Output::points, "number of points");
  m.def(
      "convert",
      [](const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& output,
         const PointWindow& window, const StripChoice& strips, const std::string& format,
         int threads, const PythonProgress& progress) {
        PointConversionOptions options;
        options.window = window, options.strips = strips, options.format = format;
        options.threads = threads;
        return runJob(progress, [&](const ProgressCallback& report) {
          return convertPointFiles(inputs, output, options, report).outputs;
        });
      },
      py::arg("inputs"), py::arg("output"), py::kw_only(),
      py::arg_v("window", PointWindow(), "PointWindow()"),
      py::arg_v("strips", StripChoice(), "StripChoice()"), py::arg("format") = "",
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Converts .las, .laz and .pcd files into each other, or writes parts of them; the bytes of "
      "LAS records stay as they are. output: a file for one input, else a folder, whose files have "
      "the given format ('las', 'laz', 'pcd'; default: that of the input). With strips.split one "
      "file for each strip. Constant memory.");
}

}  // namespace pcl_als::python
