// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026, the pcl_als authors
#include <array>

#include <pybind11/eigen.h>

#include <pcl_als/common/calibration_result.h>
#include <pcl_als/io/result_json.h>
#include <pcl_als/io/survey_io.h>

#include "arguments.h"
#include "bindings.h"
#include "messages.h"
#include "record.h"

namespace pcl_als::python {
namespace {

namespace py = pybind11;

/// A dictionary with a type of its values, for signatures.
class ParameterDict : public py::dict {
  using py::dict::dict;
};

}  // namespace
}  // namespace pcl_als::python

template <>
struct pybind11::detail::handle_type_name<pcl_als::python::ParameterDict> {
  static constexpr auto name = const_name("Dict[str, pcl_als.Parameter]");
};

namespace pcl_als::python {
namespace {

/// A parameter in the unit of interfaces.
struct Parameter {
  std::string name, unit, status, reason;
  double bias = 0.0, std = 0.0, std_formal = 0.0;
  bool determined = true;
};

/// One of several systems.
struct System {
  std::string name;
  std::vector<std::string> strips;
  std::vector<Parameter> parameters;
  Eigen::Vector3d offset, offset_std;
};

using Estimates = std::array<ParameterEstimate, kSystemParameterCount>;

/// In the order of SystemParameter.
std::vector<Parameter> parametersOf(const Estimates& estimates) {
  std::vector<Parameter> parameters;
  for (const SystemParameterInfo& info : systemParameters()) {
    const ParameterEstimate& estimate =
        estimates[static_cast<std::size_t>(indexOf(info.parameter))];
    Parameter parameter;
    parameter.name = info.name, parameter.unit = info.unit;
    parameter.status = toString(estimate.status), parameter.reason = estimate.reason;
    parameter.determined = estimate.determined;
    parameter.bias = estimate.bias / info.internal_per_unit;
    parameter.std = estimate.std / info.internal_per_unit;
    parameter.std_formal = estimate.std_formal / info.internal_per_unit;
    parameters.push_back(parameter);
  }
  return parameters;
}

ParameterDict byName(const std::vector<Parameter>& parameters) {
  ParameterDict result;
  for (const Parameter& parameter : parameters) result[py::str(parameter.name)] = parameter;
  return result;
}

std::vector<System> systemsOf(const CalibrationResult& result) {
  std::vector<System> systems;
  for (const SystemEstimate& system : result.systems)
    systems.push_back({system.group.name, system.group.strips, parametersOf(system.parameters),
                       system.offset, system.offset_std});
  return systems;
}

std::vector<std::string> correlationOrder(const CalibrationResult& result) {
  std::vector<std::string> names;
  for (const SystemParameter parameter : result.correlation_order)
    names.emplace_back(infoOf(parameter).name);
  return names;
}

void bindParameter(py::module_& m) {
  Record<Parameter>(m, "Parameter", "A system parameter of a calibration.")
      .field("name", &Parameter::name)
      .field("unit", &Parameter::unit, "of bias, std and std_formal: 'm', 'arcsec' or '1'")
      .field("bias", &Parameter::bias, "assumed - true")
      .field("std", &Parameter::std, "standard deviation, with the errors that pairs share")
      .field("std_formal", &Parameter::std_formal,
             "standard deviation from the noise of points alone (Habib et al. 2011, Eq. 26)")
      .field("status", &Parameter::status, "'estimated', 'fixed' or 'not_estimable'")
      .field("reason", &Parameter::reason, "why it is not estimated, or not determined; else empty")
      .field(
          "determined", &Parameter::determined,
          "False for an estimate that tells nothing: within two standard deviations of zero, one "
          "of which moves points by more than 8 cm")
      .bind()
      .def("__repr__", [](const Parameter& p) {
        return py::str("<pcl_als.Parameter {} {:.6g} {} (std {:.2g}, {})>")
            .format(p.name, p.bias, p.unit, p.std, p.status);
      });
}

void bindVerdict(py::module_& m) {
  Record<CalibrationVerdict>(m, "CalibrationVerdict", "Whether a calibration may be applied.")
      .state(&CalibrationVerdict::status)
      .property(
          "status",
          [](const CalibrationVerdict& verdict) { return std::string(toString(verdict.status)); },
          "'usable', 'parameters_affected', 'no_improvement', 'not_determined' or 'not_converged'")
      .field("reason", &CalibrationVerdict::reason)
      .property("usable", [](const CalibrationVerdict& v) { return v.usable(); })
      .bind()
      .def("__str__", [](const CalibrationVerdict& v) { return v.text(); });
  Record<MisfitChange>(m, "MisfitChange",
                       "Misfit of overlapping strips before and after, at the same points, along "
                       "the normals; m.")
      .field("points", &MisfitChange::points)
      .field("rms_before", &MisfitChange::rms_before)
      .field("rms_after", &MisfitChange::rms_after)
      .field("change_std", &MisfitChange::change_std, "standard deviation of the change of the RMS")
      .state(&MisfitChange::areas)
      .state(&MisfitChange::limit)
      .bind();
}

void bindFits(py::module_& m) {
  Record<PairFit>(m, "PairFit",
                  "Normal distances of the points of a pair of strips to the patches of the other "
                  "strip; m.")
      .field("a", &PairFit::a)
      .field("b", &PairFit::b)
      .field("correspondences", &PairFit::correspondences)
      .field("rms_before", &PairFit::rms_before)
      .field("rms_after", &PairFit::rms_after)
      .field("mean_before", &PairFit::mean_before)
      .field("mean_after", &PairFit::mean_after)
      .bind();
  Record<ControlFit>(m, "ControlFit", "Heights of a strip above control points; m.")
      .field("strip", &ControlFit::strip)
      .field("points", &ControlFit::points)
      .field("mean_before", &ControlFit::mean_before)
      .field("rms_before", &ControlFit::rms_before)
      .field("mean_after", &ControlFit::mean_after)
      .field("rms_after", &ControlFit::rms_after)
      .bind();
  Record<ErrorFinding>(m, "ErrorFinding", "A possible cause of the misfit of strips.")
      .field("source", &ErrorFinding::source)
      .field("title", &ErrorFinding::title)
      .field("unit", &ErrorFinding::unit, "of value and std")
      .field("probability", &ErrorFinding::probability, "that the error is present")
      .field("value", &ErrorFinding::value, "assumed - true, where it is present")
      .field("std", &ErrorFinding::std)
      .field("effect", &ErrorFinding::effect, "on the ground at the edge of the swath, m")
      .field("determined", &ErrorFinding::determined)
      .field("corrected", &ErrorFinding::corrected)
      .field("evidence", &ErrorFinding::evidence)
      .field("remedy", &ErrorFinding::hint)
      .bind();
}

void bindSystem(py::module_& m) {
  Record<System>(m, "SystemEstimate", "One of several systems of a calibration.")
      .field("name", &System::name)
      .field("strips", &System::strips)
      .state(&System::parameters)
      .property("parameters", [](const System& s) { return byName(s.parameters); })
      .field("offset", &System::offset,
             "of its coordinates, assumed - true, to the first system: east, north, up, m")
      .field("offset_std", &System::offset_std, "m")
      .bind();
}

py::tuple stateOf(const CalibrationResult& result) {
  return py::make_tuple(calibrationJson(result), result.excluded);
}

std::shared_ptr<CalibrationResult> resultOf(const py::tuple& state) {
  auto result = std::make_shared<CalibrationResult>(
      parseCalibration(state[0].cast<std::string>(), "pickled calibration"));
  result->excluded = state[1].cast<std::vector<ExcludedPoints>>();
  return result;
}

void bindResult(py::module_& m) {
  using Result = CalibrationResult;
  py::class_<Result, std::shared_ptr<Result>>(m, "CalibrationResult",
                                              "The content of a calibration.json.")
      .def_readonly("verdict", &Result::verdict)
      .def_property_readonly(
          "parameters", [](const Result& r) { return byName(parametersOf(r.parameters)); },
          "the eight system parameters by name, such as 'boresight_roll'")
      .def_property_readonly(
          "attitude", [](const Result& r) { return std::string(toString(r.attitude)); },
          "source of the attitude of the model: 'none', 'points', 'trajectory' or 'nominal'")
      .def_property_readonly("correlation_order", &correlationOrder,
                             "names of the rows and columns of correlation")
      .def_property_readonly(
          "correlation", [](const Result& r) { return Eigen::MatrixXd(r.correlation); },
          "of the estimated parameters; a new array")
      .def_property_readonly(
          "systems", &systemsOf,
          "all systems where there are several; parameters are those of the first one")
      .def_readonly("sigma0", &Result::sigma0, "standard deviation of unit weight, 1")
      .def_readonly("redundancy", &Result::redundancy)
      .def_readonly("converged", &Result::converged)
      .def_readonly("misfit", &Result::misfit)
      .def_readonly("pairs", &Result::pairs)
      .def_readonly("control", &Result::control, "fit of each strip to control")
      .def_readonly("diagnosis", &Result::diagnosis, "possible causes of the misfit")
      .def_readonly("observability", &Result::observability,
                    "what is weakly determined, why, and what would help")
      .def_property_readonly(
          "warnings",
          [](const Result& r) { return hintedTexts("calibrate", warningTexts(r.warnings)); })
      .def_readonly("left_out", &Result::excluded)
      .def_readonly("inputs", &Result::inputs, "names of files")
      .def_readonly("crs", &Result::crs,
                    "of the ground frame, WKT or an EPSG code; empty: not known")
      .def(
          "instrument", [](const Result& r) { return std::make_shared<Result>(instrumentOf(r)); },
          "The part that belongs to the instrument and applies to its other flights.")
      .def(
          "to_dict", [](const Result& r) { return parsedJson(calibrationJson(r)); },
          "The content of calibration.json as dictionaries and lists; angles in arc-seconds.")
      .def(
          "write",
          [](const Result& r, const std::filesystem::path& path) { writeCalibration(path, r); },
          py::arg("path"), "Writes calibration.json; the file appears when it is complete.")
      .def(py::pickle(&stateOf, &resultOf))
      .def("__str__", &Result::fullReport);
}

}  // namespace

void bindCalibrationResult(py::module_& m) {
  bindParameter(m);
  bindVerdict(m);
  bindFits(m);
  bindSystem(m);
  bindResult(m);
  m.def("read_calibration", &readCalibration, py::arg("path"),
        "Reads a calibration.json. InputError for a file that is none.");
}

}  // namespace pcl_als::python
