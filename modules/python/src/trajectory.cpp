// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>
#include <optional>

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>

#include <pcl_als/common/errors.h>
#include <pcl_als/processing/trajectory_conversion.h>
#include <pcl_als/processing/trajectory_from_points.h>
#include <pcl_als/trajectory/trajectory_screening.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "words.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using Columns = py::array_t<double, py::array::c_style | py::array::forcecast>;

constexpr Word<AttitudeUse> kAttitudeUses[] = {{"where_given", AttitudeUse::where_given},
                                               {"needed", AttitudeUse::needed},
                                               {"ignore", AttitudeUse::ignore},
                                               {"nominal", AttitudeUse::nominal}};

constexpr Word<AttitudeAxes> kAttitudeAxes[] = {
    {"by_course", AttitudeAxes::by_course}, {"ned", AttitudeAxes::ned}, {"enu", AttitudeAxes::enu}};

/// One column for each of time, x, y, z, roll, pitch, heading.
py::array_t<double> samplesOf(const LoadedTrajectory& flight) {
  py::array_t<double> values({static_cast<py::ssize_t>(flight.samples.size()), py::ssize_t{7}});
  auto out = values.mutable_unchecked<2>();
  for (py::ssize_t i = 0; i < out.shape(0); ++i) {
    const TrajectorySample& sample = flight.samples[static_cast<std::size_t>(i)];
    const auto& p = sample.position;
    const double row[] = {sample.time, p.x(),        p.y(),         p.z(),
                          sample.roll, sample.pitch, sample.heading};
    for (py::ssize_t j = 0; j < 7; ++j) out(i, j) = row[j];
  }
  return values;
}

std::vector<TrajectorySample> samplesFrom(const Columns& values) {
  if (values.ndim() != 2 || (values.shape(1) != 4 && values.shape(1) != 7))
    throw UsageError("samples: not an array of n x 4 or n x 7");
  const auto in = values.unchecked<2>();
  std::vector<TrajectorySample> samples(static_cast<std::size_t>(in.shape(0)));
  for (py::ssize_t i = 0; i < in.shape(0); ++i) {
    TrajectorySample& sample = samples[static_cast<std::size_t>(i)];
    sample.time = in(i, 0);
    sample.position = {in(i, 1), in(i, 2), in(i, 3)};
    if (in.shape(1) == 7)
      sample.roll = in(i, 4), sample.pitch = in(i, 5), sample.heading = in(i, 6);
  }
  return samples;
}

std::shared_ptr<LoadedTrajectory> makeFlight(const Columns& values) {
  auto flight = std::make_shared<LoadedTrajectory>();
  flight->samples = samplesFrom(values);
  Trajectory::Options options;
  options.use_attitude = values.shape(1) == 7;
  flight->trajectory = std::make_shared<const Trajectory>(flight->samples, options);
  removeAt(flight->samples, screenTrajectory(flight->samples).indices());
  flight->remarks = flight->trajectory->repairs();
  flight->format = "array";
  return flight;
}

std::shared_ptr<LoadedTrajectory> readFlightFiles(const Files& files,
                                                  const TrajectoryLoadingOptions& options) {
  return runJob({}, [&](const ProgressCallback&) {
    return std::make_shared<LoadedTrajectory>(loadTrajectory(files.paths, options));
  });
}

py::tuple stateOf(const LoadedTrajectory& flight) {
  const Trajectory& path = *flight.trajectory;
  std::vector<std::vector<double>> accuracy;
  for (const TrajectoryAccuracy& at : flight.accuracy)
    accuracy.push_back({at.time, at.position.x(), at.position.y(), at.position.z(), at.angles.x(),
                        at.angles.y(), at.angles.z()});
  return py::make_tuple(samplesOf(flight), path.hasAttitude() && !path.attitudeIsNominal(),
                        path.attitudeIsNominal(), path.lineFitHalfWidth(), flight.format,
                        flight.frame, flight.remarks, accuracy);
}

