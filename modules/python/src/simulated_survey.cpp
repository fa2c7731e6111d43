// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <pybind11/eigen.h>

#include <pcl_als/common/bias_list.h>
#include <pcl_als/processing/simulated_survey.h>
#include <pcl_als/simulation/simulation_options.h>

#include "arguments.h"
#include "bindings.h"
#include "job.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;
using simulation::NoiseOptions;
using simulation::SimulationOptions;

/// A block that is to be simulated, with the name of its noise.
struct Simulation {
  SimulationOptions options;
  std::string noise = "none";
};

Simulation simulationOf(const std::string& preset, double scale, double density,
                        double field_of_view, double height, const std::string& noise,
                        const std::optional<std::string>& scanner, std::uint64_t seed) {
  Simulation made;
  made.options = SimulationOptions::preset(preset, scale, density, field_of_view, height);
  made.options.noise = NoiseOptions::named(noise);
  made.noise = noise;
  made.options.seed = seed;
  if (scanner) made.options.setScanner(*scanner);
  return made;
}

void setBias(Simulation& simulation, const std::string& name, double value) {
  const SystemParameter parameter = requireSystemParameter(name);
  simulation.options.bias[indexOf(parameter)] = value * infoOf(parameter).internal_per_unit;
}

double biasOf(const Simulation& simulation, const std::string& name) {
  const SystemParameter parameter = requireSystemParameter(name);
  return simulation.options.bias[indexOf(parameter)] / infoOf(parameter).internal_per_unit;
}

void bindOptions(py::module_& m) {
  py::class_<Simulation>(m, "Simulation",
                         "A block of strips with known biases and errors: terrain, houses, trees, "
                         "flight, scanner, noise. Biases are assumed - true.")
      .def(py::init(&simulationOf), py::arg("preset") = "small", py::kw_only(),
           py::arg("scale") = 1.0, py::arg("density") = 1.0, py::arg("field_of_view") = 0.0,
           py::arg("height") = 1.0, py::arg("noise") = "none", py::arg("scanner") = py::none(),
           py::arg("seed") = 1,
           "preset: 'paper', 'small', 'uav', 'corridor', 'conical', 'dual', 'rosette', 'mountain', "
           "'city'; scale: factor on the lengths of the lines; density: factor on the pulses per "
           "square metre; field_of_view: full angle, rad, 0: of the preset; height: factor on the "
           "flying heights; noise: 'none', 'range', 'realistic'; scanner: 'oscillating', "
           "'polygon', 'conical', 'rosette', 'dual', 'cross', 'multi'. UsageError for others.")
      .def("bias", &biasOf, py::arg("name"), "Bias of a system parameter, m, arcsec or 1.")
      .def("set_bias", &setBias, py::arg("name"), py::arg("value"),
           "Sets the bias of a system parameter, m, arcsec or 1.")
      .def(
          "add_errors", [](Simulation& s, const std::string& list) { s.options.errors.add(list); },
          py::arg("errors"),
          "Adds '[channelN:|sessionN:|stripN:]NAME=VALUE,...' as pcl_als_simulate does.")
      .def(
          "set_sessions", [](Simulation& s, int count) { s.options.setSessions(count); },
          py::arg("count"), "Divides the lines into sessions.")
      .def_property(
          "vertical", [](const Simulation& s) { return s.options.vertical; },
          [](Simulation& s, bool vertical) { s.options.vertical = vertical; },
          "no attitude motion, no crab")
      .def_property(
          "crs", [](const Simulation& s) { return s.options.crs; },
          [](Simulation& s, const std::string& crs) { s.options.crs = crs; })
      .def_property(
          "origin", [](const Simulation& s) { return Eigen::Vector3d(s.options.origin); },
          [](Simulation& s, const Eigen::Vector3d& origin) { s.options.origin = origin; },
          "middle of the block, m, ground frame")
      .def(
          "set_gains", [](Simulation& s, const std::string& list) { s.options.setGains(list); },
          py::arg("gains"), "Sets 'ID=FACTOR,...': factors on the gain of lines.");
}

}  // namespace

void bindSimulation(py::module_& m) {
  bindOptions(m);
  m.def(
      "simulate",
      [](const std::filesystem::path& folder, const Simulation& simulation, bool compressed,
         bool adjusted_time, bool truth_points, bool images, int threads,
         const PythonProgress& progress) {
        StripFileOptions files;
        files.folder = folder, files.compressed = compressed;
        files.adjusted_time = adjusted_time, files.bias_columns = truth_points;
        files.images = images;
        runInThread(progress, [&](const ProgressCallback& report) {
          simulation.options.check();
          simulateSurvey(simulation.options, simulation.noise, files, threads, report);
        });
      },
      py::arg("folder"), py::arg("simulation"), py::kw_only(), py::arg("compressed") = false,
      py::arg("adjusted_time") = false, py::arg("truth_points") = false, py::arg("images") = false,
      py::arg("threads") = 0, py::arg("progress") = py::none(),
      "Simulates a block into a folder: strip1.las ... (.laz where compressed), trajectory.csv, "
      "control.csv, training.csv, checkpoints.csv, truth.json, as pcl_als_simulate does. "
      "truth_points: extra bytes with the effect of the biases. Equal options give equal points.");
}

}  // namespace pcl_als::python
