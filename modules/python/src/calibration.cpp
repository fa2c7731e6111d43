// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/calibration/survey_calibration.h>
#include <pcl_als/common/bias_list.h>
#include <pcl_als/common/system_parameters.h>
#include <pcl_als/io/survey_io.h>
#include <pcl_als/processing/reference_source.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"
#include "keywords.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using StripPairs = std::vector<std::pair<std::string, std::string>>;

std::vector<std::string> namesOf(const std::vector<SystemParameter>& parameters) {
  std::vector<std::string> names;
  for (const SystemParameter parameter : parameters) names.emplace_back(infoOf(parameter).name);
  return names;
}

std::vector<SystemParameter> parametersNamed(const std::vector<std::string>& names) {
  std::vector<SystemParameter> parameters;
  for (const std::string& name : names) {
    const auto parameter = systemParameterNamed(name);
    if (!parameter) throw UsageError("estimate: '" + name + "' is no system parameter");
    parameters.push_back(*parameter);
  }
  return parameters;
}

using Systems = std::vector<std::pair<std::string, std::vector<std::string>>>;

Systems systemsOf(const CalibrationSettings& settings) {
  Systems systems;
  for (const StripGroup& group : settings.systems) systems.emplace_back(group.name, group.strips);
  return systems;
}

void setSystems(CalibrationSettings& settings, const Systems& systems) {
  settings.systems.clear();
  for (const auto& [name, strips] : systems) settings.systems.push_back({name, strips});
}

std::vector<std::string> ownOf(const PerSystemParameters& own) {
  std::vector<std::string> names = namesOf(own.parameters);
  if (own.offset) names.emplace_back("offset");
  return names;
}

PerSystemParameters ownNamed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  return ownUnknowns(list);
}

void bindModels(py::module_& m) {
  py::class_<NoiseModel>(m, "NoiseModel", "Random errors of one return (standard deviations).")
      .def(fromKeywords<NoiseModel>())
      .def_readwrite("range", &NoiseModel::range, "along the beam, m")
      .def_readwrite("angle", &NoiseModel::angle, "pointing, each axis, rad")
      .def_readwrite("position", &NoiseModel::position, "short-term trajectory noise, m")
      .def_readwrite("beam_divergence", &NoiseModel::beam_divergence, "full angle at 1/e^2, rad");
  py::class_<SharedErrorModel>(m, "SharedErrorModel",
                               "Errors that the points of a strip share (standard deviations).")
      .def(fromKeywords<SharedErrorModel>())
      .def_readwrite("position", &SharedErrorModel::position, "of the trajectory, each axis, m")
      .def_readwrite("roll_pitch", &SharedErrorModel::roll_pitch, "rad")
      .def_readwrite("heading", &SharedErrorModel::heading, "rad")
      .def_readwrite("correlation_time", &SharedErrorModel::correlation_time, "s")
      .def_readwrite("local", &SharedErrorModel::local, "remaining errors in an area, m");
}

void bindSettings(py::module_& m) {
  using Settings = CalibrationSettings;
  py::class_<Settings>(m, "CalibrationSettings",
                       "Settings of a calibration; the defaults suit post-processed flights of "
                       "500 to 3000 m height. Attributes may be given as keywords.")
      .def(fromKeywords<Settings>())
      .def_property(
          "estimate", [](const Settings& s) { return namesOf(s.estimate); },
          [](Settings& s, const std::vector<std::string>& names) {
            s.estimate = parametersNamed(names);
          },
          "names of the parameters to estimate; empty: all that the data determine")
      .def_property("systems", &systemsOf, &setSystems,
                    "systems with parameters of their own: name and strips of each; empty: one")
      .def_property(
          "own", [](const Settings& s) { return ownOf(s.own); },
          [](Settings& s, const std::vector<std::string>& names) { s.own = ownNamed(names); },
          "what systems have of their own: names of parameters, 'boresight', 'lever_arm', 'offset'")
      .def_readwrite("fixed", &Settings::fixed,
                     "strips that are held fixed: an earlier delivery, which is not corrected")
      .def_readwrite("fixed_sigma", &Settings::fixed_sigma,
                     "standard deviation of the error that fixed strips share, m, each axis")
      .def_readwrite("noise", &Settings::noise)
      .def_readwrite("shared_errors", &Settings::shared_errors)
      .def_readwrite("candidates", &Settings::candidates,
                     "points of all areas together that may form pairs")
      .def_readwrite("pair_budget", &Settings::pair_budget,
                     "largest number of pairs that are adjusted; 0: all")
      .def_property(
          "point_budget", [](const Settings& s) { return s.selection.point_budget; },
          [](Settings& s, std::size_t points) { s.selection.point_budget = points; },
          "largest number of points in the areas that are used")
      .def_readwrite("max_normal_distance", &Settings::max_normal_distance,
                     "of a pair at the start, m")
      .def_readwrite("control_sigma", &Settings::control_sigma,
                     "standard deviation of control points whose file gives none, m")
      .def_readwrite("minimum_overlap", &Settings::minimum_overlap, "of a pair of strips, m^2")
      .def_readwrite("minimum_points", &Settings::minimum_points,
                     "strips with fewer points are excluded")
      .def_readwrite("recover_attitude", &Settings::recover_attitude,
                     "recover pitch and crab from the points where the trajectory has no attitude")
      .def_readwrite("diagnose", &Settings::diagnose, "look for further error sources")
      .def_readwrite("max_iterations", &Settings::max_iterations)
      .def_readwrite("force", &Settings::force,
                     "continue with a trajectory that cannot belong to the points")
      .def_readwrite("threads", &Settings::threads, "0: all cores; results do not depend on it");
}