std::shared_ptr<LoadedTrajectory> flightOfState(const py::tuple& state) {
  auto flight = std::make_shared<LoadedTrajectory>();
  flight->samples = samplesFrom(state[0].cast<Columns>());
  Trajectory::Options options;
  options.use_attitude = state[1].cast<bool>();
  options.nominal_attitude = state[2].cast<bool>();
  options.line_fit_half_width = state[3].cast<double>();
  flight->trajectory = std::make_shared<const Trajectory>(flight->samples, options);
  flight->format = state[4].cast<std::string>(), flight->frame = state[5].cast<std::string>();
  flight->remarks = state[6].cast<std::vector<std::string>>();
  for (const auto& row : state[7].cast<std::vector<std::array<double, 7>>>()) {
    TrajectoryAccuracy at;
    at.time = row[0];
    at.position = {row[1], row[2], row[3]}, at.angles = {row[4], row[5], row[6]};
    flight->accuracy.push_back(at);
  }
  return flight;
}

void bindFlight(py::module_& m) {
  py::class_<LoadedTrajectory, std::shared_ptr<LoadedTrajectory>>(
      m, "Flight",
      "A trajectory in the ground frame of the points. Times are seconds on its own clock; jobs "
      "reconcile the times of points with it.")
      .def(py::init(&makeFlight), py::arg("samples"),
           "From an array of n x 4 (time in s; easting, northing, height in m) or n x 7 (also "
           "roll, pitch, heading in radians: right wing down, nose up, clockwise from grid north). "
           "InputError where no path follows from it.")
      .def_property_readonly("samples", &samplesOf,
                             "n x 7: time (s), x, y, z (m), roll, pitch, heading (rad; NaN: none); "
                             "a new array")
      .def_property_readonly(
          "start_time", [](const LoadedTrajectory& f) { return f.trajectory->startTime(); }, "s")
      .def_property_readonly(
          "end_time", [](const LoadedTrajectory& f) { return f.trajectory->endTime(); }, "s")
      .def_property_readonly(
          "has_attitude", [](const LoadedTrajectory& f) { return f.trajectory->hasAttitude(); },
          "whether roll, pitch and heading are used")
      .def_property_readonly(
          "reconstructed", [](const LoadedTrajectory& f) { return f.reconstructed(); },
          "whether it was reconstructed from points")
      .def_readonly("format", &LoadedTrajectory::format, "'SBET', 'text', ...")
      .def_readonly("frame", &LoadedTrajectory::frame, "coordinates and datum of the file")
      .def_readonly("remarks", &LoadedTrajectory::remarks, "conversions and repairs")
      .def("__len__", [](const LoadedTrajectory& f) { return f.trajectory->size(); })
      .def(py::pickle(&stateOf, &flightOfState));
}

/// The flight of points; only positions where \a attitude is false.
std::shared_ptr<LoadedTrajectory> reconstruct(const PointsArgument& points,
                                              const std::optional<std::filesystem::path>& output,
                                              bool attitude, const StripChoice& strips, int threads,
                                              const ProgressCallback& report) {
  UsedSurvey survey(points, threads);
  ReconstructionOptions options;
  options.attitude = attitude, options.strips = strips;
  const ReconstructedTrajectory flight = reconstructTrajectory(*survey, options, report);
  if (output) writeReconstruction(flight, *output, (*survey).reference().crs);
  TrajectoryLoadingOptions reading;
  reading.keep_samples = true;
  if (!attitude) reading.attitude = AttitudeUse::ignore;
  auto made = std::make_shared<LoadedTrajectory>(flight.asFile(reading));
  for (const Warning& warning : flight.warnings) made->remarks.push_back(warning.text);
  if (!flight.incomplete.empty()) made->remarks.push_back(flight.incomplete);
  return made;
}

