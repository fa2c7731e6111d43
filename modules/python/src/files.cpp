// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include <pcl_als/common/errors.h>
#include <pcl_als/common/file_extension.h>
#include <pcl_als/io/strip_loader.h>
#include <pcl_als/io/strip_writer.h>
#include <pcl_als/processing/point_conversion.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "record.h"

namespace pcl_als::python {

namespace py = pybind11;

namespace {

/// Names of fields, or whether all.
using ExtraArgument = std::variant<bool, std::vector<std::string>>;

StripLoading loadingOf(const PointWindow& window, const std::optional<Rectangle>& bounds,
                       const ExtraArgument& extra) {
  StripLoading loading;
  loading.window = window;
  if (bounds) setBounds(loading.window, bounds);
  if (const bool* all = std::get_if<bool>(&extra)) loading.all_columns = *all;
  if (const auto* names = std::get_if<std::vector<std::string>>(&extra)) loading.columns = *names;
  return loading;
}

std::vector<std::shared_ptr<LidarStrip>> readStrips(const Files& files, const ExtraArgument& extra,
                                                    const std::optional<Rectangle>& bounds,
                                                    const PointWindow& window) {
  return runJob({}, [&](const ProgressCallback&) {
    std::vector<std::shared_ptr<LidarStrip>> strips;
    for (LidarStrip& strip : loadStrips(files.paths, loadingOf(window, bounds, extra)))
      strips.push_back(std::make_shared<LidarStrip>(std::move(strip)));
    return strips;
  });
}

using StripsArgument = std::variant<Strips, std::reference_wrapper<LidarStrip>>;

void writePoints(const std::filesystem::path& path, const StripsArgument& strips) {
  runInThread({}, [&](const ProgressCallback&) {
    if (const auto* several = std::get_if<Strips>(&strips))
      saveStrips(path, *several);
    else
      saveStrips(path, {std::get<std::reference_wrapper<LidarStrip>>(strips).get()});
  });
}

void writePcd(const std::filesystem::path& path, const LidarStrip& strip) {
  if (lowerExtension(path) != ".pcd")
    throw UsageError(path.string() + ": is not .pcd; write_points() writes .las and .laz");
  writePoints(path, Strips{strip});
}

void bindStripFiles(py::module_& m) {
  m.def("read_strips", &readStrips, py::arg("files"), py::kw_only(),
        py::arg("extra") = ExtraArgument(false), py::arg("bounds") = py::none(),
        py::arg_v("window", PointWindow(), "PointWindow()"),
        "Reads .las, .laz, .pcd, .ply and .xyz files whole, as strips: 48 bytes a point. A strip "
        "that reaches further than 4 km from its centre comes in parts of the same id. extra: "
        "True or names, for colours (red, green, blue, nir) and extra bytes of LAS files as "
        "Strip.extra; bounds: x_min, y_min, x_max, y_max in the ground frame, m, of the points "
        "that are read; window: more of that kind. InputError for files that cannot be read or "
        "that do not belong together.");
  m.def("write_points", &writePoints, py::arg("path"), py::arg("strips"),
        "Writes a strip, or several, into one file by its extension: .las and .laz (version 1.4; "
        "point format 6, with colours 7, with near infrared 8; steps of 1 mm; Strip.extra as "
        "colours and extra bytes; CRS; times below two weeks as seconds of the week), or .pcd (one "
        "strip). Where points have no point_source_id, a number as id of the strip is written as "
        "theirs. The file appears when it is complete. UsageError for another extension and for "
        "strips that could not be told apart.");
  m.def("write_pcd", &writePcd, py::arg("path"), py::arg("strip"),
        "Writes a strip as a binary PCD with every field; the file appears when it is complete. "
        "UsageError for another extension than .pcd.");
}

int lasMinorVersion(const std::string& version) {
  if (version == "1.4") return 4;
  if (version == "1.5") return 5;
  throw UsageError("las_version '" + version + "': is not '1.4' or '1.5'");
}

}  // namespace

void bindFiles(py::module_& m) {
  bindStripFiles(m);
  using Output = PointConversionResult::Output;
  Record<Output>(m, "ConvertedFile", "A file of convert().")
      .field("path", &Output::path)
      .field("points", &Output::points, "number of points")
      .bind();
  m.def(
      "convert",
      [](const Files& inputs, const std::filesystem::path& output, const PointWindow& window,
         const StripChoice& strips, const std::string& format, bool keep_ids, bool number_lines,
         const std::string& las_version, std::optional<std::uint16_t> time_offset, int threads,
         const PythonProgress& progress) {
        PointConversionOptions options;
        options.keep_ids = keep_ids, options.number_lines = number_lines;
        options.window = window, options.strips = strips, options.format = format;
        options.threads = threads;
        if (!las_version.empty())
          options.las_version = {lasMinorVersion(las_version), time_offset};
        else if (time_offset)
          throw UsageError("time_offset needs las_version '1.5'");
        return runJob(progress, [&](const ProgressCallback& report) {
          return convertPointFiles(inputs.paths, output, options, report).outputs;
        });
      },
      py::arg("inputs"), py::arg("output"), py::kw_only(),
      py::arg_v("window", PointWindow(), "PointWindow()"),
      py::arg_v("strips", StripChoice(), "StripChoice()"), py::arg("format") = "",
      py::arg("keep_ids") = false, py::arg("number_lines") = false, py::arg("las_version") = "",
      py::arg("time_offset") = py::none(), py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Converts point files (.las, .laz, .pcd, .ply, .xyz) into each other, or writes parts of "
      "them; the bytes of LAS records stay as they are. output: a file for one input, else a "
      "folder, whose files have the given format ('las', 'laz', 'pcd', 'ply', 'xyz'; default: "
      "that of the input). With strips.split one file for each strip, whose lines get point "
      "source ids of their own unless keep_ids is set. number_lines: the files as they are, with "
      "the number of its line as the point source id of each point (0 between lines). "
      "las_version: '1.4' or '1.5', of whole files; time_offset: of LAS 1.5, millions of seconds "
      "that are subtracted from GPS time. UsageError for number_lines or las_version with a "
      "choice of strips. Constant memory.");
}

}  // namespace pcl_als::python