void bindControl(py::module_& m) {
  Record<ControlPoint>(m, "ControlPoint",
                       "A surveyed point on the ground, used vertically, or the centre of a "
                       "target.")
      .field("id", &ControlPoint::id)
      .state(&ControlPoint::position)
      .state(&ControlPoint::kind)
      .property(
          "x", [](const ControlPoint& p) { return p.position.x(); }, "m")
      .property(
          "y", [](const ControlPoint& p) { return p.position.y(); }, "m")
      .property(
          "z", [](const ControlPoint& p) { return p.position.z(); }, "m")
      .field("sigma", &ControlPoint::sigma, "standard deviation of the height, m; 0: not stated")
      .field("diameter", &ControlPoint::diameter, "of a level circular target, m; 0: not a target")
      .field("sigma_plan", &ControlPoint::sigma_plan,
             "standard deviation of x and of y of a target, m; 0: that of the height")
      .state(&ControlPoint::normal)
      .state(&ControlPoint::extent)
      .bind()
      .def(py::init([](const std::string& id, double x, double y, double z, double sigma,
                       double diameter, double sigma_plan) {
             ControlPoint point{id, Eigen::Vector3d(x, y, z), sigma};
             if (diameter > 0.0) point.kind = ControlPoint::Kind::target;
             point.diameter = diameter;
             point.sigma_plan = sigma_plan;
             return point;
           }),
           py::arg("id"), py::arg("x"), py::arg("y"), py::arg("z"), py::arg("sigma") = 0.0,
           py::arg("diameter") = 0.0, py::arg("sigma_plan") = 0.0);
  m.def(
      "read_control", [](const std::filesystem::path& path) { return readControl(path); },
      py::arg("path"),
      "Reads control points from CSV with columns id, x, y, z and optionally sigma, m.");
}

std::shared_ptr<CalibrationResult> calibrate(
    const PointsArgument& points, const TrajectoryArgument& trajectory,
    const ControlArgument& control, const CalibrationSettings& settings, const StripChoice& strips,
    const StripPairs& pairs, const std::vector<std::string>& references,
    std::optional<int> gps_week, const PythonProgress& progress) {
  return runJob(progress, [&](const ProgressCallback& report) {
    UsedSurvey survey(points, settings.threads);
    TrajectoryLoadingOptions reading;
    reading.crs = (*survey).reference().crs;
    const LoadedTrajectory flight = flightOf(trajectory, reading);
    CalibrationOptions options;
    options.settings = settings, options.strips = strips, options.pairs = pairs;
    options.control = controlOf(control), options.gps_week = gps_week;
    for (const std::string& text : references) options.references.push_back(openReference(text));
    options.reconstructed = flight.reconstructed();
    (options.reconstructed ? options.path_accuracy : options.accuracy) = flight.accuracy;
    SurveyCalibration made = calibrateSurvey(*survey, flight.trajectory, options, report);
    addInputs(trajectory, control, made.result.inputs);
    return std::make_shared<CalibrationResult>(std::move(made.result));
  });
}

}  // namespace

void bindCalibration(py::module_& m) {
  bindModels(m);
  bindSettings(m);
  bindControl(m);
  m.def("calibrate", &calibrate, py::arg("points"), py::arg("trajectory"), py::kw_only(),
        py::arg("control") = py::none(),
        py::arg_v("settings", CalibrationSettings(), "CalibrationSettings()"),
        py::arg_v("strips", StripChoice(), "StripChoice()"), py::arg("pairs") = StripPairs(),
        py::arg("references") = std::vector<std::string>(), py::arg("gps_week") = py::none(),
        py::arg("progress") = py::none(),
        "Estimates boresight angles, lever arm, range bias and scan angle scale from overlapping "
        "strips (Habib et al. 2011), as pcl_als_calibrate does. points: files, strips in memory or "
        "a Survey; trajectory: as delivered; control: points or their CSV file; pairs: of strips, "
        "default all that overlap; references: surfaces as 'FILE[:STD[:OFFSET]]', m; gps_week: of "
        "times in seconds of the week. Whether the result "
        "may be applied is its verdict. InputError for data that cannot be used.");
}

}  // namespace pcl_als::python