void bindReconstruction(py::module_& m) {
  m.def(
      "reconstruct_trajectory",
      [](const PointsArgument& points, const std::optional<std::filesystem::path>& output,
         bool attitude, const StripChoice& strips, int threads, const PythonProgress& progress) {
        return runJob(progress, [&](const ProgressCallback& report) {
          return reconstruct(points, output, attitude, strips, threads, report);
        });
      },
      py::arg("points"), py::kw_only(), py::arg("output") = py::none(), py::arg("attitude") = false,
      py::arg_v("strips", StripChoice(), "StripChoice()"), py::arg("threads") = 0,
      py::arg("progress") = py::none(),
      "Reconstructs the trajectory from the points, as pcl_als_trajectory does: from rays through "
      "several returns of a pulse and from scan angles. output: .csv or .sbet to write as well, "
      "with standard deviations; attitude: reads the points again for pitch and heading. Warnings, "
      "and why it is not complete, are remarks of the result. InputError where no path is "
      "determined.");
  m.def(
      "convert_trajectory",
      [](const Files& paths, const std::filesystem::path& output,
         const std::optional<CalibrationArgument>& calibration, const std::string& crs,
         bool strip_corrections, bool force, const PythonProgress& progress) {
        TrajectoryConversionOptions options;
        options.reading.crs = crs;
        options.strip_corrections = strip_corrections, options.force = force;
        return runJob(progress, [&](const ProgressCallback& report) {
          std::optional<CalibrationResult> biases;
          if (calibration) biases = calibrationOf(*calibration);
          options.calibration = biases ? &*biases : nullptr;
          return convertTrajectory(paths.paths, output, options, report).written;
        });
      },
      py::arg("paths"), py::arg("output"), py::kw_only(), py::arg("calibration") = py::none(),
      py::arg("crs") = "", py::arg("strip_corrections") = true, py::arg("force") = false,
      py::arg("progress") = py::none(),
      "Reads trajectory files, takes lever arm and strip corrections of a calibration out, and "
      "writes one trajectory: .csv, or .sbet or .out with a crs. Returns the files.");
}

}  // namespace

void bindTrajectory(py::module_& m) {
  bindFlight(m);
  bindReconstruction(m);
  m.def(
      "read_trajectory",
      [](const Files& paths, const std::string& crs, const std::string& own_crs,
         const std::string& attitude, const std::vector<std::string>& columns,
         std::optional<double> leap_seconds, const std::string& geoid, const std::string& axes) {
        TrajectoryLoadingOptions options;
        options.crs = crs, options.own_crs = own_crs, options.columns = columns;
        options.leap_seconds = leap_seconds, options.geoid = geoid;
        options.attitude = valueOf(kAttitudeUses, attitude, "attitude");
        options.axes = valueOf(kAttitudeAxes, axes, "axes");
        options.keep_samples = true;
        return readFlightFiles(paths, options);
      },
      py::arg("paths"), py::kw_only(), py::arg("crs") = "", py::arg("own_crs") = "",
      py::arg("attitude") = "where_given", py::arg("columns") = std::vector<std::string>(),
      py::arg("leap_seconds") = py::none(), py::arg("geoid") = "", py::arg("axes") = "by_course",
      "Reads a trajectory from a file, several files or a folder: text with named columns, SBET, "
      "TerraScan .trj, RIEGL .pof, Leica .sol. crs: of the points, needed for geographic and "
      "geocentric coordinates; own_crs: of the files; attitude: 'where_given', 'needed', 'ignore' "
      "or 'nominal' (level, heading along the course); columns: names of the columns of text "
      "files; leap_seconds: added to times in UTC, s; geoid: undulation in m or path of a grid; "
      "axes: 'ned' (roll right wing down, pitch nose up, heading clockwise from north), 'enu' "
      "(pitch nose down, yaw counter-clockwise from east), or 'by_course': ned, of a yaw and of "
      "quaternions as the course shows. InputError names the file and line.");
}

}  // namespace pcl_als::python
